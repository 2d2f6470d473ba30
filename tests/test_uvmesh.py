"""The uv mesh: its samples, its cells, and which way they face."""

from __future__ import annotations

from collections import Counter

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from pdeface.errors import InputError
from pdeface.uvmesh import FaceMesh, UVMesh

MESHES = st.builds(UVMesh, st.integers(2, 9), st.integers(3, 9), st.sampled_from(["face", "loop"]))


def test_the_papers_mesh_is_the_default():
    mesh = UVMesh()
    assert (mesh.rows, mesh.columns, mesh.vertex_count) == (28, 41, 1148)
    np.testing.assert_array_equal(mesh.u[[0, -1]], [0.0, 1.0])
    np.testing.assert_array_equal(mesh.v[[0, -1]], [0.0, np.pi])
    assert mesh.v[20] == pytest.approx(np.pi / 2), "the middle column is the midline"


def test_loops_do_not_repeat_their_first_column():
    v = UVMesh(5, 8, "loop").v
    np.testing.assert_allclose(v, np.arange(8) * np.pi / 4)


@given(MESHES)
def test_cells_cover_the_mesh_once(mesh):
    cells = (mesh.rows - 1) * (mesh.columns if mesh.extent == "loop" else mesh.columns - 1)
    assert mesh.quads.shape == (cells, 4)
    assert mesh.triangles.shape == (2 * cells, 3)
    assert set(mesh.quads.ravel()) == set(range(mesh.vertex_count))
    # Neighbours run along their common edge in opposite directions, so all face one way.
    for faces in (mesh.quads, mesh.triangles):
        edges = Counter(
            edge for face in faces.tolist() for edge in zip(face, face[1:] + face[:1], strict=True)
        )
        assert set(edges.values()) == {1}
        boundary = [edge for edge in edges if edge[::-1] not in edges]
        around = 2 * mesh.columns + (-2 if mesh.extent == "face" else 0)
        assert len(boundary) == around + (2 * (mesh.rows - 1) if mesh.extent == "face" else 0)


@given(MESHES)
def test_triangles_halve_the_quads(mesh):
    for quad, first, second in zip(
        mesh.quads, mesh.triangles[::2], mesh.triangles[1::2], strict=True
    ):
        assert set(first) | set(second) == set(quad)
        assert len(set(first) & set(second)) == 2


def test_cells_face_outwards():
    """On a face u runs down, v from the subject's right (-X) to left, and +Z is outwards."""
    mesh = UVMesh(4, 5)
    u, v = np.meshgrid(mesh.u, mesh.v, indexing="ij")
    vertices = np.stack([-np.cos(v), -u, np.sin(v)], axis=-1).reshape(-1, 3)
    for corners in (mesh.quads[:, :3], mesh.triangles):
        a, b, c = vertices[corners].swapaxes(0, 1)
        outwards = (np.cross(b - a, c - a) * [1.0, 0.0, 1.0] * (a + b + c)).sum(axis=1)
        assert (outwards > 0.0).all()


@given(MESHES)
def test_texcoords_are_v_and_u(mesh):
    s, t = mesh.texcoords.reshape(mesh.rows, mesh.columns, 2).transpose(2, 0, 1)
    span = np.pi if mesh.extent == "face" else 2 * np.pi
    np.testing.assert_allclose(s * span, np.broadcast_to(mesh.v, s.shape))
    np.testing.assert_allclose(t.T, np.broadcast_to(mesh.u, t.T.shape))
    assert mesh.texcoords.min() == 0.0
    assert mesh.texcoords.max() == 1.0


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ((1, 41), "at least 2 rows and 2 columns, got 1 x 41"),
        ((28, 1), "got 28 x 1"),
        ((28, 2, "loop"), "2 rows and 3 columns, got 28 x 2"),
        ((28, 41, "head"), "extent must be 'face' or 'loop', got 'head'"),
    ],
)
def test_a_mesh_that_cannot_be_is_refused(arguments, message):
    with pytest.raises(InputError, match=message):
        UVMesh(*arguments)


def test_a_mesh_turned_about_a_point() -> None:
    points = np.array([[1.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 3.0]])
    cells = UVMesh(2, 2)
    mesh = FaceMesh(points, points, points[:, :2], cells.quads, cells.fans, cells.triangles, (2, 2))
    quarter = np.array([[0.0, 0.0, 1.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0]])  # +Z to +X
    found = mesh.turned(quarter, (1.0, 0.0, 0.0))
    np.testing.assert_allclose(found.vertices, [[1, 0, 0], [1, 2, 1], [4, 0, 1]])
    np.testing.assert_allclose(found.normals, [[0, 0, -1], [0, 2, 0], [3, 0, 0]])
    assert found.quads is mesh.quads
    assert mesh.vertices is points
