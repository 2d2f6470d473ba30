"""Splines that never overshoot: what keeps an interpolated warp mesh from folding.

A cubic through the mesh nodes with the slopes of the three-point formula (Catmull-Rom for uneven
knots), each slope then held within three times the smaller of the two neighbouring secants and
set to zero at a turning point (Fritsch and Carlson, 1980). Through increasing values it is
increasing, so a row of the warp never runs backwards; it reproduces straight lines; and moving
one node changes the curve between its second neighbours only. The natural spline has neither the
first nor the last property, and what it has instead, a continuous second derivative, cannot be
seen in a warped picture.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

__all__ = ["coefficients", "evaluate"]

FloatArray = NDArray[np.float64]


def coefficients(knots: Any, values: Any) -> FloatArray:
    """The curves' polynomials, in powers of the distance from the knot each begins at.

    Args:
        knots: (..., n) increasing along the last axis, n >= 2.
        values: (..., n).

    Returns:
        (..., n + 1, 4): constant, linear, quadratic and cubic coefficient of the straight line
        before the first knot (which it starts from), the n - 1 pieces between the knots, and the
        straight line behind the last.
    """
    knots, values = np.broadcast_arrays(np.asarray(knots, float), np.asarray(values, float))
    steps = np.diff(knots, axis=-1)
    secants = np.diff(values, axis=-1) / steps
    slopes = _slopes(steps, secants)
    starts, ends = slopes[..., :-1], slopes[..., 1:]
    result = np.zeros((*values.shape[:-1], values.shape[-1] + 1, 4))
    result[..., 1:, 0] = values
    result[..., 0, 0] = values[..., 0]
    result[..., 1:, 1] = slopes
    result[..., 0, 1] = slopes[..., 0]
    result[..., 1:-1, 2] = (3.0 * secants - 2.0 * starts - ends) / steps
    result[..., 1:-1, 3] = (starts + ends - 2.0 * secants) / steps**2
    return result


def evaluate(knots: Any, polynomials: FloatArray, at: Any) -> FloatArray:
    """Values of curves, each at its own or all at the same places.

    Args:
        knots: (..., n) increasing along the last axis.
        polynomials: (..., n + 1, 4) as from :func:`coefficients`.
        at: (..., m) increasing along the last axis.

    Returns:
        (..., m) values.
    """
    knots, at = np.asarray(knots, float), np.asarray(at, float)
    result = None
    for piece in range(polynomials.shape[-2]):
        d = at - knots[..., max(piece - 1, 0), None]
        c0, c1, c2, c3 = (polynomials[..., piece, k, None] for k in range(4))
        values = ((c3 * d + c2) * d + c1) * d + c0
        result = values if result is None else np.where(d >= 0.0, values, result)
    assert result is not None
    return np.asarray(result)


def _slopes(steps: FloatArray, secants: FloatArray) -> FloatArray:
    """(..., n) slopes at the knots; at the ends those of the natural spline, limited as well."""
    if secants.shape[-1] == 1:
        return np.concatenate([secants, secants], axis=-1)
    before, after = secants[..., :-1], secants[..., 1:]
    inner = (steps[..., 1:] * before + steps[..., :-1] * after) / (steps[..., 1:] + steps[..., :-1])
    limit = 3.0 * np.minimum(np.abs(before), np.abs(after))
    inner = np.where(before * after > 0.0, np.clip(inner, -limit, limit), 0.0)
    first = _end_slope(secants[..., :1], inner[..., :1])
    last = _end_slope(secants[..., -1:], inner[..., -1:])
    return np.concatenate([first, inner, last], axis=-1)


def _end_slope(secant: FloatArray, neighbour: FloatArray) -> FloatArray:
    """Slope at an end that makes the second derivative vanish there, of the secant's sign."""
    ratio = np.divide(neighbour, secant, out=np.ones_like(secant), where=secant != 0.0)
    return np.asarray(secant * np.clip(1.5 - 0.5 * ratio, 0.0, 3.0))
