"""The face on a uv mesh: the grid of its rows and columns, and the nodes that openings move.

Rows and columns separate, so that the grid costs two small products; the few nodes on the edges of
openings have parameters of their own and a row of weights each.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from functools import lru_cache
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from pdeface.controls import slits
from pdeface.controls.measured import STILL
from pdeface.margins import MarginField
from pdeface.openings import Opening
from pdeface.pde import Continuity, GridEvaluator, Join, PDESurface
from pdeface.pde.differential import unit_normal
from pdeface.pde.scattered import point_weights
from pdeface.uvmesh import UVMesh

__all__ = ["Sampler", "sampler"]

Array = NDArray[np.floating]
FloatArray = NDArray[np.float64]


class Sampler:
    """Positions and normals of any face of one size on one uv mesh.

    Args:
        shape: (K, M) of the curves.
        mesh: the uv mesh.
        a, modes, join: as for :class:`pdeface.pde.PDESurface`.
        parts: whether points come with displacements that part the face at lids and lips:
            (..., 2 K, M, 3), the K curves, and after them their parting displacements.
        mirrored: whether every curve is its own reflection.
    """

    def __init__(
        self,
        shape: tuple[int, int],
        mesh: UVMesh,
        a: float,
        modes: int,
        join: Join,
        parts: bool,
        mirrored: bool = False,
    ) -> None:
        parting = slits(shape[0]) if parts else None
        self._grid = GridEvaluator(
            shape,
            mesh.u,
            mesh.v,
            a=a,
            modes=modes,
            join=join,
            parting=parting,
            mirrored=mirrored,
        )
        options: dict[str, Any] = {"a": a, "modes": modes, "join": join}
        self._curves, self._parting, self._options = shape[0], parting, options
        self._margins = MarginField(mesh)
        self._moved, u, v, outside = _moved_nodes(mesh)
        self._weights = np.zeros((3, 0, 0))
        if len(self._moved):
            layers = [_weights(shape, _Places.plain(u, v), {}, options)]
            if parting is not None:
                layers.append(_weights(shape, outside, parting, options))
            self._weights = np.concatenate(layers, axis=2)

    def positions(self, points: Any, margins: FloatArray = STILL) -> FloatArray:
        """(..., V, 3) positions of the nodes of faces with (..., K or 2 K, M, 3) data points.

        Args:
            points: data points, or displacements of them.
            margins: (..., openings, 2, samples, 3) displacement of the margins besides.
        """
        positions = self._with_moved_positions(_listed(self._grid.positions(points)), points)
        return self._with_margins(positions, margins)

    def positions_and_normals(
        self, points: Any, margins: FloatArray = STILL
    ) -> tuple[FloatArray, FloatArray]:
        """Both together, for less than one after the other."""
        positions, normals = map(_listed, self._grid.positions_and_normals(points))
        positions = self._with_moved_positions(positions, points)
        normals = self._with_moved_normals(normals, points)
        self._turn_at_margins(normals, points, margins)
        return self._with_margins(positions, margins), normals

    def normals(self, points: Any, margins: FloatArray = STILL) -> FloatArray:
        """(..., V, 3) unit outward normals; zero where the surface is degenerate."""
        normals = self._with_moved_normals(_listed(self._grid.normals(points)), points)
        self._turn_at_margins(normals, points, margins)
        return normals

    def _with_moved_positions(self, positions: FloatArray, points: Any) -> FloatArray:
        if len(self._moved):
            positions[..., self._moved, :] = self._at(points, 0)
        return positions

    def _with_moved_normals(self, normals: FloatArray, points: Any) -> FloatArray:
        if len(self._moved):
            normals[..., self._moved, :] = unit_normal(self._at(points, 1), self._at(points, 2))
        return normals

    def _with_margins(self, positions: FloatArray, margins: FloatArray) -> FloatArray:
        for face in self._moving(margins):
            positions[face][self._margins.nodes] += self._margins.displacements(margins[face])[0]
        return positions

    def _turn_at_margins(self, normals: FloatArray, points: Any, margins: FloatArray) -> None:
        """Write the normals of the sum of a surface and the displacement of its margins."""
        points = np.asarray(points)
        for face in self._moving(margins):
            _, by_u, by_v = self._margins.displacements(margins[face])
            s_u, s_v = self._tangents(points[face] if points.ndim > 3 else points)
            normals[face][self._margins.nodes] = unit_normal(s_u + by_u, s_v + by_v)

    def _moving(self, margins: FloatArray) -> Iterable[tuple[int, ...]]:
        """Indices of the faces of a batch whose margins are moved, if the mesh has any."""
        moved = margins.any(axis=(-4, -3, -2, -1)) & (len(self._margins.nodes) > 0)
        return map(tuple, np.argwhere(moved).tolist())

    def _tangents(self, points: FloatArray) -> tuple[FloatArray, ...]:
        """(n, 3) derivatives by u and by v at the nodes beside margins."""
        curves, options = self._curves, self._options
        surface = PDESurface(points[:curves], **options)
        if self._parting is not None:
            surface += PDESurface(points[curves:], **options, continuity=self._parting)
        nodes, (u, v) = self._margins.nodes, self._margins.places.T
        _, mine, theirs = np.intersect1d(nodes, self._moved, return_indices=True)
        found = surface.derivative(u, v, 1, 0), surface.derivative(u, v, 0, 1)
        for which, tangents in enumerate(found, start=1):
            tangents[mine] = self._at(points, which)[theirs]
        return found

    def _at(self, points: Any, which: int) -> FloatArray:
        points = np.asarray(points)
        flat = points.reshape(*points.shape[:-3], -1, 3)
        return np.asarray(self._weights[which] @ flat)


sampler = lru_cache(maxsize=16)(Sampler)
"""The :class:`Sampler` of these arguments, kept for the next face."""


class _Places(NamedTuple):
    """Where nodes read a surface: (n,) u and v, and how that u changes with their own u and v."""

    u: FloatArray
    v: FloatArray
    by_u: FloatArray
    by_v: FloatArray

    @classmethod
    def plain(cls, u: FloatArray, v: FloatArray) -> _Places:
        return cls(u, v, np.ones(len(u)), np.zeros(len(u)))


def _weights(
    shape: tuple[int, int],
    at: _Places,
    continuity: Mapping[int, Continuity],
    options: Mapping[str, Any],
) -> FloatArray:
    """(3, nodes, points) weights of the value and of its derivatives by the nodes' u and v."""
    value, by_u, by_v = (
        point_weights(shape, at.u, at.v, *order, continuity=continuity, **options)
        for order in ((0, 0), (1, 0), (0, 1))
    )
    return np.array([value, at.by_u[:, None] * by_u, by_v + at.by_v[:, None] * by_u])


def _listed(grid: Array) -> FloatArray:
    """(..., V, 3) contiguous vertices of (..., U, V, 3)."""
    return np.ascontiguousarray(grid.reshape(*grid.shape[:-3], -1, 3), dtype=np.float64)


def _moved_nodes(mesh: UVMesh) -> tuple[NDArray[np.intp], FloatArray, FloatArray, _Places]:
    """Nodes that the grid cannot serve, their u and v, and where they read what parts the face.

    These are the nodes on the edges of openings and, beside slanting edges, those between such an
    edge and the curve to which it belongs: there the grid would mix the two sides.
    """
    parameters = mesh.nodes.reshape(mesh.rows, mesh.columns, 2)
    index, parted = [np.zeros(0, np.intp)], [_Places.plain(np.zeros(0), np.zeros(0))]
    for cut in mesh.cuts:
        above, below = cut.opening.rows
        for column, upper, lower in zip(cut.columns, cut.upper, cut.lower, strict=True):
            u = parameters[:, column, 0]
            row = np.arange(mesh.rows)
            on_upper = (row <= upper) & ((u > above) | (row == upper))
            on_lower = (row >= lower) & ((u < below) | (row == lower)) & ~on_upper
            for side, is_upper in ((on_upper, True), (on_lower, False)):
                chosen = np.flatnonzero(side)
                index.append(chosen * mesh.columns + column)
                parted.append(_parted(cut.opening, u[chosen], mesh.v[column], is_upper))
    node = np.concatenate(index).astype(np.intp)
    u, v = mesh.nodes[node].T
    return node, u, v, _Places(*(np.concatenate(each) for each in zip(*parted, strict=True)))


def _parted(opening: Opening, u: FloatArray, at: float, upper: bool) -> _Places:
    """Where nodes of a side, all in one column, read what parts the face."""
    v = np.full(len(u), at)
    own = opening.belonging(u, v, upper=upper)
    apart, slope = opening.apart(v)
    limit = np.minimum(u, opening.rows[0]) if upper else np.maximum(u, opening.rows[1])
    return _Places(own, v, np.where(limit == u, 1.0, 1.0 - apart), slope * (limit - u))
