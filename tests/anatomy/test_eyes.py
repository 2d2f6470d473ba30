"""Eyeballs lie behind the lids and turn by the looks."""

from __future__ import annotations

import numpy as np
import pytest

import pdeface
from pdeface.anatomy import PARTS, SAMPLES, Anatomy, Outline, placed
from pdeface.anatomy.eyes import CLEARANCE

from .conftest import anatomy_of, outline, skin


@pytest.mark.parametrize("seed", [None, 0, 1, 2, 3, 4])
@pytest.mark.parametrize("closed", [0.0, 0.5, 1.0])
def test_the_lids_are_in_front_of_the_eyeballs(seed: int | None, closed: float) -> None:
    face = pdeface.neutral() if seed is None else pdeface.random(seed)
    anatomy = anatomy_of(face)
    lids = outline(face.set(eyeBlinkLeft=closed, eyeBlinkRight=closed))
    for side, ball in anatomy.eyeballs.items():
        margins = np.concatenate(getattr(lids, f"{side}_eye"))
        distance = np.linalg.norm(margins - ball.centre, axis=1) - ball.radius
        assert distance.min() > CLEARANCE - 1e-9
        assert CLEARANCE >= 1e-4


@pytest.mark.parametrize("seed", [None, 0, 1, 2, 3, 4])
def test_the_skin_round_the_openings_is_in_front_of_the_eyeballs(seed: int | None) -> None:
    face = pdeface.neutral() if seed is None else pdeface.random(seed)
    points = skin(face, ("right_eye", "left_eye"))
    for ball in anatomy_of(face).eyeballs.values():
        distance = np.linalg.norm(points - ball.centre, axis=1) - ball.radius
        assert distance.min() > 1e-4


def test_a_lid_that_reaches_far_back_pushes_the_eyeball_back(rest: Outline) -> None:
    deep = rest.less(Outline(*[np.broadcast_to((0.0, 0.0, 0.01), (2, SAMPLES, 3))] * 3))
    near, far = placed(rest), placed(rest, [deep])
    for side in ("left", "right"):
        moved = far.eyeballs[side].centre - near.eyeballs[side].centre
        np.testing.assert_allclose(moved, (0.0, 0.0, -0.01), atol=2e-3)
        assert moved[2] < 0.0


@pytest.mark.parametrize(
    ("look", "side", "direction"),
    [
        ("eyeLookInLeft", "left", (-1, 0)),
        ("eyeLookOutLeft", "left", (1, 0)),
        ("eyeLookInRight", "right", (1, 0)),
        ("eyeLookOutRight", "right", (-1, 0)),
        ("eyeLookUpLeft", "left", (0, 1)),
        ("eyeLookDownRight", "right", (0, -1)),
    ],
)
def test_eyes_turn_thirty_degrees(
    neutral: Anatomy, rest: Outline, look: str, side: str, direction: tuple[int, int]
) -> None:
    still = rest.less(rest)
    name = f"{side}_eyeball"
    turned = neutral.curves(name) + neutral.moved(name, still, {look: 1.0})
    ball = neutral.eyeballs[side]
    gaze = (turned[0].mean(axis=0) - ball.centre) / ball.radius
    expected = [*(0.5 * np.array(direction)), np.cos(np.radians(30.0))]
    np.testing.assert_allclose(gaze, expected, atol=1e-6)
    other = "left_eyeball" if side == "right" else "right_eyeball"
    assert not neutral.moved(other, still, {look: 1.0}).any()


def test_the_eyeball_is_a_sphere(neutral: Anatomy) -> None:
    part, ball = PARTS["left_eyeball"], neutral.eyeballs["left"]
    vertices = part.positions(neutral.curves("left_eyeball"))
    away = np.linalg.norm(vertices - ball.centre, axis=1)
    seen = vertices[:, 2] > ball.centre[2] - 0.5 * ball.radius
    assert np.abs(away - ball.radius)[seen].max() < 3e-6
    # Wider than a real one, as ICT-FaceKit's is.
    assert 0.010 < ball.radius < 0.017
