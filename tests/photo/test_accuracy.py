"""The benchmark's distances: none from a face itself however it is placed, known ones otherwise."""

from __future__ import annotations

import numpy as np
import pytest

pytest.importorskip("scipy", reason="needs the extra 'template'")
pytest.importorskip("vtk", reason="needs the extra 'render'")

from benchmarks.accuracy.scans import in_sight
from benchmarks.accuracy.scoring import REGIONS, Scan, Score

import pdeface
from pdeface.template import feature_points

NAMES = ("right_eye_middle", "left_eye_middle", "nose_tip", "right_mouth_corner",
         "left_mouth_corner", "right_cheek", "left_cheek")  # fmt: skip


def scan(face: pdeface.Face, scale: float = 1.0, lifted: float = 0.0) -> Scan:
    """Points of a face, a given distance above its skin, turned and moved away."""
    rng = np.random.default_rng(0)
    uv = np.column_stack([rng.uniform(0.03, 0.9, 3000), rng.uniform(0.5, np.pi - 0.5, 3000)])
    marks = np.array([feature_points()[name] for name in NAMES])
    surface = face.surface()
    c, s = np.cos(0.2), np.sin(0.2)
    turn = scale * np.array([[c, 0.0, s], [0.0, 1.0, 0.0], [-s, 0.0, c]])
    points, seven = (
        (surface(*at.T) + lifted * surface.normal(*at.T)) @ turn.T + 0.1 for at in (uv, marks)
    )
    return Scan(points, uv, seven, marks)


def test_a_face_is_no_distance_from_itself() -> None:
    score = Score(pdeface.random(3), scan(pdeface.random(3), scale=1.07))
    assert np.percentile(score.all, 95) < 5e-5
    assert set(score.regions) == set(REGIONS)
    assert max(np.median(region) for region in score.regions.values()) < 5e-5


def test_without_scale_a_larger_head_is_far_away() -> None:
    truth = scan(pdeface.neutral(), scale=1.07)
    assert Score(pdeface.neutral(), truth, scaled=False).all.mean() > 5e-4


def test_another_person_is_further_away_than_the_person() -> None:
    truth = scan(pdeface.random(3))
    assert Score(pdeface.random(4), truth).all.mean() > 5e-4


def test_what_lies_behind_the_surface_is_not_in_sight() -> None:
    grid = np.stack(np.meshgrid(np.arange(20.0), np.arange(20.0), [0.0]), -1).reshape(-1, 3) * 5e-4
    points = np.array([[5e-3, 5e-3, 0.0], [5e-3, 5e-3, -8e-3], [9e-2, 5e-3, -8e-3]])
    assert in_sight(points, grid).tolist() == [True, False, True]
