"""How noisy the vertices of a scan are, and how widely that has to be smoothed."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from pdeface.scan.surface import Scan

__all__ = ["noise_of", "quiet_width"]

FloatArray = NDArray[np.float64]

_LEFT = 0.15e-3
"""Metres of noise that may be left."""

_SHAPE = 0.045
"""Share of the distance between vertices that the shape of a head may seem to be noisy."""

_USUAL = 0.674
_GAIN = 1.4
"""Median of the size of a standard normal variable; and what twice the difference from six
neighbours makes of noise."""


def noise_of(scan: Scan) -> float:
    """Standard deviation of a mesh's vertices along their normals, in its unit; 0 for a cloud.

    From how far vertices lie above their neighbours, less how far those do themselves: curvature
    that varies slowly has no share in it.
    """
    if scan.is_cloud:
        return 0.0
    a, b, c = scan.triangles.T
    start, end = np.concatenate([a, b, c, b, c, a]), np.concatenate([b, c, a, a, b, c])
    middle = _around(scan.vertices, start, end)
    above = ((scan.vertices - middle) * scan.normals).sum(axis=1, keepdims=True)
    odd = np.abs(above - _around(above, start, end))
    return float(np.median(odd)) / (_USUAL * _GAIN)


def quiet_width(scan: Scan) -> float:
    """Standard deviation of a Gaussian mean, metres, that leaves 0.15 mm of the noise.

    A mean over ``4 pi w^2 / s^2`` vertices, s apart, divides noise by the root of their number.
    What may be the shape of a coarse mesh is no noise.
    """
    shape = _SHAPE * scan.spacing
    noise = np.sqrt(max(noise_of(scan) ** 2 - shape**2, 0.0))
    return float(noise * scan.spacing / (np.sqrt(4.0 * np.pi) * _LEFT))


def _around(values: FloatArray, start: NDArray[np.int64], end: NDArray[np.int64]) -> FloatArray:
    """(V, n) means of values at the neighbours."""
    count = len(values)
    number = np.maximum(np.bincount(start, minlength=count), 1)
    sums = [np.bincount(start, column[end], count) for column in values.T]
    return np.stack(sums, axis=1) / number[:, None]
