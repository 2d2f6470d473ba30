"""The uv mesh: grid and cells of the parameter domain.

One uv mesh serves the whole face (section 2.2): ``0 <= u <= 1`` from the forehead to the chin
and ``0 <= v <= pi`` from the subject's right to left, or ``0 <= v <= 2 pi`` for the closed
loops. Texture coordinates are (v, u): seen from the front, the texture is upright and unmirrored.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pdeface.errors import InputError

__all__ = ["FaceMesh", "UVMesh"]

FloatArray = NDArray[np.float64]
IndexArray = NDArray[np.int32]


@dataclass(frozen=True)
class UVMesh:
    """``rows`` x ``columns`` samples of the parameter domain, row by row.

    Attributes:
        rows: samples of u in [0, 1], both ends included.
        columns: samples of v; both ends included for ``extent="face"``.
        extent: ``"face"`` for 0 <= v <= pi, ``"loop"`` for the closed curves
            (0 <= v < 2 pi, the last cell joined to the first).
    """

    rows: int = 28
    columns: int = 41
    extent: Literal["face", "loop"] = "face"

    def __post_init__(self) -> None:
        if self.extent not in ("face", "loop"):
            raise InputError(f"extent must be 'face' or 'loop', got {self.extent!r}")
        fewest = 2 if self.extent == "face" else 3
        if self.rows < 2 or self.columns < fewest:
            raise InputError(
                f"a uv mesh needs at least 2 rows and {fewest} columns, "
                f"got {self.rows} x {self.columns}; try 28 x 41"
            )

    @cached_property
    def u(self) -> FloatArray:
        """(rows,) values of u."""
        return np.linspace(0.0, 1.0, self.rows)

    @cached_property
    def v(self) -> FloatArray:
        """(columns,) values of v, radians."""
        if self.extent == "face":
            return np.linspace(0.0, np.pi, self.columns)
        return np.arange(self.columns, dtype=np.float64) * (2.0 * np.pi / self.columns)

    @property
    def vertex_count(self) -> int:
        """Number of nodes."""
        return self.rows * self.columns

    @cached_property
    def quads(self) -> IndexArray:
        """(cells, 4) corners of each cell, anticlockwise seen from outside the face."""
        index = np.arange(self.vertex_count, dtype=np.int32).reshape(self.rows, self.columns)
        if self.extent == "loop":
            index = np.concatenate([index, index[:, :1]], axis=1)
        corners = [index[:-1, :-1], index[1:, :-1], index[1:, 1:], index[:-1, 1:]]
        return np.stack([c.ravel() for c in corners], axis=1)

    @cached_property
    def triangles(self) -> IndexArray:
        """(2 cells, 3) triangles, two a cell, anticlockwise seen from outside the face."""
        q = self.quads
        return np.stack([q[:, [0, 1, 2]], q[:, [0, 2, 3]]], axis=1).reshape(-1, 3)

    @cached_property
    def texcoords(self) -> FloatArray:
        """(vertices, 2) texture coordinates (v / extent, u), top-left origin as in glTF."""
        span = np.pi if self.extent == "face" else 2.0 * np.pi
        s, t = np.meshgrid(self.v / span, self.u)
        return np.stack([s.ravel(), t.ravel()], axis=1)


@dataclass(frozen=True, eq=False)
class FaceMesh:
    """The face sampled on a uv mesh: what files and pictures are made from.

    Attributes:
        vertices: (V, 3) metres.
        normals: (V, 3) unit normals of the analytic surface.
        texcoords: (V, 2), top-left origin.
        quads: (C, 4) indices, anticlockwise seen from outside.
        triangles: (T, 3) indices, anticlockwise seen from outside.
        grid: the (rows, columns) of the uv mesh.
    """

    vertices: FloatArray
    normals: FloatArray
    texcoords: FloatArray
    quads: IndexArray
    triangles: IndexArray
    grid: tuple[int, int]

    def turned(self, rotation: FloatArray, about: ArrayLike) -> FaceMesh:
        """The mesh after a rotation, a (3, 3) matrix, about a point, (3,) metres."""
        origin = np.asarray(about, dtype=np.float64)
        vertices = (self.vertices - origin) @ rotation.T + origin
        return replace(self, vertices=vertices, normals=self.normals @ rotation.T)
