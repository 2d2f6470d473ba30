"""Shape controls: what they are called, what they move, what they leave alone, and no folds."""

from __future__ import annotations

import re
from functools import cache
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from pdeface.controls.shape import COMBINABLE_RANGE, SHAPE_CONTROLS, displacement
from pdeface.curves import mirror_points
from pdeface.errors import InputError
from pdeface.pde import GridEvaluator, PDESurface
from pdeface.template import LEVELS, feature_points, neutral_curves, row_u

ASKED_FOR = {
    "frontal": "foreheadProtrusion foreheadHeight foreheadWidth browRidge",
    "orbital": "eyeSize eyeSpacing eyeDepth eyeTilt",
    "nasal": "noseLength noseWidth noseBridgeHeight noseTipProjection noseTipRotation nostrilWidth",
    "zygomatic": "cheekboneWidth cheekFullness",
    "maxilla": "mouthWidth upperLipFullness lowerLipFullness philtrumLength",
    "mandible": "jawWidth jawAngle chinProtrusion chinHeight chinWidth",
    "head": "faceWidth faceHeight faceDepth asymmetry",
}
NAMES = list(SHAPE_CONTROLS)
MM = 1e-3
SIDES = np.array([-1.0, 1.0, 1.0])
DENSE = (109, 161)


@cache
def on_mesh(shape: tuple[int, int], mesh: tuple[int, int] = DENSE) -> GridEvaluator:
    return GridEvaluator(shape, np.linspace(0, 1, mesh[0]), np.linspace(0, np.pi, mesh[1]))


@cache
def moved(name: str, level: str = "28x46", mesh: tuple[int, int] = DENSE) -> np.ndarray:
    """(U, V, 3) displacement of the surface at +1."""
    shape = LEVELS[level]
    return on_mesh(shape, mesh).positions(displacement(name, shape))


@cache
def neutral(level: str = "28x46", mesh: tuple[int, int] = DENSE) -> np.ndarray:
    curves = neutral_curves(level)
    return on_mesh(curves.shape, mesh).positions(curves.points)


def folds(grid: np.ndarray) -> int:
    """Cells whose two triangles face opposite ways."""
    a, b, c, d = grid[:-1, :-1], grid[1:, :-1], grid[1:, 1:], grid[:-1, 1:]
    first, second = np.cross(b - a, c - a), np.cross(c - a, d - a)
    return int(((first * second).sum(axis=-1) < 0.0).sum())


def test_every_control_that_was_asked_for_is_there_in_its_group() -> None:
    for group, names in ASKED_FOR.items():
        assert [SHAPE_CONTROLS[name].group for name in names.split()] == [group] * len(
            names.split()
        )
    assert {control.group for control in SHAPE_CONTROLS.values()} == set(ASKED_FOR)
    for name, control in SHAPE_CONTROLS.items():
        assert (control.name, control.kind, control.low, control.high) == (name, "shape", -1, 1)
        assert control.description


@pytest.mark.parametrize(
    ("name", "shape", "message"),
    [
        ("noseLenght", (28, 46), "noseLength"),
        ("NOSEWIDTH", (28, 46), "noseWidth"),
        ("xyzzy", (28, 46), "foreheadProtrusion, foreheadHeight"),
        ("noseLength", (28, 45), "even number"),
        ("noseLength", (1, 46), "2 curves"),
    ],
)
def test_what_cannot_be_is_refused_with_advice(name, shape, message) -> None:
    with pytest.raises(InputError, match=message):
        displacement(name, shape)


@pytest.mark.parametrize("shape", [*LEVELS.values(), (82, 60), (40, 46)])
def test_a_displacement_is_closed_by_reflection_cached_and_read_only(shape) -> None:
    for name in NAMES:
        points = displacement(name, shape)
        assert points.shape == (*shape, 3)
        assert np.isfinite(points).all()
        assert np.array_equal(points, mirror_points(points[:, : shape[1] // 2], 0.0))
        assert points is displacement(name, shape)
        with pytest.raises(ValueError, match="read-only"):
            points[0, 0, 0] = 1.0


def test_nothing_is_torn_from_the_plane_of_reflection() -> None:
    """A place moves forward by a share of its distance to the plane; on it, not at all."""
    curves = neutral_curves("109x184")
    depth = curves.half[..., 2] - curves.mirror_z
    for name in NAMES:
        forward = displacement(name, curves.shape)[:, :92, 2]
        assert (np.abs(forward) <= 0.25 * depth).all(), name


@pytest.mark.parametrize("level", LEVELS)
def test_both_sides_of_the_face_do_the_same(level: str) -> None:
    for name in NAMES:
        half = displacement(name, LEVELS[level])[:, : LEVELS[level][1] // 2]
        sign = -1.0 if name == "asymmetry" else 1.0
        np.testing.assert_allclose(half, sign * SIDES * half[:, ::-1], rtol=0, atol=1e-12)
    # Which makes the crooked face at -1 the mirror image of the one at +1.


@given(st.dictionaries(st.sampled_from(NAMES), st.floats(-1, 1), min_size=1, max_size=6))
def test_the_surface_is_linear_in_every_control(weights: dict[str, float]) -> None:
    curves = neutral_curves()
    together = sum(w * displacement(name, curves.shape) for name, w in weights.items())
    surface = PDESurface(curves.points + together)(0.37, np.linspace(0, np.pi, 9))
    parts = sum(
        w * PDESurface(displacement(n, curves.shape))(0.37, np.linspace(0, np.pi, 9))
        for n, w in weights.items()
    )
    alone = PDESurface(curves.points)(0.37, np.linspace(0, np.pi, 9))
    np.testing.assert_allclose(surface, alone + parts, rtol=0, atol=1e-13)


@pytest.mark.parametrize(("level", "tolerance"), [("28x46", 0.4), ("55x92", 0.25)])
def test_a_control_does_the_same_at_every_level(level: str, tolerance: float) -> None:
    for name in NAMES:
        difference = np.linalg.norm(moved(name, level) - moved(name, "109x184"), axis=-1)
        assert difference.max() < tolerance * MM, name
        assert np.sqrt((difference**2).mean()) < 0.15 * tolerance * MM, name


class Area(NamedTuple):
    """Part of the face by rows of the paper and distance from the midline, mm."""

    rows: tuple[float, float]
    aside: tuple[float, float]

    def of(self, level: str) -> np.ndarray:
        rows = np.linspace(0, 27, DENSE[0])[:, None]
        aside = np.abs(neutral(level)[..., 0]) / MM
        return (
            (rows >= self.rows[0])
            & (rows <= self.rows[1])
            & (aside >= self.aside[0])
            & (aside <= self.aside[1])
        )


AREAS = {
    "forehead": Area((0, 1), (0, 99)),
    "eyes": Area((7, 9), (17, 47)),
    "nose": Area((12, 14.5), (0, 16)),
    "mouth": Area((17, 20), (0, 25)),
    "chin": Area((23, 27), (0, 25)),
    "jaw": Area((22, 27), (45, 99)),
}
STAYS = 0.01
"""What a local control leaves alone moves by less, mm, on the surface between data points, too."""

NEAR = 0.5
"""What lies beside what it moves: smooth, no window ends at once."""

STILL = {
    "foreheadProtrusion": "eyes nose mouth chin jaw",
    "foreheadHeight": "eyes nose mouth chin jaw",
    "foreheadWidth": "nose mouth chin jaw",
    "browRidge": "nose mouth chin jaw",
    "eyeSize": "mouth chin jaw",
    "eyeSpacing": "mouth chin jaw",
    "eyeDepth": "mouth chin jaw",
    "eyeTilt": "mouth chin jaw",
    "noseLength": "chin jaw",
    "noseWidth": "forehead chin jaw",
    "noseBridgeHeight": "forehead mouth chin jaw",
    "noseTipProjection": "forehead chin jaw",
    "noseTipRotation": "forehead chin jaw",
    "nostrilWidth": "forehead chin jaw",
    "cheekboneWidth": "mouth chin",
    "cheekFullness": "forehead chin",
    "mouthWidth": "forehead eyes",
    "mouthProtrusion": "forehead eyes",
    "upperLipFullness": "forehead eyes chin jaw",
    "lowerLipFullness": "forehead eyes nose jaw",
    "philtrumLength": "forehead eyes",
    "jawWidth": "forehead eyes",
    "jawAngle": "forehead eyes nose",
    "chinProtrusion": "forehead eyes nose",
    "chinHeight": "forehead eyes nose",
    "chinWidth": "forehead eyes nose",
}
HARDLY = {
    "foreheadWidth": "eyes",
    "browRidge": "eyes",
    "eyeTilt": "nose",
    "eyeSize": "nose",
    "eyeSpacing": "nose",
    "noseLength": "eyes mouth",
    "noseWidth": "eyes mouth",
    "noseTipProjection": "eyes mouth",
    "noseTipRotation": "eyes mouth",
    "nostrilWidth": "eyes mouth",
    "mouthWidth": "nose",
    "mouthProtrusion": "nose",
    "philtrumLength": "nose",
    "cheekFullness": "eyes mouth nose",
    "jawWidth": "nose mouth chin",
    "jawAngle": "mouth chin",
    "chinProtrusion": "mouth",
    "chinHeight": "mouth",
    "chinWidth": "mouth",
}


def test_every_local_control_has_something_that_it_leaves_alone() -> None:
    assert set(NAMES) - set(STILL) == {"faceWidth", "faceHeight", "faceDepth", "asymmetry"}


@pytest.mark.parametrize("level", LEVELS)
@pytest.mark.parametrize("name", STILL)
def test_a_local_control_leaves_the_rest_alone(name: str, level: str) -> None:
    distance = np.linalg.norm(moved(name, level), axis=-1) / MM
    assert distance.max() > 2.0
    for area in STILL[name].split():
        assert distance[AREAS[area].of(level)].max() < STAYS, area
    for area in HARDLY.get(name, "").split():
        assert distance[AREAS[area].of(level)].max() < NEAR, area


def at(name: str, weight: float, row: str, v: float = 0.5) -> np.ndarray:
    """Place of a named row and v / pi on the face with one control."""
    curves = neutral_curves("55x92")
    points = curves.points + weight * displacement(name, curves.shape)
    return PDESurface(points)(row_u(row), np.pi * v) / MM


def place(name: str, weight: float, feature: str) -> np.ndarray:
    curves = neutral_curves("55x92")
    points = curves.points + weight * displacement(name, curves.shape)
    return PDESurface(points)(*feature_points()[feature]) / MM


X, Y, Z = 0, 1, 2
LEFT_LIDS = {"inner": 0.605, "outer": 0.77}
# Name of the control: what it makes greater, mm, and by how much at least from 0 to +1.
MAKES_GREATER = {
    "foreheadProtrusion": (lambda at, f: at("forehead_upper")[Z] - at("brow")[Z], 5),
    "foreheadHeight": (lambda at, f: at("forehead_top")[Y] - at("brow")[Y], 10),
    "foreheadWidth": (lambda at, f: at("forehead_upper", 0.95)[X], 6),
    "browRidge": (lambda at, f: at("brow", 0.65)[Z], 3),
    "eyeSize": (lambda at, f: at("upper_lid_margin", 0.68)[Y] - at("lower_lid_margin", 0.68)[Y], 1),
    "eyeSpacing": (lambda at, f: f("left_eye_middle")[X] - f("right_eye_middle")[X], 8),
    "eyeDepth": (lambda at, f: f("brow_centre")[Z] - f("left_eye_middle")[Z], 3),
    "eyeTilt": (
        lambda at, f: at("mid_eye", LEFT_LIDS["outer"])[Y] - at("mid_eye", LEFT_LIDS["inner"])[Y],
        3,
    ),
    "noseLength": (lambda at, f: at("upper_lid_fold")[Y] - at("subnasale")[Y], 5),
    "noseWidth": (lambda at, f: at("nostrils", 0.58)[X] - at("nostrils", 0.42)[X], 3),
    "noseBridgeHeight": (lambda at, f: at("lower_lid_margin")[Z] - at("brow")[Z], 4),
    "noseTipProjection": (lambda at, f: f("nose_tip")[Z] - at("philtrum")[Z], 5),
    "noseTipRotation": (lambda at, f: f("nose_tip")[Y] - at("subnasale")[Y], 3),
    "nostrilWidth": (lambda at, f: f("left_nostril")[X] - f("right_nostril")[X], 4),
    "cheekboneWidth": (lambda at, f: at("lower_lid_fold", 0.85)[X], 4),
    "cheekFullness": (lambda at, f: at("subnasale", 0.72) @ (0.6, 0.0, 0.8), 5),
    "mouthWidth": (lambda at, f: f("left_mouth_corner")[X] - f("right_mouth_corner")[X], 8),
    "mouthProtrusion": (lambda at, f: f("mouth_centre")[Z] - at("chin")[Z], 4),
    "upperLipFullness": (lambda at, f: at("upper_lip_border")[Y] - at("mouth_seam_upper")[Y], 0.9),
    "lowerLipFullness": (lambda at, f: at("mouth_seam_lower")[Y] - at("lower_lip_border")[Y], 0.9),
    "philtrumLength": (lambda at, f: at("subnasale")[Y] - at("upper_lip_border")[Y], 3),
    "jawWidth": (lambda at, f: at("chin_fold", 0.95)[X], 6),
    "jawAngle": (lambda at, f: -at("chin_lower", 0.9)[Y], 6),
    "chinProtrusion": (lambda at, f: at("chin")[Z] - at("lower_lip_border")[Z], 6),
    "chinHeight": (lambda at, f: at("lower_lip_border")[Y] - at("under_chin")[Y], 7),
    "chinWidth": (lambda at, f: f("chin_4")[X] - f("chin_2")[X], 8),
    "faceWidth": (lambda at, f: f("left_cheek")[X] - f("right_cheek")[X], 10),
    "faceHeight": (lambda at, f: at("forehead_top")[Y] - at("under_chin")[Y], 15),
    "faceDepth": (lambda at, f: f("nose_tip")[Z] - at("mid_eye", 0.0)[Z], 12),
    "asymmetry": (lambda at, f: f("nose_tip")[X] + at("chin")[X], 5),
}


def measured(name: str, weight: float) -> float:
    measure, _ = MAKES_GREATER[name]
    return measure(lambda row, v=0.5: at(name, weight, row, v), lambda f: place(name, weight, f))


@pytest.mark.parametrize("name", NAMES)
def test_a_control_does_what_its_name_says(name: str) -> None:
    _, least = MAKES_GREATER[name]
    low, middle, high = (measured(name, weight) for weight in (-1.0, 0.0, 1.0))
    assert high - middle >= least
    assert middle - low >= least


def test_the_docs_list_every_control_and_how_much_it_does(root: Path) -> None:
    text = (root / "docs" / "shape-controls.md").read_text(encoding="utf-8")
    rows = re.findall(r"^\| `(\w+)` \| (\w+) \| (.+?) \| ([\d.]+) \|", text, re.MULTILINE)
    assert [row[:3] for row in rows] == [
        (control.name, control.group, control.description) for control in SHAPE_CONTROLS.values()
    ]
    for name, _, _, amount in rows:
        assert measured(name, 1.0) - measured(name, 0.0) == pytest.approx(float(amount), abs=0.06)


@pytest.mark.parametrize("level", LEVELS)
def test_the_head_is_scaled_exactly(level: str) -> None:
    curves = neutral_curves("28x46")
    deep = displacement("faceDepth", curves.shape)
    np.testing.assert_allclose(deep[..., 2], 0.14 * (curves.points[..., 2] - curves.mirror_z))
    wide = moved("faceWidth", level)
    np.testing.assert_allclose(wide[..., 0], 0.12 * neutral()[..., 0], rtol=0, atol=2e-5)
    assert np.abs(wide[..., 1:]).max() < 1e-12


@pytest.mark.parametrize("level", LEVELS)
def test_the_lids_move_as_one_with_what_lies_between_them(level: str) -> None:
    """An eyeball behind them is moved in the same way: nearly rigidly, or scaled."""
    eye = AREAS["eyes"].of(level) & (np.linspace(0, np.pi, DENSE[1]) > np.pi / 2)
    for name in ("eyeSpacing", "eyeDepth", "eyeTilt", "eyeSize"):
        places, steps = neutral(level)[eye], moved(name, level)[eye]
        affine = np.column_stack([places, np.ones(len(places))])
        solution, *_ = np.linalg.lstsq(affine, steps, rcond=None)
        # Corners of the eye stay back a little.
        error = np.linalg.norm(steps - affine @ solution, axis=1)
        assert np.sqrt((error**2).mean()) < 0.3 * MM, name
    spread = np.ptp(moved("eyeSpacing", level)[eye][:, 0])
    assert spread < 1.3 * MM


@pytest.mark.parametrize("level", LEVELS)
def test_eyes_and_mouth_stay_in_order(level: str) -> None:
    rows = {
        n: round(row_u(n) * (DENSE[0] - 1))
        for n in (
            "upper_lid_margin",
            "mid_eye",
            "lower_lid_margin",
            "mouth_seam_upper",
            "mouth_seam_lower",
        )
    }
    lips = np.abs(neutral(level)[rows["mouth_seam_upper"], :, 0]) < 27 * MM
    for name in NAMES:
        for weight in (-1.0, 1.0):
            y = (neutral(level) + weight * moved(name, level))[..., 1]
            lids = [y[rows[n]] for n in ("upper_lid_margin", "mid_eye", "lower_lid_margin")]
            assert (lids[0] > lids[1]).all() and (lids[1] > lids[2]).all(), name
            gap = y[rows["mouth_seam_upper"]] - y[rows["mouth_seam_lower"]]
            assert gap[lips].min() > 0.9 * MM, name


@pytest.mark.parametrize("level", LEVELS)
@pytest.mark.parametrize("mesh", [(28, 41), DENSE, (541, 321)])
def test_no_control_folds_the_face_at_either_end(level: str, mesh: tuple[int, int]) -> None:
    curves = neutral_curves(level)
    evaluator = on_mesh(curves.shape, mesh)
    for name in NAMES:
        step = evaluator.positions(displacement(name, curves.shape))
        assert [folds(neutral(level, mesh) + w * step) for w in (-1.0, 1.0)] == [0, 0], name


def test_combinations_within_the_documented_range_do_not_fold() -> None:
    """Sixty of the 2,000 that ``python -m benchmarks.combinations`` tries."""
    steps = np.stack([moved(name) for name in NAMES])
    rng = np.random.default_rng(7)
    for weights in rng.uniform(-COMBINABLE_RANGE, COMBINABLE_RANGE, (60, len(NAMES))):
        assert folds(neutral() + np.tensordot(weights, steps, 1)) == 0
