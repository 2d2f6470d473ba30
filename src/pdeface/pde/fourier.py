"""Fourier modes of closed curves, and the wave number that each mode has in u.

Every closed curve of M points is *exactly* the trigonometric polynomial of its M data points. The
paper solves modes 0 to N with w = a n and sends the rest, what is left between the curve and its
first N modes, through the remainder of equations (6) and (7) with w = a (N + 1). The remainder is
linear and acts on each v alone, so it is the sum of the modes above N, each with that w; nothing
else distinguishes it, and the surface meets every curve for every N.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from pdeface.curves import curve_parameters

__all__ = ["analysis", "synthesis", "wave_numbers"]

FloatArray = NDArray[np.float64]


def analysis(count: int) -> FloatArray:
    """(2, modes, M) weights of the M data points in the cosine and the sine coefficients of
    modes 0 to M // 2 (equation 2)."""
    waves = synthesis(count, curve_parameters(count)).transpose(0, 2, 1) * (2.0 / count)
    waves[:, 0] /= 2.0
    if count % 2 == 0:  # cos(M/2 v) vanishes at every data point, sin(M/2 v) is +1 or -1
        waves[0, -1] = 0.0
        waves[1, -1] /= 2.0
    return waves


def synthesis(count: int, v: Any, derivative: int = 0) -> FloatArray:
    """(2, V, modes) values of cos(nv) and sin(nv), or of their derivatives, for the modes that
    M = ``count`` data points have."""
    n = np.arange(count // 2 + 1)
    angle = np.multiply.outer(np.asarray(v, dtype=np.float64), n) + derivative * (np.pi / 2)
    return np.stack([np.cos(angle), np.sin(angle)]) * n.astype(np.float64) ** derivative


def wave_numbers(count: int, a: float, modes: int) -> FloatArray:
    """(M // 2 + 1,) wave number in u of each mode: a n up to N, a (N + 1) above."""
    return a * np.minimum(np.arange(count // 2 + 1), modes + 1).astype(np.float64)
