"""The face on a uv mesh: the grid of its rows and columns, and the nodes that openings move.

Rows and columns separate, so that the grid costs two small products; the few nodes on the edges of
openings have parameters of their own and a row of weights each.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pdeface.controls import slits
from pdeface.pde import Continuity, GridEvaluator, Join
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
        self._moved, u, v, outside = _moved_nodes(mesh)
        self._weights = np.zeros((3, 0, 0))
        if len(self._moved):
            options = {"a": a, "modes": modes, "join": join}
            layers = [(u, {})] if parting is None else [(u, {}), (outside, parting)]
            orders = (0, 0), (1, 0), (0, 1)
            self._weights = np.array(
                [_weights(shape, u, v, layers, order, options) for order in orders]
            )

    def positions(self, points: Any) -> FloatArray:
        """(..., V, 3) positions of the nodes of faces with (..., K or 2 K, M, 3) data points."""
        return self._with_moved_positions(_listed(self._grid.positions(points)), points)

    def positions_and_normals(self, points: Any) -> tuple[FloatArray, FloatArray]:
        """Both together, for less than one after the other."""
        positions, normals = map(_listed, self._grid.positions_and_normals(points))
        return self._with_moved_positions(positions, points), self._with_moved_normals(
            normals, points
        )

    def normals(self, points: Any) -> FloatArray:
        """(..., V, 3) unit outward normals; zero where the surface is degenerate."""
        return self._with_moved_normals(_listed(self._grid.normals(points)), points)

    def _with_moved_positions(self, positions: FloatArray, points: Any) -> FloatArray:
        if len(self._moved):
            positions[..., self._moved, :] = self._at(points, 0)
        return positions

    def _with_moved_normals(self, normals: FloatArray, points: Any) -> FloatArray:
        if len(self._moved):
            normals[..., self._moved, :] = unit_normal(self._at(points, 1), self._at(points, 2))
        return normals

    def _at(self, points: Any, which: int) -> FloatArray:
        points = np.asarray(points)
        flat = points.reshape(*points.shape[:-3], -1, 3)
        return np.asarray(self._weights[which] @ flat)


sampler = lru_cache(maxsize=16)(Sampler)
"""The :class:`Sampler` of these arguments, kept for the next face."""


def _weights(
    shape: tuple[int, int],
    u: FloatArray,
    v: FloatArray,
    layers: Sequence[tuple[FloatArray, Mapping[int, Continuity]]],
    order: tuple[int, int],
    options: Mapping[str, Any],
) -> FloatArray:
    """(nodes, points of all layers) weights of a derivative, each layer read at a u of its own."""
    du, dv = order
    of_layers = []
    for own, continuity in layers:
        weights = point_weights(shape, own, v, du, dv, continuity=continuity, **options)
        # Beyond its curve the displacement of a side goes on as it is there: it has no slope.
        weights[(own != u) & (du > 0)] = 0.0
        of_layers.append(weights)
    return np.concatenate(of_layers, axis=1)


def _listed(grid: Array) -> FloatArray:
    """(..., V, 3) contiguous vertices of (..., U, V, 3)."""
    return np.ascontiguousarray(grid.reshape(*grid.shape[:-3], -1, 3), dtype=np.float64)


def _moved_nodes(mesh: UVMesh) -> tuple[NDArray[np.intp], FloatArray, FloatArray, FloatArray]:
    """Nodes that the grid cannot serve, their u and v, and u of the curve of their side.

    These are the nodes on the edges of openings and, beside slanting edges, those between such an
    edge and the curve to which it belongs: there the grid would mix the two sides.
    """
    parameters = mesh.nodes.reshape(mesh.rows, mesh.columns, 2)
    index, outside = [], []
    for cut in mesh.cuts:
        above, below = cut.opening.rows
        for column, upper, lower in zip(cut.columns, cut.upper, cut.lower, strict=True):
            u = parameters[:, column, 0]
            row = np.arange(mesh.rows)
            on_upper = (row <= upper) & ((u > above) | (row == upper))
            on_lower = (row >= lower) & ((u < below) | (row == lower)) & ~on_upper
            for side, limit in ((on_upper, np.minimum(u, above)), (on_lower, np.maximum(u, below))):
                chosen = np.flatnonzero(side)
                index.append(chosen * mesh.columns + column)
                outside.append(limit[chosen])
    if not index:
        return np.zeros(0, np.intp), np.zeros(0), np.zeros(0), np.zeros(0)
    node = np.concatenate(index).astype(np.intp)
    u, v = mesh.nodes[node].T
    return node, u, v, np.concatenate(outside)
