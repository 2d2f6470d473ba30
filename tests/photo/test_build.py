"""Landmarks whose places on the face are known are found there again."""

from __future__ import annotations

import numpy as np

import pdeface
from pdeface.photo.anchors import anchors
from pdeface.photo.build.measure import MODES, common_errors, places_on_face
from pdeface.photo.build.renders import GRID
from pdeface.photo.camera import PhotoCamera


def pictures(uv, count: int):
    """(n, landmarks, 2) and (n, vertices, 2) of random people before turned cameras."""
    found, places = [], []
    for seed, angle in enumerate(np.linspace(-0.4, 0.4, count)):
        c, s = np.cos(angle), np.sin(angle)
        camera = PhotoCamera(np.array([[c, 0, s], [0, 1, 0], [-s, 0, c]]), 15.0, np.zeros(2))
        face = pdeface.random(seed)
        found.append(camera.project(face.surface()(*uv.T)))
        places.append(camera.project(face.mesh(*GRID).vertices))
    return np.array(found), np.array(places)


def test_places_are_found_to_half_a_millimetre() -> None:
    rng = np.random.default_rng(0)
    uv = np.column_stack([rng.uniform(0.1, 0.9, 40), rng.uniform(0.5, np.pi - 0.5, 40)])
    surface = pdeface.neutral().surface()
    off = surface(*places_on_face(*pictures(uv, 8)).T) - surface(*uv.T)
    assert np.linalg.norm(off, axis=1).max() < 5e-4


def test_an_error_that_all_share_is_a_mode_and_no_spread() -> None:
    rng = np.random.default_rng(1)
    uv = np.column_stack([rng.uniform(0.2, 0.8, 20), rng.uniform(1.0, 2.0, 20)])
    found, places = pictures(uv, MODES + 6)
    way = rng.normal(size=(20, 2))
    amounts = rng.normal(size=len(found))
    modes, spread = common_errors(found + 0.02 * amounts[:, None, None] * way, places, uv)
    assert modes.shape == (MODES, 20, 2)
    likeness = np.sum(modes[0] * way) / np.linalg.norm(modes[0]) / np.linalg.norm(way)
    assert abs(likeness) > 0.999
    size = 0.02 * np.sqrt((amounts**2).mean()) * np.linalg.norm(way)
    np.testing.assert_allclose(np.linalg.norm(modes[0]), size, rtol=0.01)
    assert spread.max() < 1e-4


def test_what_ships_has_the_shapes_it_says() -> None:
    uv, spread, modes = anchors()
    assert uv.shape == (478, 2)
    assert spread.shape == (478,)
    assert modes.shape == (MODES, 478, 2)
    sizes = np.linalg.norm(modes.reshape(MODES, -1), axis=1)
    assert (np.diff(sizes) <= 1e-2).all()
