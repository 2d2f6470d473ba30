from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from pdeface.errors import InputError
from pdeface.pictures.camera import frame
from pdeface.pictures.light import RIGS, decode_srgb, encode_srgb, light_up, rig_named

BOX = np.array([[-0.1, -0.1, 0.0], [0.1, 0.1, 0.1]])
CLAY = np.array([0.7, 0.6, 0.5])


@given(st.floats(0.0, 1.0))
def test_srgb_there_and_back(value: float) -> None:
    assert decode_srgb(encode_srgb(np.array(value))) == pytest.approx(value, abs=1e-6)


def test_srgb_has_the_standards_values() -> None:
    np.testing.assert_allclose(encode_srgb(np.array([0.0, 0.214041, 1.0])), [0, 0.5, 1], atol=1e-5)


@pytest.mark.parametrize("name", RIGS)
def test_colours_can_be_shown(name: str) -> None:
    rng = np.random.default_rng(0)
    normals = rng.normal(size=(200, 3))
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    colors = light_up(normals * 0.1, normals, CLAY, frame(BOX), RIGS[name])
    assert colors.shape == (200, 3)
    assert 0.0 <= colors.min() < colors.max() <= 1.0


@pytest.mark.parametrize("name", RIGS)
def test_what_faces_the_lamp_is_brighter_than_what_turns_away(name: str) -> None:
    camera = frame(BOX)
    towards = np.array(RIGS[name].lamps[0].direction)
    towards = towards / np.linalg.norm(towards)
    normals = np.stack([towards, -towards])
    lit = light_up(np.zeros((2, 3)), normals, CLAY, camera, RIGS[name])
    assert np.all(lit[0] > lit[1])


def test_the_lamps_turn_with_the_camera() -> None:
    """A head seen from the side is lit as one that was turned in front of the camera."""
    rng = np.random.default_rng(1)
    normals = rng.normal(size=(50, 3))
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    points = 0.1 * normals
    camera = frame(np.concatenate([points, -points]), 0.0)
    axes = np.stack([camera.right, camera.up, camera.backward])
    side = frame(np.concatenate([points, -points]), 60.0)
    turn = axes.T @ np.stack([side.right, side.up, side.backward])
    moved = (points - side.target) @ turn.T * side.distance / side.distance + camera.target
    direct = light_up(points, normals, CLAY, side, RIGS["soft"])
    turned = light_up(moved, normals @ turn.T, CLAY, camera, RIGS["soft"])
    np.testing.assert_allclose(direct, turned, atol=1e-9)


def test_an_unknown_rig_is_refused() -> None:
    with pytest.raises(InputError, match="raking"):
        rig_named("candle")
