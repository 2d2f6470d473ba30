"""Values at the nodes of a cut uv mesh, carried to the texels of a texture."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

__all__ = ["at_texels"]

FloatArray = NDArray[np.floating[Any]]


def at_texels(values: FloatArray, nodes: NDArray[np.float64], shape: tuple[int, int]) -> FloatArray:
    """(H, W, k) float32 values at the middles of texels, linear between the nodes.

    Along a column the nodes lie where the cut put them, two of them in one place where lips meet:
    each side of an opening keeps to its own.

    Args:
        values: (R, C, k) at the nodes.
        nodes: (R, C, 2) u and v of the nodes; u does not fall along a column, v is one for all of
            a column.
        shape: (H, W) of the texture.
    """
    height, width = shape
    u = (np.arange(height) + 0.5) / height
    v = (np.arange(width) + 0.5) * (np.pi / width)
    columns, count = values.shape[1:]
    lines = np.empty((height, columns, count), np.float32)
    for column in range(columns):
        for k in range(count):
            lines[:, column, k] = np.interp(u, nodes[:, column, 0], values[:, column, k])
    place = np.interp(v, nodes[0, :, 1], np.arange(columns))
    first = np.minimum(place.astype(np.intp), columns - 2)
    share = (place - first).astype(np.float32)[:, None]
    return np.asarray(lines[:, first] * (1.0 - share) + lines[:, first + 1] * share)
