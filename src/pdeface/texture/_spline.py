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

import math
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
    """Values of any number of curves at the same places.

    Args:
        knots: (..., n) increasing along the last axis.
        polynomials: (..., n + 1, 4) as from :func:`coefficients`.
        at: (m,) increasing.

    Returns:
        (..., m) values.
    """
    at = np.asarray(at, float)
    knots = np.broadcast_to(knots, (*polynomials.shape[:-2], np.shape(knots)[-1]))
    count, pieces = math.prod(knots.shape[:-1]), polynomials.shape[-2]
    # Each knot begins a piece: counting those to the left of a place gives the piece it is on.
    begins = np.searchsorted(at, knots).reshape(count, -1)
    begins += np.arange(count)[:, None] * (len(at) + 1)
    marks = np.bincount(begins.ravel(), minlength=count * (len(at) + 1))
    piece = np.cumsum(marks.reshape(count, -1)[:, :-1], axis=1)
    piece += np.arange(count)[:, None] * pieces
    origins = np.concatenate([knots[..., :1], knots], axis=-1)
    d = at - origins.reshape(-1)[piece]
    flat = polynomials.reshape(-1, 4)
    result = flat[:, 3][piece]
    for power in (2, 1, 0):
        result = result * d + flat[:, power][piece]
    return np.asarray(result.reshape(*knots.shape[:-1], len(at)))


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
