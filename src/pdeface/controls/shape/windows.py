"""Smooth windows: weights from 0 to 1 that say where a control acts.

All have two continuous derivatives and are exactly 0 outside their support. Most are functions of
places in space, so that what they weigh is a motion of space itself: as long as its gradient stays
below 1 it folds no surface, on any mesh.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

__all__ = ["STEEPEST", "dome", "fall", "hill", "rise"]

FloatArray = NDArray[np.float64]

# Share of a rise over which its slope grows, and again over which it dies away. The slope is even
# between, which keeps the steepest place low: 1.5 times the average, where a quintic has 1.875.
_ROUNDING = 1.0 / 3.0

STEEPEST = 1.0 / (1.0 - _ROUNDING)
"""Greatest slope of a rise of unit height and width."""


def rise(values: ArrayLike, start: float, end: float) -> FloatArray:
    """From 0 at ``start`` to 1 at ``end``, monotone, C2; ``end`` may be the smaller."""
    t = (np.asarray(values, dtype=np.float64) - start) / (end - start)
    grown = _onset(t / _ROUNDING) - _onset((t - 1.0 + _ROUNDING) / _ROUNDING)
    return np.where(t >= 1.0, 1.0, STEEPEST * _ROUNDING * grown)


def fall(values: ArrayLike, start: float, end: float) -> FloatArray:
    """From 1 at ``start`` to 0 at ``end``, exactly 0 beyond; ``end`` may be the smaller."""
    return rise(values, end, start)


def hill(values: ArrayLike, start: float, top: float, top_end: float, end: float) -> FloatArray:
    """0 up to ``start``, 1 from ``top`` to ``top_end``, 0 from ``end`` on."""
    return rise(values, start, top) * fall(values, top_end, end)


def dome(
    points: FloatArray,
    centre: ArrayLike,
    radii: tuple[float, float, float],
    core: float = 0.0,
) -> FloatArray:
    """1 at a centre and 0 outside the ellipsoid around it.

    Args:
        points: (..., 3) metres.
        centre: (3,) metres.
        radii: semi-axes along x, y and z, metres; infinity for a cylinder.
        core: share of the radii up to which the weight stays 1.
    """
    offset = (points - np.asarray(centre)) / np.asarray(radii)
    return fall(np.sqrt((offset * offset).sum(axis=-1)), core, 1.0)


def _onset(s: FloatArray) -> FloatArray:
    """Integral of the smoothstep 3 s^2 - 2 s^3, which is 1 from s = 1 on."""
    inside = np.clip(s, 0.0, 1.0)
    return inside**3 - 0.5 * inside**4 + np.maximum(s - 1.0, 0.0)
