"""The neutral face that ships: its names, its symmetry, its levels, and that it does not fold."""

from __future__ import annotations

import numpy as np
import pytest

import pdeface
from pdeface import template
from pdeface.errors import InputError
from pdeface.pde import GridEvaluator, PDESurface
from pdeface.template import LEVELS, ROWS

MESHES = [(28, 41), (37, 41), (109, 161), (271, 161), (541, 321)]


def grid(level: str, mesh: tuple[int, int]) -> tuple[np.ndarray, np.ndarray]:
    curves = template.neutral_curves(level)
    evaluator = GridEvaluator(
        curves.shape, np.linspace(0, 1, mesh[0]), np.linspace(0, np.pi, mesh[1])
    )
    return evaluator.positions_and_normals(curves.points)


@pytest.mark.parametrize("level", LEVELS)
def test_levels_have_the_shapes_that_they_are_called(level: str) -> None:
    curves = template.neutral_curves(level)
    assert f"{curves.shape[0]}x{curves.shape[1]}" == level
    assert curves.is_mirrored


def test_the_papers_level_is_one_word_away_and_the_default() -> None:
    assert pdeface.neutral("paper") == pdeface.neutral("28x46") == pdeface.neutral()


def test_an_unknown_level_names_the_known_ones() -> None:
    with pytest.raises(InputError, match=r"28x46, 55x92, 109x184 or paper, got '3x3'"):
        pdeface.neutral("3x3")


@pytest.mark.parametrize("level", LEVELS)
def test_the_face_is_symmetric(level: str) -> None:
    half = template.neutral_curves(level).half
    np.testing.assert_allclose(half[:, ::-1] * [-1, 1, 1], half, atol=1e-7)


@pytest.mark.parametrize("level", LEVELS)
@pytest.mark.parametrize("mesh", MESHES)
def test_no_cell_is_folded(level: str, mesh: tuple[int, int]) -> None:
    positions, _ = grid(level, mesh)
    a, b, c, d = (
        positions[:-1, :-1], positions[1:, :-1], positions[1:, 1:], positions[:-1, 1:]
    )  # fmt: skip
    first, second = np.cross(b - a, c - a), np.cross(c - a, d - a)
    assert ((first * second).sum(-1) > 0).all()


@pytest.mark.parametrize("level", LEVELS)
def test_normals_point_out_of_the_face(level: str) -> None:
    positions, normals = grid(level, (109, 161))
    mesh = pdeface.neutral(level).mesh(109, 161)
    a, b, c = (mesh.vertices[mesh.triangles[:, k]] for k in range(3))
    face_normals = np.cross(b - a, c - a)
    at_corner = mesh.normals[mesh.triangles[:, 0]]
    assert ((face_normals * at_corner).sum(1) > 0).mean() > 0.995
    forehead = normals[2:8, 60:100]
    assert (forehead[..., 2] > 0.5).all()
    assert positions[..., 2].argmax() // 161 == pytest.approx(52, abs=4)  # the tip of the nose


def test_levels_agree_on_where_a_parameter_is() -> None:
    # A texture and an expression are held in (u, v): they must mean the same place at each level.
    u, v = np.linspace(0.02, 0.98, 40)[:, None], np.linspace(0.3, np.pi - 0.3, 40)
    coarse, fine = (
        PDESurface(template.neutral_curves(level).points)(u, v) for level in ("28x46", "109x184")
    )
    distance = np.linalg.norm(coarse - fine, axis=-1)
    assert np.median(distance) < 2e-4
    assert distance.max() < 4e-3


def test_every_row_has_a_name_and_a_place() -> None:
    assert sorted(ROWS.values()) == list(range(28))
    surface = pdeface.neutral().surface()
    eye, midline = np.pi * 0.36, np.pi / 2
    heights = [
        surface(template.row_u(name), eye)[1]
        for name in ("brow", "upper_lid_margin", "mid_eye", "lower_lid_margin", "mouth_seam_upper")
    ]
    assert heights == sorted(heights, reverse=True)
    lips = [surface(template.row_u(f"mouth_seam_{side}"), midline) for side in ("upper", "lower")]
    assert 0 < lips[0][1] - lips[1][1] < 0.003
    assert template.row("mid_eye") == 8
    assert template.row("mid_eye", curves=55) == 16
    with pytest.raises(InputError, match="no row is called 'ear'"):
        template.row("ear")
    with pytest.raises(InputError, match="none lies on 'mid_eye'"):
        template.row("mid_eye", curves=30)


def test_every_column_has_a_name_and_a_place() -> None:
    v = [template.column_v(name) for name in template.COLUMNS]
    assert v == sorted(v)
    assert v[0] == 0.0
    np.testing.assert_allclose(np.add(v, v[::-1]), np.pi)
    surface = pdeface.neutral("109x184").surface()
    outer, inner = (
        surface(template.row_u("mid_eye"), template.column_v(f"left_eye_{side}"))[0]
        for side in ("outer", "inner")
    )
    assert (outer, inner) == pytest.approx((0.0446, 0.0184), abs=0.0015)
    assert template.column("midline") == 11
    assert template.column("left_edge") == 22
    with pytest.raises(InputError, match="no column is called 'ear'"):
        template.column("ear")


def test_regions_lie_on_the_face() -> None:
    for region in template.REGIONS.values():
        assert 0 <= region.first_row < region.last_row <= 27
        assert 0 <= region.right < region.left <= 1


def test_feature_points_lie_where_their_names_say() -> None:
    points = template.feature_points()
    assert list(points) == list(template.FEATURE_POINTS)
    assert len(points) == 25
    surface = pdeface.neutral("109x184").surface()
    at = {name: surface(*uv) for name, uv in points.items()}
    assert at["nose_tip"][2] == max(p[2] for p in at.values())
    assert np.linalg.norm(at["left_eye_middle"] - at["right_eye_middle"]) == pytest.approx(
        0.0626, abs=5e-4
    )
    for name, position in at.items():
        if name.startswith("right"):
            mirrored = at[name.replace("right", "left")]
            np.testing.assert_allclose(position * [-1, 1, 1], mirrored, atol=1e-6)
            assert position[0] < 0
    mesh = np.array(list(points.values())).reshape(5, 5, 2)
    assert (np.diff(mesh[:, :, 0], axis=0) > 0).all()  # downwards in u
    assert (np.diff(mesh[:, :, 1], axis=1) > 0).all()  # from right to left in v
