"""A known person's scan in, the person's curves out."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import pdeface
from pdeface.errors import InputError
from pdeface.scan import Landmarks, fit_scan, make_scan, measure, texture_of
from pdeface.scan.alignment import align
from pdeface.scan.fields import normals
from pdeface.scan.nearest import Target
from pdeface.template import row_u

from .conftest import scanned

LEVELS = {(28, 46): (0.38, 0.13, 4.5), (55, 92): (0.20, 0.06, 3.0), (109, 184): (0.10, 0.02, 2.2)}


@pytest.fixture(scope="module")
def fitted(known):
    return fit_scan(known.scan, (109, 184), landmarks=known.landmarks, units="m")


@pytest.mark.parametrize("level", LEVELS)
def test_the_surface_lies_on_the_scan(fitted, level) -> None:
    measures = measure(fitted.at_level(*level))
    rms, median, angle = LEVELS[level]
    assert measures.to_scan.rms < rms
    assert measures.to_scan.median < median
    assert measures.normal < angle
    assert measures.to_face.rms < rms
    assert measures.coverage > 0.995  # not all of it: nostrils at a coarse level


@pytest.mark.parametrize(
    ("row", "first", "last"),
    [
        ("upper_lid_margin", 0.8, 1.2),
        ("lower_lid_margin", 0.8, 1.2),
        ("mouth_seam_upper", 1.25, 1.89),
        ("mouth_seam_lower", 1.25, 1.89),
        ("subnasale", 1.4, 1.75),
        ("upper_lip_border", 1.3, 1.85),
    ],
)
def test_rows_lie_on_their_features(fitted, known, row, first, last) -> None:
    v = np.linspace(first, last, 20)
    ours = fitted.face.surface()(row_u(row), v)
    true = known.face.surface()(row_u(row), np.linspace(first - 0.2, last + 0.2, 400))
    true = fitted.scale * true @ fitted.rotation.T + fitted.shift
    away = np.linalg.norm(ours[:, None] - true, axis=2).min(axis=1)
    assert np.sqrt((away**2).mean()) < 0.7e-3


def test_a_scan_without_colours_gives_no_texture(fitted) -> None:
    assert texture_of(fitted) is None


def test_the_fit_is_a_face_like_any_other(fitted, tmp_path) -> None:
    fitted.face.save(tmp_path / "face.pdeface")
    face = pdeface.load(tmp_path / "face.pdeface").set(jawOpen=1.0, eyeBlinkLeft=1.0)
    assert face.curves.is_mirrored
    moved = face.mesh(55, 81).vertices - fitted.face.mesh(55, 81).vertices
    assert 0.01 < np.abs(moved).max() < 0.06


@pytest.mark.parametrize("scale", [1.0, 100.0, 1000.0])
def test_the_unit_is_found_by_the_eyes(known, scale: float) -> None:
    turn = Rotation.random(rng=7).as_matrix()
    shift = scale * np.array([0.3, -2.0, 1.0])
    scan = known.scan.moved(turn, scale, shift)
    points = scale * known.landmarks.points @ turn.T + shift
    landmarks = Landmarks(known.landmarks.uv, points, known.landmarks.trust)
    found = fit_scan(scan, landmarks=landmarks)
    assert found.unit == {1.0: "m", 100.0: "cm", 1000.0: "mm"}[scale]
    assert measure(found).to_scan.rms < LEVELS[(55, 92)][0]


def test_a_scale_that_is_no_unit_puts_the_eyes_where_people_have_them(known) -> None:
    scan = known.scan.moved(np.eye(3), 7.0, np.zeros(3))
    marks = known.landmarks
    found = fit_scan(scan, landmarks=Landmarks(marks.uv, 7.0 * marks.points, marks.trust))
    assert found.unit is None
    assert 7.0 * found.scale == pytest.approx(1.0, abs=0.1)


def test_holes_and_noise_and_shoulders_do_not_matter(known) -> None:
    generator = np.random.default_rng(3)
    vertices = known.scan.vertices + generator.normal(0.0, 0.1e-3, known.scan.vertices.shape)
    hole = np.linalg.norm(vertices - known.face.surface()(0.55, 0.9), axis=1) < 0.012
    scan = make_scan(vertices, known.scan.triangles).part(~hole)
    found = fit_scan(scan, landmarks=known.landmarks, units="m")
    surface = found.face.surface()(0.55, np.linspace(0.8, 1.0, 9))
    true = known.face.surface()(np.linspace(0.45, 0.65, 60)[:, None], np.linspace(0.6, 1.2, 80))
    true = true.reshape(-1, 3) @ found.rotation.T + found.shift
    away = np.linalg.norm(surface[:, None] - true, axis=2).min(axis=1)
    assert away.max() < 2.0e-3
    assert measure(found).to_scan.median < 0.12


def test_a_cloud_is_fitted_like_a_mesh(known) -> None:
    cloud = make_scan(known.scan.vertices)
    found = fit_scan(cloud, landmarks=known.landmarks, units="m")
    assert measure(found).to_scan.rms < 0.25


def test_coarse_triangles_are_fitted_round(known, fitted) -> None:
    coarse = scanned(known.face, 37, 34)
    words = {"landmarks": coarse.landmarks, "units": "m"}
    found = fit_scan(coarse.scan, (109, 184), **words)
    flat = fit_scan(coarse.scan, (109, 184), rounded=False, **words)
    assert found.rounded
    assert not flat.rounded
    assert not fitted.rounded
    # The curved surface goes through the vertices; the flat faces' cuts their corners.
    assert measure(found).to_face.median < 0.8 * measure(flat).to_face.median
    assert measure(flat).to_scan.median < measure(found).to_scan.median


def test_colours_come_along(known) -> None:
    low, high = known.scan.vertices.min(axis=0), known.scan.vertices.max(axis=0)
    colors = np.rint(255 * (known.scan.vertices - low) / (high - low)).astype(np.uint8)
    scan = make_scan(known.scan.vertices, known.scan.triangles, colors=colors)
    found = fit_scan(scan, landmarks=known.landmarks, units="m")
    texture = texture_of(found, 256)
    assert texture is not None
    u, v = np.mgrid[40:220, 40:220] / 256.0
    place = found.face.surface()(u.ravel() + 0.5 / 256, np.pi * (v.ravel() + 0.5 / 256))
    there = (place - found.shift) @ found.rotation
    expected = 255 * (there - low) / (high - low)
    got = texture[40:220, 40:220].reshape(-1, 3)
    assert np.abs(got - expected).mean() < 1.5


@pytest.mark.parametrize("level", [(27, 46), (30, 46), (28, 47), (28, 8), (244, 92), (28, 1000)])
def test_levels_that_there_are_not(known, level) -> None:
    with pytest.raises(InputError, match="try 28x46"):
        fit_scan(known.scan, level, landmarks=known.landmarks)


def test_any_level_that_there_is(fitted) -> None:
    measures = measure(fitted.at_level(82, 120))
    assert measures.to_scan.rms < 0.2


def test_points_that_are_no_face(known) -> None:
    points = np.random.default_rng(0).normal(size=known.landmarks.points.shape)
    wrong = Landmarks(known.landmarks.uv, points, known.landmarks.trust)
    with pytest.raises(InputError, match="no face's"):
        fit_scan(known.scan, landmarks=wrong)


def test_alignment_finds_where_the_face_is(known) -> None:
    turn = Rotation.random(rng=3).as_matrix()
    points = 5.0 * known.landmarks.points @ turn.T + (1.0, 2.0, 3.0)
    found = align(Landmarks(known.landmarks.uv, points, known.landmarks.trust))
    assert found.scale == pytest.approx(0.2, rel=0.06)
    angle = np.degrees(np.arccos((np.trace(found.rotation @ turn) - 1.0) / 2.0))
    assert angle < 3.0


def test_a_fit_can_be_watched(known) -> None:
    """Each round leaves the face nearer to the scan, and the last one on it."""
    rounds = []
    fit_scan(
        known.scan, (28, 46), landmarks=known.landmarks,
        on_round=lambda scan, points: rounds.append((Target(scan), points)),
    )  # fmt: skip
    assert len(rounds) > 12
    away = [np.median(target.nearest(p.reshape(-1, 3), normals(p).reshape(-1, 3)).away)
            for target, p in rounds[::6] + rounds[-1:]]  # fmt: skip
    assert away[-1] < away[0] / 20
    assert (np.diff(away) < 1e-6).all()
