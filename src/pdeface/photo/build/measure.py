"""From finds in many pictures to the landmarks' places on the face, and how they err."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from pdeface.photo.build.renders import GRID

__all__ = ["MODES", "common_errors", "places_on_face"]

FloatArray = NDArray[np.float64]

MODES = 30
"""Ways in which the landmarks err together that are kept: they hold 95 per cent of it."""


def places_on_face(found: FloatArray, places: FloatArray) -> FloatArray:
    """Where on the face landmarks lie that were found in n pictures.

    Args:
        found: (n, landmarks, 2) in each picture.
        places: (n, vertices, 2) where the vertices of the uv mesh ``GRID`` are in each.

    Returns:
        (landmarks, 2) u and v of the point whose places are nearest to the finds, by the sum of
        squares over all pictures.
    """
    squares = np.einsum("nvx,nvx->v", places, places)[None]
    flat_found = found.transpose(1, 0, 2).reshape(found.shape[1], -1)
    flat_places = places.transpose(1, 0, 2).reshape(places.shape[1], -1)
    cost = squares - 2.0 * flat_found @ flat_places.T + (flat_found**2).sum(axis=1)[:, None]
    row, column = np.divmod(cost.argmin(axis=1), GRID[1])
    row, column = np.clip(row, 1, GRID[0] - 2), np.clip(column, 1, GRID[1] - 2)
    cost, at = cost.reshape(-1, *GRID), np.arange(len(cost))
    u = row + _valley(*(cost[at, row + step, column] for step in (-1, 0, 1)))
    v = column + _valley(*(cost[at, row, column + step] for step in (-1, 0, 1)))
    return np.stack([u / (GRID[0] - 1), np.pi * v / (GRID[1] - 1)], axis=1)


def common_errors(
    found: FloatArray, places: FloatArray, uv: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """How finds differ from where the surface has the landmarks.

    Args:
        found: (n, landmarks, 2).
        places: (n, vertices, 2).
        uv: (landmarks, 2).

    Returns:
        (``MODES``, landmarks, 2) the principal ways in which they differ together, each of one
        standard deviation, and (landmarks,) the root mean square on one axis of what is left.
    """
    off = (found - _at(places, uv)).reshape(len(found), -1)
    amounts, sizes, ways = np.linalg.svd(off, full_matrices=False)
    modes = sizes[:MODES, None] * ways[:MODES] / np.sqrt(len(found))
    left = off - (amounts[:, :MODES] * sizes[:MODES]) @ ways[:MODES]
    shape = found.shape[1:]
    spread = np.sqrt((left.reshape(-1, *shape) ** 2).mean(axis=(0, 2)))
    return modes.reshape(-1, *shape), spread


def _at(places: FloatArray, uv: FloatArray) -> FloatArray:
    """(n, landmarks, 2) places of points of the face, between those of the mesh's vertices."""
    mesh = places.reshape(len(places), *GRID, 2)
    row, column = uv[:, 0] * (GRID[0] - 1), uv[:, 1] / np.pi * (GRID[1] - 1)
    i, j = (np.clip(x.astype(int), 0, n - 2) for x, n in ((row, GRID[0]), (column, GRID[1])))
    down, across = (row - i)[:, None], (column - j)[:, None]
    upper = (1.0 - across) * mesh[:, i, j] + across * mesh[:, i, j + 1]
    lower = (1.0 - across) * mesh[:, i + 1, j] + across * mesh[:, i + 1, j + 1]
    return np.asarray((1.0 - down) * upper + down * lower)


def _valley(before: FloatArray, middle: FloatArray, after: FloatArray) -> FloatArray:
    """Where the parabola through three neighbours has its minimum, from the middle one."""
    bend = before - 2.0 * middle + after
    step = 0.5 * (before - after) / np.where(bend > 0.0, bend, np.inf)
    return np.clip(step, -0.5, 0.5)
