"""Nothing shows through lids: what is drawn of an eyeball lies between them, at every blink."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import pdeface
from pdeface.parts import FaceParts
from pdeface.pictures.camera import Camera
from pdeface.pictures.raster_numpy import draw
from pdeface.pictures.solid import Solid

SIZE = (320, 200)
VIEWS = (-20.0, 40.0)
SLIT = 2
"""Pixels of some 500 along shut lids whose centre may meet the slit between them, whatever lies
behind it: lids meet to a few micrometres, and a pixel is 280 across."""
SKIN, RIM, BALL = np.eye(3)[[1, 2, 0]]
COMPANY = st.dictionaries(
    st.sampled_from([f"eye{name}Left" for name in ("Wide", "Squint", "LookUp", "LookDown")])
    | st.sampled_from(["eyeLookInLeft", "eyeLookOutLeft"]),
    st.floats(0.0, 1.0),
)


@dataclass
class Seen:
    """Pixels of a picture of the left eye, (H, W) each: of the eyeball, between the margins and
    within a pixel of that, and of neither skin nor rim nor eyeball."""

    ball: np.ndarray
    between: np.ndarray
    nothing: np.ndarray


def seen(face: pdeface.Face, azimuth: float, mesh: tuple[int, int], forward: float = 0.0) -> Seen:
    """One picture, 0.28 mm a pixel, the eyeball moved ``forward`` by so many metres."""
    skin, (_, cut, _) = face.mesh(*mesh), face.uv_mesh(*mesh).cuts
    edges = [skin.vertices[row * mesh[1] + cut.columns] for row in (cut.upper, cut.lower)]
    camera = towards(np.concatenate(edges).mean(axis=0), np.radians(azimuth))
    parts = FaceParts(face)
    solids = [flat(skin.vertices, skin.triangles, SKIN)]
    for name, color, ahead in (("left_lids", RIM, 0.0), ("left_eyeball", BALL, forward)):
        part = parts.parts[name]
        vertices = part.positions(parts.curves(name)) + [0.0, 0.0, ahead]
        solids.append(flat(vertices, part.grid.triangles, color))
    picture = draw(solids, camera, SIZE)
    drawn = picture[..., 3] > 0
    return Seen(drawn & (picture[..., 0] > 128), between(edges, camera), ~drawn)


def flat(vertices: np.ndarray, triangles: np.ndarray, color: np.ndarray) -> Solid:
    return Solid(vertices, triangles, np.tile(color, (len(vertices), 1)))


def towards(eye: np.ndarray, azimuth: float) -> Camera:
    back = np.array([np.sin(azimuth), 0.0, np.cos(azimuth)])
    right = np.array([np.cos(azimuth), 0.0, -np.sin(azimuth)])
    return Camera(eye + 0.5 * back, eye, right, np.array([0.0, 1.0, 0.0]), fov=6.0)


def between(edges: list[np.ndarray], camera: Camera) -> np.ndarray:
    """(H, W) pixels of the strip between two edges, and their neighbours."""
    n = len(edges[0])
    a, b = np.arange(n - 1), np.arange(n, 2 * n - 1)
    strip = np.concatenate([np.stack([a, b, b + 1], axis=1), np.stack([a, b + 1, a + 1], axis=1)])
    # Both ways round: an edge that has passed the other is no less an edge.
    both = np.concatenate([strip, strip[:, ::-1]]).astype(np.int32)
    inner = draw([flat(np.concatenate(edges), both, SKIN)], camera, SIZE)[..., 3] > 0
    wide = np.pad(inner, 1)
    steps = [(y, x) for y in range(3) for x in range(3)]
    shifted = [wide[y : y + SIZE[1], x : x + SIZE[0]] for y, x in steps]
    return np.asarray(np.any(shifted, axis=0))


@pytest.mark.parametrize("mesh", [(28, 41), (109, 161)], ids=str)
@pytest.mark.parametrize("level", ["28x46", "55x92"])
@settings(max_examples=4, deadline=None)
@given(
    seed=st.none() | st.integers(0, 1000),
    blink=st.sampled_from([0.0, 0.25, 0.5, 0.75, 0.9, 1.0]) | st.floats(0.0, 1.0),
    company=COMPANY,
)
def test_no_eyeball_is_seen_but_between_the_lids(level, mesh, seed, blink, company) -> None:
    face = pdeface.neutral(level) if seed is None else pdeface.random(seed, level)
    face = face.set(**company, eyeBlinkLeft=blink)
    for azimuth in VIEWS:
        picture = seen(face, azimuth, mesh)
        assert not (picture.ball & ~picture.between).any(), azimuth


@pytest.mark.parametrize("mesh", [(28, 41), (109, 161)], ids=str)
@pytest.mark.parametrize("level", ["28x46", "55x92"])
@settings(max_examples=4, deadline=None)
@given(seed=st.none() | st.integers(0, 1000), company=COMPANY)
def test_a_shut_eye_shows_neither_eyeball_nor_hole(level, mesh, seed, company) -> None:
    face = pdeface.neutral(level) if seed is None else pdeface.random(seed, level)
    face = face.set(**company, eyeBlinkLeft=1.0)
    for azimuth in VIEWS:
        picture = seen(face, azimuth, mesh)
        hole = picture.between & picture.nothing
        assert picture.ball.sum() + hole.sum() <= SLIT, azimuth


def test_an_eyeball_is_seen_where_it_is_open_and_would_be_through_a_lid() -> None:
    """What the other tests look for is there to be found."""
    face, mesh = pdeface.neutral(), (109, 161)
    is_open = seen(face, 0.0, mesh)
    assert is_open.ball.sum() > 500
    assert not (is_open.ball & ~is_open.between).any()
    shut = seen(face.set(eyeBlinkLeft=1.0), 0.0, mesh, forward=3e-3)
    assert (shut.ball & ~shut.between).sum() > 100
