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
# Numbers of modes, and of results made of them, that are worked on together: the first stay in a
# processor's third cache, the second in its second.
MODES_CHUNK = 1_000_000
CHUNK = 250_000


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
        # What the numbers of each member are, (U, V) or (rows, waves), and (B, 3, numbers).
        self._grid = of_each.shape[2:]
        flat = of_each.reshape(3, len(points), -1).swapaxes(0, 1)
        self._basis = np.ascontiguousarray(flat)
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
        if self._by_vertices and weights.ndim == 1:
            # One product for x, y and z: it takes as long as it takes to read the basis.
            np.dot(weights, self._basis.reshape(self.count, -1), out=planar(out).reshape(-1))
            return out
        frames, places = weights.reshape(-1, self.count), planar(out)
        places = places.reshape(3, len(frames), *places.shape[-2:])
        if self._by_vertices:
            self._write_sums(frames, places.reshape(3, len(frames), self._nodes))
        else:
            self._write_by_modes(frames, places)
        return out

    def _write_sums(self, frames: Array, out: Array) -> None:
        """Write (3, F, numbers) sums of the numbers of the basis: x, y and z in turn.

        Bound by arithmetic: in parts that fit a cache it is no faster.
        """
        np.matmul(frames, self._basis.swapaxes(0, 1), out=out)

    def _write_by_modes(self, frames: Array, places: Array) -> None:
        size = self._basis.shape[-1]
        together, each = max(1, MODES_CHUNK // (3 * size)), max(1, CHUNK // (2 * self._nodes))
        buffer = np.empty((3, min(together, len(frames)), size), self.dtype)
        for first in range(0, len(frames), together):
            some = frames[first : first + together]
            flat = buffer if len(some) == buffer.shape[1] else np.empty_like(buffer[:, : len(some)])
            self._write_sums(some, flat)
            modes = flat.reshape(3, len(some), *self._grid)
            for start in range(0, len(some), each):
                stop = min(start + each, len(some))
                place = places[:, first + start : first + stop]
                self._evaluator.write_from_modes(modes[:, start:stop], np.moveaxis(place, 0, -1))
