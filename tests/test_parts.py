"""The parts of a face: where they are, and that they go where the face goes."""

from __future__ import annotations

import numpy as np
import pytest

import pdeface
from pdeface.controls import Displacement
from pdeface.curves import BoundaryCurves
from pdeface.face import Face
from pdeface.parts import FaceParts, eye_colours, has_parts


@pytest.mark.parametrize("seed", [None, 0, 1])
def test_parts_are_linear_in_an_expression_alone(seed: int | None) -> None:
    face = pdeface.neutral() if seed is None else pdeface.random(seed)
    rest = FaceParts(face)
    for name in ("jawOpen", "eyeBlinkLeft", "eyeLookInRight", "tongueOut", "mouthFunnel"):
        half, full = (FaceParts(face.set(**{name: weight})) for weight in (0.5, 1.0))
        for part in rest.parts:
            moved = full.curves(part) - rest.curves(part)
            np.testing.assert_allclose(
                half.curves(part) - rest.curves(part), 0.5 * moved, atol=1e-12
            )


def test_the_rims_of_lids_and_lips_begin_at_the_openings_of_the_mesh() -> None:
    face = pdeface.random(2).set(jawOpen=0.7, eyeBlinkRight=0.3)
    mesh, cuts = face.mesh(217, 961).vertices, face.uv_mesh(217, 961).cuts
    for cut, part in zip(cuts, ("right_lids", "left_lids", "mouth"), strict=True):
        edge = np.concatenate([r * 961 + cut.columns for r in (cut.upper, cut.lower)])
        loop = FaceParts(face).curves(part)[0]
        apart = np.linalg.norm(loop[:, None] - mesh[edge], axis=2).min(axis=1)
        assert apart.max() < 1e-3


@pytest.mark.parametrize("side", ["left", "right"])
def test_a_look_turns_the_eyeball_by_thirty_degrees(side: str) -> None:
    def gaze(**weights: float) -> np.ndarray:
        curves = FaceParts(pdeface.neutral().set(**weights)).curves(f"{side}_eyeball")
        forward = curves[0].mean(axis=0) - curves[-1].mean(axis=0)
        return forward / np.linalg.norm(forward)

    ahead = gaze()
    up, out = (gaze(**{f"eyeLook{way}{side.capitalize()}": 1.0}) for way in ("Up", "Out"))
    for turned in (up, out):
        assert np.degrees(np.arccos(ahead @ turned)) == pytest.approx(30.0, abs=0.5)
    assert up[1] - ahead[1] > 0.4
    assert (out[0] - ahead[0]) * (1 if side == "left" else -1) > 0.4


def test_a_displacement_of_nothing_moves_nothing() -> None:
    parts = FaceParts(pdeface.neutral())
    still = np.zeros((28, 46, 3))
    for name in parts.parts:
        assert not parts.moved(name, parts.outline(Displacement(still, still)), {}).any()


def test_faces_without_openings_have_no_parts() -> None:
    assert has_parts(pdeface.random(1))
    assert not has_parts(Face(BoundaryCurves(np.zeros((28, 46, 3)))))
    assert not has_parts(Face(BoundaryCurves(np.random.default_rng(1).normal(size=(7, 8, 3)))))


def test_the_iris_has_the_colour_that_the_texture_shows() -> None:
    from pdeface.anatomy.textures import EYE_WHITE, IRIS_COLOUR
    from pdeface.texture import portrait, uv_texture

    assert eye_colours(pdeface.neutral()) == (IRIS_COLOUR, EYE_WHITE)
    image, points = portrait()
    face = pdeface.neutral().with_texture(uv_texture(image, points).image)
    (red, green, blue), white = eye_colours(face)
    assert red > green > blue, "the subject of the portrait has brown eyes"
    assert 50 < red < 140
    assert min(white) >= 150 and max(white) <= 236, "in the light of the photo, within reason"
    blues = np.full((64, 64, 3), (90, 110, 150), np.uint8)
    assert eye_colours(pdeface.neutral().with_texture(blues))[0] in (IRIS_COLOUR, (90, 110, 150))
