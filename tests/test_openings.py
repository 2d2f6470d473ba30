"""Openings of a uv mesh: what is cut away, what is left, and that nothing folds or gapes."""

from __future__ import annotations

from collections import Counter
from itertools import pairwise

import numpy as np
import pytest

import pdeface
from pdeface import template
from pdeface.errors import InputError
from pdeface.openings import Opening
from pdeface.uvmesh import UVMesh

SIZES = [(28, 41), (29, 52), (55, 81), (61, 97), (109, 161), (217, 241), (60, 400)]


def cut(size: tuple[int, int]) -> UVMesh:
    return UVMesh(*size, openings=template.openings())


def areas(mesh: UVMesh, cells: np.ndarray) -> np.ndarray:
    """Signed areas of triangles in the parameter domain, positive where seen from outside."""
    a, b, c = mesh.nodes[cells].transpose(1, 0, 2)
    (ab_u, ab_v), (ac_u, ac_v) = (b - a).T, (c - a).T
    return 0.5 * (ab_u * ac_v - ab_v * ac_u)


def test_the_openings_of_the_template_mirror_each_other() -> None:
    right, left, mouth = template.openings()
    assert [o.name for o in (right, left, mouth)] == ["right_eye", "left_eye", "mouth"]
    for one, other in ((right, left), (mouth, mouth)):
        np.testing.assert_allclose(one.v, np.pi - np.array(other.v)[::-1], atol=1e-12)
        np.testing.assert_allclose(one.upper, other.upper[::-1], atol=1e-12)
        np.testing.assert_allclose(one.lower, other.lower[::-1], atol=1e-12)
        assert (np.diff(one.v) > 0).all()
        assert (one.upper[0], one.upper[-1]) == (one.lower[0], one.lower[-1])
    assert mouth.upper == mouth.lower
    assert max(np.subtract(right.lower, right.upper)) > 1.8 / 27


@pytest.mark.parametrize("size", SIZES, ids=str)
def test_cells_cover_the_domain_once_but_for_the_openings(size: tuple[int, int]) -> None:
    mesh = cut(size)
    assert len(mesh.cuts) == 3
    area = areas(mesh, mesh.triangles)
    assert area.min() > 0.0
    missing = sum(
        np.trapezoid(np.subtract(*c.opening.lines(mesh.v[c.columns])[::-1]), mesh.v[c.columns])
        for c in mesh.cuts
    )
    assert area.sum() == pytest.approx(np.pi - missing, rel=1e-12)


@pytest.mark.parametrize("size", SIZES, ids=str)
def test_edges_are_shared_by_two_cells_or_bound_the_face_or_an_opening(size) -> None:
    mesh = cut(size)
    edges = Counter(
        tuple(sorted(pair)) for t in mesh.triangles.tolist() for pair in pairwise([*t, t[0]])
    )
    assert set(edges.values()) <= {1, 2}
    border = [edge for edge, count in edges.items() if count == 1]
    expected = 2 * (size[0] - 1) + 2 * (size[1] - 1)
    expected += sum(2 * (len(c.columns) - 1) for c in mesh.cuts)
    assert len(border) == expected
    for c in mesh.cuts:
        for rows, lines in ((c.upper, c.upper_u), (c.lower, c.lower_u)):
            nodes = rows * size[1] + c.columns
            assert {tuple(sorted(p)) for p in pairwise(nodes.tolist())} <= set(border)
            np.testing.assert_array_equal(mesh.nodes[nodes, 0], lines)


def test_columns_move_to_the_corners_and_a_coarse_mesh_stays_whole() -> None:
    mesh = cut((28, 41))
    for opening in template.openings():
        assert set(opening.corners) <= set(mesh.v.tolist())
    assert (np.diff(mesh.v) > 0).all()
    assert np.abs(mesh.v - np.linspace(0, np.pi, 41)).max() <= np.pi / 80
    coarse = cut((9, 12))
    assert coarse.cuts == ()
    np.testing.assert_array_equal(coarse.triangles, UVMesh(9, 12).triangles)


def test_openings_are_not_for_loops() -> None:
    with pytest.raises(InputError, match="not into the loop"):
        UVMesh(28, 41, "loop", template.openings())


def test_a_face_is_cut_where_it_has_lids_and_whole_when_asked() -> None:
    face = pdeface.neutral()
    whole = face.mesh(28, 41, openings="none")
    assert len(face.mesh(28, 41).triangles) < len(whole.triangles) == 2 * 27 * 40
    assert len(face.mesh(28, 41, join="patchwise").triangles) == 2 * 27 * 40
    with pytest.raises(InputError, match="openings are 'cut' or 'none', got 'open'"):
        face.mesh(28, 41, openings="open")


@pytest.mark.parametrize("size", [(28, 41), (109, 161)], ids=str)
def test_nodes_lie_on_the_surface_and_wear_its_normals(size) -> None:
    face = pdeface.random(3)
    mesh, surface = face.mesh(*size), face.surface()
    u, v = face.uv_mesh(*size).nodes.T
    np.testing.assert_allclose(mesh.vertices, surface(u, v), atol=1e-12)
    np.testing.assert_allclose(mesh.normals, surface.normal(u, v), atol=1e-9)


def test_the_mouth_is_shut_at_rest_and_its_lips_part_when_it_opens() -> None:
    size = (109, 161)
    rest, talking = (pdeface.neutral().set(jawOpen=w).mesh(*size).vertices for w in (0.0, 1.0))
    mouth = cut(size).cuts[2]
    inner = slice(1, -1)
    upper, lower = (r[inner] * size[1] + mouth.columns[inner] for r in (mouth.upper, mouth.lower))
    np.testing.assert_allclose(rest[upper], rest[lower], atol=1e-12)
    apart = talking[upper, 1] - talking[lower, 1]
    assert (apart > 0).all()
    assert 0.025 < apart.max() < 0.040


def test_a_line_is_read_between_its_points() -> None:
    opening = Opening("o", (1.0, 2.0), (0.5, 0.5), (0.5, 0.7), (0.4, 0.8))
    upper, lower = opening.lines(np.array([1.0, 1.5, 2.0]))
    np.testing.assert_allclose(upper, [0.5, 0.5, 0.5])
    np.testing.assert_allclose(lower, [0.5, 0.6, 0.7])
