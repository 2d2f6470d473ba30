"""Measured controls: names, ranges, linearity, and what they do to the face."""

from __future__ import annotations

from functools import cache
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import pdeface
from pdeface import controls
from pdeface.controls import CONTROLS
from pdeface.controls.seams import seam
from pdeface.errors import InputError
from pdeface.face import random
from pdeface.pde import PDESurface

EXPRESSIONS = [c.name for c in CONTROLS.values() if c.kind == "expression"]
U, V = np.linspace(0, 1, 55)[:, None], np.linspace(0, np.pi, 81)


@cache
def alone(name: str) -> np.ndarray:
    """Displacement of the surface by one control at full weight."""
    return positions(**{name: 1.0}) - positions()


def positions(**weights: float) -> np.ndarray:
    return pdeface.neutral().set(**weights).surface()(U, V)


def test_the_names_are_arkits(shared_data: Path) -> None:
    assert list(controls.ARKIT) == (shared_data / "arkit52.txt").read_text().split()
    assert list(controls.ARKIT) == EXPRESSIONS


@pytest.mark.parametrize("name", EXPRESSIONS)
def test_the_surface_is_linear_in_every_weight(name: str) -> None:
    for weight in (0.1, 0.5, 0.9):
        moved = positions(**{name: weight}) - positions()
        np.testing.assert_allclose(moved, weight * alone(name), atol=1e-13)


TOGETHER = {"eyeBlinkLeft", "eyeBlinkRight", "mouthClose"}
"""What these add depends on what else there is."""
LIPS = [n for n in EXPRESSIONS if n.startswith(("mouth", "jaw", "cheek", "nose"))]


@given(
    st.dictionaries(
        st.sampled_from(sorted(set(EXPRESSIONS) - TOGETHER)), st.floats(0, 1), min_size=1
    )
)
def test_expressions_add(weights: dict[str, float]) -> None:
    together = positions(**weights) - positions()
    one_by_one = sum(w * alone(name) for name, w in weights.items())
    np.testing.assert_allclose(together, one_by_one, atol=1e-13)


@given(st.dictionaries(st.sampled_from(EXPRESSIONS), st.floats(0, 1), min_size=1, max_size=5))
def test_measured_displacements_add(weights: dict[str, float]) -> None:
    together = controls.displacement(weights, (28, 46))
    for part in (0, 1):
        added = sum(w * controls.displacement({n: 1.0}, (28, 46))[part] for n, w in weights.items())
        np.testing.assert_allclose(together[part], added, atol=1e-13)


@given(st.dictionaries(st.sampled_from(LIPS), st.floats(0, 1), min_size=1))
def test_lips_do_not_cross(weights: dict[str, float]) -> None:
    weights.pop("jawOpen", None)
    moved = pdeface.neutral("55x92").set(**weights).displacement
    upper, lower = moved.margins[2]
    gap = seam("mouth", (55, 92)).gap(moved.smooth, moved.parting) + upper - lower
    assert gap[:, 1].min() > -1e-9


@pytest.mark.parametrize("level", ["28x46", "55x92"])
@pytest.mark.parametrize("seed", [None, 0, 1, 2])
@pytest.mark.parametrize("others", [{}, {"eyeSquintLeft": 1.0}, {"eyeWideLeft": 1.0}], ids=str)
def test_a_full_blink_closes_the_eye_of_anyone(level: str, seed, others) -> None:
    face = pdeface.neutral(level) if seed is None else random(seed, level)
    moved = face.set(eyeBlinkLeft=1.0, **others).displacement
    lids = seam("left_eye", face.curves.shape)
    upper, lower = lids.lines(face.curves.points + moved.smooth, moved.parting) + moved.margins[1]
    np.testing.assert_allclose(upper, lower, rtol=0, atol=1e-12)


def test_a_blink_closes_in_proportion() -> None:
    face, size = pdeface.random(1).set(eyeWideRight=1.0, eyeLookDownRight=0.4), (28, 46)
    lids = seam("right_eye", size)
    gaps = []
    for blink in (0.0, 0.25, 0.5, 1.0):
        moved = face.set(eyeBlinkRight=blink).displacement
        gap = lids.gap(face.curves.points + moved.smooth, moved.parting)
        gaps.append(gap + np.subtract(*moved.margins[0]))
    for blink, gap in zip((0.25, 0.5, 1.0), gaps[1:], strict=True):
        np.testing.assert_allclose(gap, (1 - blink) * gaps[0], atol=1e-12)


def test_a_mouth_closes_what_is_open() -> None:
    shut = pdeface.neutral().set(jawOpen=0.5, mouthClose=1.0)
    assert shut.displacement.parting.any()
    same = shut.set(mouthClose=0.5)
    np.testing.assert_array_equal(shut.moved_curves.points, same.moved_curves.points)
    alone = pdeface.neutral().set(mouthClose=1.0).moved_curves
    assert alone == pdeface.neutral().curves


@pytest.mark.parametrize("level", ["28x46", "55x92", "109x184"])
def test_every_expression_moves_and_its_two_sides_mirror_each_other(level: str) -> None:
    shape = pdeface.neutral(level).curves.shape
    half = shape[1] // 2
    for name in EXPRESSIONS:
        if name == "tongueOut":  # which moves nothing of the face itself
            continue
        moved = sum(controls.displacement({name: 1.0}, shape)[:2])
        assert 5e-4 < np.abs(moved).max() < 0.06, name
        if name.endswith("Left") and name not in ("jawLeft", "mouthLeft"):
            other = sum(controls.displacement({name.replace("Left", "Right"): 1.0}, shape)[:2])
            mirrored = other[:, :half][:, ::-1] * [-1, 1, 1]
            # The source's two sides are not to the last bit the same.
            assert np.abs(moved[:, :half] - mirrored).max() < 0.15 * np.abs(moved).max(), name


@pytest.mark.parametrize("level", ["28x46", "55x92", "109x184"])
def test_displaced_curves_stay_closed_by_their_reflection(level: str) -> None:
    face = random(7, level).set(jawOpen=0.5, eyeBlinkLeft=1.0)
    points, mirror_z = face.moved_curves.points, face.curves.mirror_z
    reflected = points[:, ::-1] * [1, 1, -1] + [0, 0, 2 * mirror_z]
    np.testing.assert_allclose(points, reflected, atol=1e-12)


def test_mesh_and_surface_agree_where_the_face_parts() -> None:
    face = pdeface.neutral().set(jawOpen=1.0, eyeBlinkRight=0.7, mouthSmileLeft=0.3)
    mesh = face.mesh(109, 161, openings="none")
    u, v = np.linspace(0, 1, 109)[:, None], np.linspace(0, np.pi, 161)
    surface = face.surface()
    np.testing.assert_allclose(mesh.vertices.reshape(109, 161, 3), surface(u, v), atol=1e-12)
    np.testing.assert_allclose(mesh.normals.reshape(109, 161, 3), surface.normal(u, v), atol=1e-9)


def test_parting_lips_move_without_dragging_each_other() -> None:
    # What the lower lip is displaced by alone must not reach the upper one, nor the nose.
    shape = (28, 46)
    parting = np.array(controls.displacement({"jawOpen": 1.0}, shape).parting)
    parting[:19] = 0.0
    surface = PDESurface(parting, continuity=controls.slits(28))
    above = surface(np.linspace(0, 18 / 27, 60)[:, None], V, side="before")
    assert np.abs(above).max() < 1e-15
    assert np.abs(parting[19]).max() > 0.002


def test_a_blink_closes_the_eye_and_leaves_the_other_open() -> None:
    def gap(v: float, **weights: float) -> float:
        surface = pdeface.neutral("55x92").set(**weights).surface()
        upper, lower = (surface(r / 27, v) for r in (7, 9))
        return float(upper[1] - lower[1])

    left, right = 0.69 * np.pi, 0.31 * np.pi
    assert gap(left) > 0.009
    assert abs(gap(left, eyeBlinkLeft=1.0)) < 0.0004
    assert gap(right, eyeBlinkLeft=1.0) == pytest.approx(gap(right), abs=1e-4)


def test_jaw_open_opens_the_mouth_downwards() -> None:
    before, after = (pdeface.neutral().set(jawOpen=w).surface() for w in (0.0, 1.0))
    midline = np.pi / 2
    upper, lower = ((after(r / 27, midline) - before(r / 27, midline))[1] for r in (18, 19))
    # The source's upper lip follows by 2.45 mm; no overshoot may add to it.
    assert upper == pytest.approx(-0.00245, abs=2e-4)
    assert lower == pytest.approx(-0.0352, abs=5e-4)


def test_random_people_differ_and_the_same_seed_is_the_same_person() -> None:
    assert random(1) == random(1)
    assert np.abs(random(1).moved_curves.points - random(2).moved_curves.points).max() > 0.003
    assert all(abs(weight) <= 3 for weight in random(3).weights.values())


def test_set_returns_a_new_face_and_zero_takes_a_control_away() -> None:
    face = pdeface.neutral()
    open_mouth = face.set(jawOpen=0.5)
    assert face.weights == {}
    assert open_mouth.weights == {"jawOpen": 0.5}
    assert open_mouth.set(jawOpen=0.0) == face
    assert {c.name: w for c, w in open_mouth.controls}["jawOpen"] == 0.5


@pytest.mark.parametrize(
    ("weights", "message"),
    [
        ({"jawOpn": 1.0}, "no control is called 'jawOpn'; did you mean jawOpen"),
        ({"jawOpen": 1.5}, r"jawOpen must lie in \[0, 1\], got 1.5"),
        ({"jawOpen": float("nan")}, "jawOpen must be a finite number, got nan"),
        ({"jawOpen": "wide"}, "jawOpen must be a finite number, got 'wide'"),
        ({"identity01": -3.1}, r"identity01 must lie in \[-3, 3\]"),
    ],
)
def test_what_is_no_weight_is_said(weights: dict[str, object], message: str) -> None:
    with pytest.raises(InputError, match=message):
        pdeface.neutral().set(**weights)


def test_clamping_is_on_request() -> None:
    assert pdeface.neutral().set(clamp=True, jawOpen=1.5).weights == {"jawOpen": 1.0}


def test_a_face_of_other_curves_cannot_part_and_says_so() -> None:
    curves = pdeface.BoundaryCurves(pdeface.neutral().curves.points[:27])
    with pytest.raises(InputError, match="a face that moves needs 27 n"):
        pdeface.Face(curves, weights={"jawOpen": 1.0}).mesh()


def test_weights_survive_saving(tmp_path: Path) -> None:
    face = random(5).set(eyeBlinkLeft=0.25)
    face.save(tmp_path / "a.pdeface")
    assert pdeface.load(tmp_path / "a.pdeface") == face
