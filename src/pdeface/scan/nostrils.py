"""How deep the nostrils of a scan are: those of the neutral face, shallower or closed.

A nostril is the one place where the neutral face says little of the scan's: there a scanner sees a
shallow dent, a pit or a dark hole. The bottom of a pit is too far from that of a dent for nearest
places to bring them together, so the depth is found before, as one number for each nostril.
"""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from pdeface.scan.fields import normals
from pdeface.scan.model import dense_neutral
from pdeface.scan.nearest import Target, flat
from pdeface.template import row_u

__all__ = ["fitted_nostrils"]

FloatArray = NDArray[np.float64]

_ASIDE, _HALF_U, _HALF_V = 0.162, 0.0205, 0.086
"""Where the nostrils are: radians from the midline to their middles, and half their sizes."""

_SHALLOWER = np.linspace(0.0, 1.25, 6)
"""Shares of the way from the neutral face's nostrils to a membrane over them that are tried."""

_FAR = 6.0e-3
"""Metres from which on a place of the scan is none of the nostril."""


def fitted_nostrils(points: FloatArray, target: Target) -> FloatArray:
    """The face with nostrils as deep as the scan's.

    Args:
        points: (U, V, 3) the face on its grid, nearly on the scan.
        target: the scan, by place and normal.
    """
    points = points.copy()
    for inside, closing in _closings(*points.shape[:2]):
        tried = [points + share * closing for share in _SHALLOWER]
        points = tried[int(np.argmin([_off(grid, inside, target) for grid in tried]))]
    return points


def _off(points: FloatArray, inside: NDArray[np.bool_], target: Target) -> float:
    """Mean squared distance in place and normal of a nostril from the scan."""
    here, facing = points[inside], normals(points)[inside]
    found = target.nearest(here, facing)
    turned = ((found.normals - facing) ** 2).sum(axis=1)
    return float(np.minimum(found.away**2 + target.breadth**2 * turned, _FAR**2).mean())


@lru_cache(maxsize=2)
def _closings(rows: int, columns: int) -> list[tuple[NDArray[np.bool_], FloatArray]]:
    """For each nostril its nodes, and the (U, V, 3) way of them to a membrane over its rim."""
    u, v = np.linspace(0.0, 1.0, rows), (np.arange(columns) + 0.5) * (np.pi / columns)
    neutral, result = dense_neutral(u, v), []
    for side in (-1.0, 1.0):
        down = (u[:, None] - row_u("nostrils")) / _HALF_U
        across = (v - 0.5 * np.pi - side * _ASIDE) / _HALF_V
        inside = down**2 + across**2 < 1.0
        closing = np.zeros_like(neutral)
        closing[inside] = _membrane(neutral, inside) - neutral[inside]
        result.append((inside, closing))
    return result


def _membrane(points: FloatArray, inside: NDArray[np.bool_]) -> FloatArray:
    """(n, 3) the places inside that continue those around them most smoothly (thin plate)."""
    from scipy.sparse import coo_array
    from scipy.sparse.linalg import spsolve

    near = np.flatnonzero(_grown(inside))
    columns = inside.shape[1]
    around = near[:, None] + np.array([-columns, columns, -1, 1])
    centre = np.repeat(np.arange(len(near))[:, None], 4, axis=1)
    rows = np.concatenate([np.arange(len(near)), centre.ravel()])
    cells = np.concatenate([near, around.ravel()])
    values = np.concatenate([np.full(len(near), 4.0), np.full(around.size, -1.0)])
    laplace = coo_array((values, (rows, cells)), (len(near), inside.size)).tocsc()
    unknown = inside.ravel()
    free, fixed = laplace[:, unknown], laplace[:, ~unknown]
    right = -free.T @ (fixed @ flat(points)[~unknown])
    return np.asarray(spsolve((free.T @ free).tocsc(), right))


def _grown(inside: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """The nodes and those beside them."""
    grown = inside.copy()
    for axis in (0, 1):
        for step in (-1, 1):
            grown |= np.roll(inside, step, axis)
    return grown
