"""Values at the nodes of a cut uv mesh, carried to the texels of a texture."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

__all__ = ["Texels", "at_texels"]

FloatArray = NDArray[np.floating[Any]]


class Texels:
    """Values at the middles of texels, linear between the nodes.

    Along a column the nodes lie where the cut put them, two of them in one place where lips meet:
    each side of an opening keeps to its own.

    Args:
        values: (R, C, k) at the nodes.
        nodes: (R, C, 2) u and v of the nodes; u does not fall along a column, v is one for all of
            a column.
        shape: (H, W) of the texture.
    """

    def __init__(
        self, values: FloatArray, nodes: NDArray[np.float64], shape: tuple[int, int]
    ) -> None:
        height, width = shape
        u = (np.arange(height) + 0.5) / height
        columns, count = values.shape[1:]
        self._lines = np.empty((height, columns, count), np.float32)
        for column in range(columns):
            for k in range(count):
                line = np.interp(u, nodes[:, column, 0], values[:, column, k])
                self._lines[:, column, k] = line
        v = (np.arange(width) + 0.5) * (np.pi / width)
        place = np.interp(v, nodes[0, :, 1], np.arange(columns))
        self._first = np.minimum(place.astype(np.intp), columns - 2)
        self._share = (place - self._first).astype(np.float32)[:, None]

    def rows(self, rows: slice) -> FloatArray:
        """(h, W, k) float32 values in some rows of the texture."""
        lines = self._lines[rows]
        here, next_ = lines[:, self._first], lines[:, self._first + 1]
        next_ -= here
        next_ *= self._share
        next_ += here
        return next_


def at_texels(values: FloatArray, nodes: NDArray[np.float64], shape: tuple[int, int]) -> FloatArray:
    """(H, W, k) values at all texels, as :class:`Texels` gives them."""
    return Texels(values, nodes, shape).rows(slice(None))
