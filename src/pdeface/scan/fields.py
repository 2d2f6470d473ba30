"""Fields on the grid of the face: normals, and smoothing that fills where nothing is known."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

__all__ = ["enlarged", "normals", "smoothed"]

FloatArray = NDArray[np.float64]

_TRUNCATE = 3.0
_ODD = np.array([1.0, 1.0, -1.0])


def normals(points: FloatArray) -> FloatArray:
    """(U, V, 3) unit outward normals of a (U, V, 3) grid, by differences."""
    down, across = np.gradient(points, axis=0), np.gradient(points, axis=1)
    normal = np.cross(down, across)
    length = np.linalg.norm(normal, axis=2, keepdims=True)
    return np.asarray(normal / np.where(length > 0.0, length, 1.0))


def smoothed(
    values: FloatArray, trust: FloatArray, widths: tuple[float, float], floor: float = 0.02
) -> FloatArray:
    """Weighed Gaussian means of displacements.

    Across the sides of the face they go on as those of closed curves do: x and y even, z odd.

    Args:
        values: (U, V, 3).
        trust: (U, V) weights, 0 where nothing is known.
        widths: standard deviations in rows and in columns.
        floor: weight of no displacement at all, where there is nothing near.
    """
    reach = min(int(_TRUNCATE * widths[1]) + 1, values.shape[1])
    weighed = values * trust[..., None]
    closed = _closed(weighed, reach, _ODD)
    of_trust = _closed(trust[..., None], reach, np.ones(1))
    both = _blurred(np.concatenate([closed, of_trust], axis=2), widths)
    both = both[:, reach : both.shape[1] - reach]
    return np.asarray(both[..., :3] / (both[..., 3:] + floor))


def _closed(values: FloatArray, reach: int, sign: FloatArray) -> FloatArray:
    before, after = values[:, :reach][:, ::-1] * sign, values[:, -reach:][:, ::-1] * sign
    return np.concatenate([before, values, after], axis=1)


def _blurred(values: FloatArray, widths: tuple[float, float]) -> FloatArray:
    from scipy.ndimage import gaussian_filter1d

    for axis, width in enumerate(widths):
        if width > 0.0:
            values = gaussian_filter1d(values, width, axis=axis, mode="nearest", truncate=_TRUNCATE)
    return values


def enlarged(values: FloatArray, step: int, shape: tuple[int, int]) -> FloatArray:
    """Values (u, v, n) at every so many-th node of a grid at all its nodes, linearly."""
    if step == 1:
        return values
    for axis in (0, 1):
        at = np.arange(shape[axis]) / step
        low = np.minimum(at.astype(int), values.shape[axis] - 1)
        high = np.minimum(low + 1, values.shape[axis] - 1)
        share = (at - low).reshape((-1, 1, 1) if axis == 0 else (1, -1, 1))
        values = (1.0 - share) * values.take(low, axis) + share * values.take(high, axis)
    return values
