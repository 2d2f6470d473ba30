"""The face sampled for a file: single precision, unit normals, one-line refusals."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pdeface.controls.neck import PIVOT, rotations
from pdeface.errors import InputError
from pdeface.face import Face, Openings
from pdeface.pde import Join
from pdeface.relief import Relief
from pdeface.uvmesh import FaceMesh, UVMesh

__all__ = ["Sample", "sample"]

Float32 = NDArray[np.float32]
IndexArray = NDArray[np.int32]

# 16 million vertices make a GLB of a gigabyte; a larger number is a slip of the keyboard.
_MOST_VERTICES = 1 << 24


@dataclass(frozen=True, eq=False)
class Sample:
    """What every format writes.

    Attributes:
        vertices: (V, 3) metres.
        normals: (V, 3), each of length 1.
        texcoords: (V, 2), top-left origin.
        quads: (C, 4) indices, anticlockwise seen from outside.
        fans: (F, 3) triangles beside openings, which are no part of a quad.
        triangles: (T, 3) indices, anticlockwise seen from outside.
        uv_mesh: where it was sampled.
    """

    vertices: Float32
    normals: Float32
    texcoords: Float32
    quads: IndexArray
    fans: IndexArray
    triangles: IndexArray
    uv_mesh: UVMesh

    @property
    def texcoords_from_below(self) -> Float32:
        """(V, 2) texture coordinates with their origin at the bottom left: OBJ and PLY."""
        return np.stack([self.texcoords[:, 0], 1.0 - self.texcoords[:, 1]], axis=1)


def sample(
    face: Face,
    mesh: tuple[int, int],
    join: Join,
    openings: Openings = "cut",
    head: NDArray[np.float64] | None = None,
    relief: Relief | None = None,
) -> Sample:
    """Sample ``face`` on a uv mesh of ``mesh = (rows, columns)``.

    Args:
        face: the face.
        mesh: size of the uv mesh.
        join: how its patches meet.
        head: (3,) yaw, pitch and roll, radians, by which the head is turned about the neck.
        relief: what is raised on the surface, along its normals.

    Raises:
        InputError: no such mesh, or a surface outside the range of single precision.
    """
    sizes = mesh if isinstance(mesh, tuple | list) else ()
    if len(sizes) != 2 or not all(isinstance(n, int | np.integer) for n in sizes):
        raise InputError(f"a mesh size is (rows, columns), such as (28, 41), got {mesh!r}")
    rows, columns = int(sizes[0]), int(sizes[1])
    if rows * columns > _MOST_VERTICES:
        raise InputError(
            f"a mesh has at most {_MOST_VERTICES} vertices, got {rows} x {columns}; "
            "(1081, 641) is as fine as any screen"
        )
    dense = face.mesh(rows, columns, join=join, openings=openings)
    if relief is not None:
        dense = relief.raised(dense)
    if head is not None:
        dense = dense.turned(rotations(head), PIVOT)
    with np.errstate(over="ignore"):
        vertices = dense.vertices.astype(np.float32)
    if not np.isfinite(vertices).all():
        raise InputError(
            "the surface has points beyond the numbers of single precision that a file holds; "
            "check the curves (metres) and a"
        )
    return Sample(
        vertices=vertices,
        normals=_unit_normals(dense),
        texcoords=dense.texcoords.astype(np.float32),
        quads=dense.quads,
        fans=dense.fans,
        triangles=dense.triangles,
        uv_mesh=face.uv_mesh(rows, columns, join=join, openings=openings),
    )


def _unit_normals(mesh: FaceMesh) -> Float32:
    """The mesh's normals; where the surface is pinched to a point or a line and has none, those
    of the cells around, and on a cell without area +Z: a file must hold unit vectors."""
    normals = _unit(mesh.normals)
    for fallback in (_cell_normals, _forward):
        missing = ~(np.abs(np.linalg.norm(normals, axis=1) - 1.0) < 1e-3)
        if not missing.any():
            break
        normals[missing] = fallback(mesh)[missing]
    return normals.astype(np.float32)


def _cell_normals(mesh: FaceMesh) -> NDArray[np.float64]:
    """(V, 3) normals averaged over the quads at each vertex; zero where these have no area."""
    corners = mesh.vertices[mesh.quads]
    across = np.cross(corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1])
    total = np.zeros_like(mesh.vertices)
    for corner in mesh.quads.T:
        np.add.at(total, corner, across)
    return _unit(total)


def _forward(mesh: FaceMesh) -> NDArray[np.float64]:
    return np.broadcast_to([0.0, 0.0, 1.0], mesh.vertices.shape).astype(np.float64)


def _unit(vectors: NDArray[np.float64]) -> NDArray[np.float64]:
    length = np.linalg.norm(vectors, axis=1, keepdims=True)
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.where(length > 0.0, vectors / length, 0.0)
