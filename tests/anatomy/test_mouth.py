"""Mouth, teeth and tongue."""

from __future__ import annotations

import numpy as np
import pytest

import pdeface
from pdeface.anatomy import PARTS, Anatomy, Margins, Outline, placed
from pdeface.anatomy.measured import Frame, jaw_motion, reference

from .conftest import anatomy_of, outline, skin

CELL = 6e-4


def skin_depth(face: pdeface.Face) -> dict[tuple[int, int], float]:
    """z of the skin, where it is foremost, by cell of x and y; the open mouth left out."""
    points = skin(face, ("mouth",))
    points = points[points[:, 2].argsort()]
    cells = map(tuple, np.rint(points[:, :2] / CELL).astype(int).tolist())
    return dict(zip(cells, points[:, 2].tolist(), strict=True))


@pytest.mark.parametrize("jaw", [0.0, 1.0])
@pytest.mark.parametrize("seed", [None, 0, 1, 2, 3, 4])
def test_nothing_shows_in_front_of_the_skin(seed: int | None, jaw: float) -> None:
    face = pdeface.neutral() if seed is None else pdeface.random(seed)
    opened = face.set(jawOpen=jaw)
    anatomy, front = anatomy_of(face), skin_depth(opened)
    motion = outline(opened).less(outline(face))
    hidden = 0
    for name in ("mouth", "upper_teeth", "lower_teeth", "tongue"):
        part = PARTS[name]
        curves = anatomy.curves(name) + anatomy.moved(name, motion, {"jawOpen": jaw})
        vertices = part.positions(curves)
        if name == "mouth":  # its first curve is the edge of the skin itself
            vertices = vertices.reshape(part.rows, -1, 3)[4:].reshape(-1, 3)
        cells = map(tuple, np.rint(vertices[:, :2] / CELL).astype(int).tolist())
        depth = np.array([front.get(cell, np.nan) for cell in cells]) - vertices[:, 2]
        covered = np.isfinite(depth)
        assert (depth[covered] > 0.0).all(), name
        hidden += int(covered.sum())
    assert hidden > 1000


def test_the_lips_touch_behind_their_margins_at_rest(rest: Outline) -> None:
    apart = Outline(
        rest.right_eye, rest.left_eye, Margins(rest.mouth.upper, rest.mouth.lower - (0, 1e-3, 0))
    )
    curves = placed(apart).curves("mouth")
    width = np.abs(curves - curves[:, ::-1])[:, :, 1].max(axis=1)
    assert width[0] > 9e-4
    assert width[2] < 1e-12


def test_the_jaw_takes_the_lower_teeth_along(neutral: Anatomy, rest: Outline) -> None:
    still = rest.less(rest)
    opened = neutral.moved("lower_teeth", still, {"jawOpen": 1.0})
    assert opened[:, :, 1].min() < -0.025
    assert not neutral.moved("upper_teeth", still, {"jawOpen": 1.0}).any()
    left = neutral.moved("lower_teeth", still, {"jawLeft": 1.0})
    assert left[:, :, 0].mean() > 0.002


def test_jaw_motions_scale_with_the_head() -> None:
    mouth = reference().mouth
    frame = Frame.between(mouth, mouth)
    points = np.concatenate(mouth)
    twice = Frame(frame.origin, frame.centre, 2.0)
    moved = jaw_motion(points, frame, {"jawOpen": 1.0})
    np.testing.assert_allclose(
        jaw_motion(twice(points), twice, {"jawOpen": 1.0}), 2.0 * moved, atol=1e-15
    )


def test_the_tongue_comes_out_between_the_lips(neutral: Anatomy, rest: Outline) -> None:
    face = pdeface.neutral().set(jawOpen=0.6)
    moved = outline(face).less(rest)
    weights = {"jawOpen": 0.6, "tongueOut": 1.0}
    curves = neutral.curves("tongue") + neutral.moved("tongue", moved, weights)
    lips = outline(face).mouth
    tip = curves[-1].mean(axis=0)
    front = np.concatenate(lips)[:, 2].max()
    assert tip[2] > front + 0.005
    lower = lips.lower[len(lips.lower) // 2]
    through = curves[np.abs(curves[:, :, 2].mean(axis=1) - lower[2]).argmin()]
    assert lips.upper[len(lips.upper) // 2, 1] > through[:, 1].mean() > lower[1]
