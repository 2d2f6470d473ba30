"""The uv mesh: grid and cells of the parameter domain.

One uv mesh serves the whole face (section 2.2): ``0 <= u <= 1`` from the forehead to the chin
and ``0 <= v <= pi`` from the subject's right to left, or ``0 <= v <= 2 pi`` for the closed
loops. Texture coordinates are (v, u): seen from the front, the texture is upright and unmirrored.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pdeface.errors import InputError
from pdeface.openings import Cut, Opening, cut_rows, snapped

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
        openings: where the mesh is cut; ``extent="face"`` only.
    """

    rows: int = 28
    columns: int = 41
    extent: Literal["face", "loop"] = "face"
    openings: tuple[Opening, ...] = ()

    def __post_init__(self) -> None:
        if self.extent not in ("face", "loop"):
            raise InputError(f"extent must be 'face' or 'loop', got {self.extent!r}")
        fewest = 2 if self.extent == "face" else 3
        if self.rows < 2 or self.columns < fewest:
            raise InputError(
                f"a uv mesh needs at least 2 rows and {fewest} columns, "
                f"got {self.rows} x {self.columns}; try 28 x 41"
            )
        if self.openings and self.extent != "face":
            raise InputError("openings are cut into the face, not into the loop; leave them out")

    @cached_property
    def u(self) -> FloatArray:
        """(rows,) values of u."""
        return np.linspace(0.0, 1.0, self.rows)

    @cached_property
    def v(self) -> FloatArray:
        """(columns,) values of v, radians; a column lies on each corner of an opening."""
        if self.extent == "face":
            return snapped(np.linspace(0.0, np.pi, self.columns), self.openings)
        return np.arange(self.columns, dtype=np.float64) * (2.0 * np.pi / self.columns)

    @cached_property
    def cuts(self) -> tuple[Cut, ...]:
        """How each opening cuts the mesh, less those for which it is too coarse."""
        cuts = (cut_rows(self.rows, self.v, opening) for opening in self.openings)
        return tuple(cut for cut in cuts if cut is not None and cut.is_open)

    @property
    def vertex_count(self) -> int:
        """Number of nodes, those inside an opening included, which no cell has."""
        return self.rows * self.columns

    @cached_property
    def nodes(self) -> FloatArray:
        """(vertices, 2) parameters (u, v) of each node."""
        u, v = np.meshgrid(self.u, self.v, indexing="ij")
        for cut in self.cuts:
            for row, moved in ((cut.upper, cut.upper_u), (cut.lower, cut.lower_u)):
                u[row, cut.columns] = moved
        return np.stack([u.ravel(), v.ravel()], axis=1)

    @cached_property
    def quads(self) -> IndexArray:
        """(cells, 4) corners of each cell, anticlockwise seen from outside the face.

        Openings take the cells in them and beside their slanting edges away; the latter are left
        in part, as :attr:`fans`.
        """
        index = np.arange(self.vertex_count, dtype=np.int32).reshape(self.rows, self.columns)
        if self.extent == "loop":
            index = np.concatenate([index, index[:, :1]], axis=1)
        kept = np.ones((index.shape[0] - 1, index.shape[1] - 1), dtype=bool)
        for cut in self.cuts:
            for j, column in enumerate(cut.columns[:-1]):
                kept[min(cut.upper[j : j + 2]) : max(cut.lower[j : j + 2]), column] = False
        corners = [index[:-1, :-1], index[1:, :-1], index[1:, 1:], index[:-1, 1:]]
        return np.stack([c[kept] for c in corners], axis=1)

    @cached_property
    def fans(self) -> IndexArray:
        """(F, 3) triangles between whole cells and the slanting edges of openings."""
        fans = [fan for cut in self.cuts for fan in _fans(cut, self.columns)]
        return np.array(fans, dtype=np.int32).reshape(-1, 3)

    @cached_property
    def triangles(self) -> IndexArray:
        """(T, 3) triangles, two a cell, anticlockwise seen from outside the face."""
        q = self.quads
        halves = np.stack([q[:, [0, 1, 2]], q[:, [0, 2, 3]]], axis=1).reshape(-1, 3)
        return np.concatenate([halves, self.fans]) if self.cuts else halves

    @cached_property
    def texcoords(self) -> FloatArray:
        """(vertices, 2) texture coordinates (v / extent, u), top-left origin as in glTF."""
        span = np.pi if self.extent == "face" else 2.0 * np.pi
        return self.nodes[:, ::-1] / np.array([span, 1.0])


def _fans(cut: Cut, columns: int) -> Iterator[tuple[int, int, int]]:
    """Triangles of the cells that the lines of an opening cross from one column to the next."""
    for j, column in enumerate(cut.columns[:-1].tolist()):
        for above, rows in ((True, cut.upper), (False, cut.lower)):
            here, there = int(rows[j]), int(rows[j + 1])
            low, high = min(here, there), max(here, there)
            # Above an opening the strip goes down to its line; from the higher of the two nodes a
            # fan reaches the rest of the other column. Below it is the other way up.
            apex = low if above else high
            at_left = here == apex
            for row in range(low, high):
                side = column + (1 if at_left else 0)
                other = apex * columns + (column if at_left else column + 1)
                one, two = row * columns + side, (row + 1) * columns + side
                yield (other, two, one) if at_left else (other, one, two)


@dataclass(frozen=True, eq=False)
class FaceMesh:
    """The face sampled on a uv mesh: what files and pictures are made from.

    Attributes:
        vertices: (V, 3) metres.
        normals: (V, 3) unit normals of the analytic surface.
        texcoords: (V, 2), top-left origin.
        quads: (C, 4) indices, anticlockwise seen from outside.
        fans: (F, 3) triangles beside openings, which are no part of a quad.
        triangles: (T, 3) indices, anticlockwise seen from outside: quads halved, and fans.
        grid: the (rows, columns) of the uv mesh.
    """

    vertices: FloatArray
    normals: FloatArray
    texcoords: FloatArray
    quads: IndexArray
    fans: IndexArray
    triangles: IndexArray
    grid: tuple[int, int]

    def turned(self, rotation: FloatArray, about: ArrayLike) -> FaceMesh:
        """The mesh after a rotation, a (3, 3) matrix, about a point, (3,) metres."""
        origin = np.asarray(about, dtype=np.float64)
        vertices = (self.vertices - origin) @ rotation.T + origin
        return replace(self, vertices=vertices, normals=self.normals @ rotation.T)
