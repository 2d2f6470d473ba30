"""A shape basis: weighted sums of fixed curves on one uv mesh, frame after frame."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from pdeface.errors import InputError
from pdeface.pde.grid import GridEvaluator, planar

__all__ = ["ShapeBasis"]

Array = NDArray[np.floating]

# Nodes up to which one product with the positions of the basis is faster than one with its modes
# and another with the waves. Measured: 28 x 41 is below, 55 x 81 above.
SMALL = 2_000
# Numbers of a frame's results, or of its modes, that are worked on together: the first stay in a
# processor's second cache, the second in its third.
CHUNK = 250_000
MODES_CHUNK = 1_000_000


class ShapeBasis:
    """Positions of sums of B faces or displacements, each with a weight.

    The surface is linear in the data points, so everything that does not depend on the weights is
    computed once. On a small uv mesh a frame is one product of its weights with the positions of
    the basis, x, y and z apart; on a large one it is a product with their modes on the rows, which
    are fewer, and another with the waves along v.

    Args:
        evaluator: of the uv mesh; its precision is that of the results.
        points: (B, K, M, 3) data points, or displacements of them, as the evaluator takes them.

    Raises:
        InputError: points of another shape.
    """

    def __init__(self, evaluator: GridEvaluator, points: Any) -> None:
        points = np.asarray(points)
        if points.ndim != 4 or points.shape[1:] != (*evaluator.shape, 3):
            raise InputError(
                f"a shape basis has points of shape (B, {evaluator.shape[0]}, "
                f"{evaluator.shape[1]}, 3), got {points.shape}; stack them"
            )
        self._evaluator = evaluator
        self._nodes = len(evaluator.u) * len(evaluator.v)
        self._by_vertices = self._nodes <= SMALL
        of_each = (
            planar(evaluator.positions(points))
            if self._by_vertices
            else evaluator.row_modes(points)
        )
        # (3, B, numbers), and what the numbers of each member are: (U, V), or (rows, waves).
        self._grid = of_each.shape[2:]
        self._basis = np.ascontiguousarray(of_each.reshape(3, len(points), -1))
        self.count = len(points)
        self.dtype = evaluator.dtype

    def empty(self, *batch: int) -> Array:
        """(*batch, U, V, 3) uninitialised memory for ``out``."""
        return self._evaluator.empty(*batch)

    def positions(self, weights: Any, *, out: Array | None = None) -> Array:
        """(..., U, V, 3) positions for (..., B) weights: views of planar memory.

        Args:
            weights: of each member of the basis; leading axes are a batch of frames.
            out: memory from :meth:`empty` to write over.

        Raises:
            InputError: another number of weights, or ``out`` is other memory.
        """
        weights = np.asarray(weights, self.dtype)
        if weights.shape[-1:] != (self.count,):
            raise InputError(
                f"this basis takes {self.count} weights a frame, got an array of shape "
                f"{weights.shape}; put frames first and weights last"
            )
        out = self._evaluator.memory(weights.shape[:-1], out)
        frames, places = weights.reshape(-1, self.count), planar(out)
        places = places.reshape(3, len(frames), *places.shape[-2:])
        if self._by_vertices:
            self._write_by_vertices(frames, places)
        else:
            self._write_by_modes(frames, places)
        return out

    def _write_by_vertices(self, frames: Array, places: Array) -> None:
        places = places.reshape(3, len(frames), self._nodes)
        step = max(1, CHUNK // self._nodes)
        for axis, start in np.ndindex(3, -(-len(frames) // step)):
            some = slice(start * step, (start + 1) * step)
            np.matmul(frames[some], self._basis[axis], out=places[axis, some])

    def _write_by_modes(self, frames: Array, places: Array) -> None:
        size = self._basis.shape[-1]
        together, each = max(1, MODES_CHUNK // (3 * size)), max(1, CHUNK // (2 * self._nodes))
        buffer = np.empty((3, min(together, len(frames)), size), self.dtype)
        for first in range(0, len(frames), together):
            some = frames[first : first + together]
            modes = np.matmul(some, self._basis, out=buffer[:, : len(some)])
            modes = modes.reshape(3, len(some), *self._grid)
            for start in range(0, len(some), each):
                stop = min(start + each, len(some))
                place = places[:, first + start : first + stop]
                self._evaluator.write_from_modes(modes[:, start:stop], np.moveaxis(place, 0, -1))
