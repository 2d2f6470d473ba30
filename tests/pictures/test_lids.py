"""Nothing shows through the lids, at any blink, whoever it is and wherever the eye looks."""

from __future__ import annotations

import numpy as np
import pytest

import pdeface
from pdeface.parts import FaceParts
from pdeface.pictures.camera import Camera, frame
from pdeface.pictures.raster_numpy import draw
from pdeface.pictures.solid import Solid

SIZE = (320, 240)
MESH = (109, 161)
SKIN, BALL, RIM = np.eye(3)
COMPANY = {
    "alone": {},
    "wide": {"eyeWideLeft": 1.0},
    "squint": {"eyeSquintLeft": 1.0},
    "up and in": {"eyeLookUpLeft": 1.0, "eyeLookInLeft": 1.0},
    "down and out": {"eyeLookDownLeft": 1.0, "eyeLookOutLeft": 1.0},
    "all": {"eyeWideLeft": 1.0, "eyeSquintLeft": 1.0, "eyeLookUpLeft": 1.0, "eyeLookOutLeft": 1.0},
}


def of_one_colour(vertices: np.ndarray, triangles: np.ndarray, colour: np.ndarray) -> Solid:
    return Solid(vertices, triangles, np.broadcast_to(colour, vertices.shape).copy())


def solids(face: pdeface.Face) -> list[Solid]:
    """The skin, the left eyeball and the rim of its lids, each in a colour of its own."""
    mesh, parts = face.mesh(*MESH), FaceParts(face)
    found = [of_one_colour(mesh.vertices, mesh.triangles, SKIN)]
    for name, colour in (("left_eyeball", BALL), ("left_lids", RIM)):
        part = parts.parts[name]
        found.append(of_one_colour(part.positions(parts.curves(name)), part.grid.triangles, colour))
    return found


def before_the_eye(face: pdeface.Face, view: float) -> Camera:
    edge = FaceParts(face).curves("left_lids")[0]
    return frame(edge, view, SIZE[0] / SIZE[1])


def seen(image: np.ndarray, colour: np.ndarray) -> np.ndarray:
    return (image[..., :3] == np.round(255 * colour)).all(axis=-1) & (image[..., 3] > 0)


@pytest.mark.parametrize("level", ["28x46", "55x92"])
@pytest.mark.parametrize("company", COMPANY)
@pytest.mark.parametrize("seed", [None, 5])
def test_no_eye_is_seen_through_or_before_a_lid(seed: int | None, company: str, level: str) -> None:
    person = pdeface.neutral(level) if seed is None else pdeface.random(seed, level)
    for view in (0.0, 35.0):
        camera = before_the_eye(person, view)
        balls = []
        for blink in (0.0, 0.5, 1.0):
            skin, *behind = solids(person.set(**COMPANY[company], eyeBlinkLeft=blink))
            covered = seen(draw([skin], camera, SIZE), SKIN)
            image = draw([skin, *behind], camera, SIZE)
            balls.append(int(seen(image, BALL).sum()))
            assert (seen(image, BALL) & covered).sum() == 0, (view, blink)
        # Two edges of straight pieces, 0.03 mm apart at most, may leave a pixel of 0.1 mm between.
        assert balls[-1] <= 1
        assert balls[0] > 1000
        assert balls == sorted(balls, reverse=True)
