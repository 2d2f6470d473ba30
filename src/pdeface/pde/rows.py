"""Rows: which interval each u lies in, and the weights of the curves there."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from pdeface.errors import InputError
from pdeface.pde.joins import Continuity, Join, slopes
from pdeface.pde.kernel import hermite

__all__ = ["Rows", "Side", "locate", "row_weights", "u_weights"]

FloatArray = NDArray[np.float64]

Side = Literal["before", "after"]
"""From which side a curve's own u is approached, where a crease makes a difference. At the two
curves of a slit it is always the side that is not the strip between them."""

# Weights below this are denormals in the making: they cost much and count for nothing.
NEGLIGIBLE = 1e-16


class Rows(NamedTuple):
    """Interval between neighbouring curves, and position t in [0, 1] within it."""

    interval: NDArray[np.intp]
    t: FloatArray

    def on_curves(self) -> slice | None:
        """The curves that the rows are, if every row is one, in even steps."""
        curve = self.interval + np.rint(self.t).astype(np.intp)
        step = int(curve[1] - curve[0]) if len(curve) > 1 else 1
        if step < 1 or not np.isin(self.t, (0.0, 1.0)).all() or (np.diff(curve) != step).any():
            return None
        return slice(int(curve[0]), int(curve[-1]) + 1, step)


def locate(
    u: Any,
    count: int,
    side: Side = "after",
    continuity: Mapping[int, Continuity] | None = None,
) -> Rows:
    """Interval of each u among ``count`` curves at ``u = k / (count - 1)``.

    Raises:
        InputError: u outside [0, 1], or an unknown side.
    """
    if side not in ("before", "after"):
        raise InputError(f"side must be 'before' or 'after', got {side!r}")
    u = np.asarray(u, dtype=np.float64)
    if u.size and not (u.min() >= 0.0 and u.max() <= 1.0):
        raise InputError(f"u must lie in [0, 1], got {u.min():g} to {u.max():g}")
    scaled = u * (count - 1)
    nearest = np.rint(scaled)
    # u = k / (K - 1) rounds to either side of curve k; it shall mean the curve.
    on_curve = np.abs(scaled - nearest) < 1e-12 * count
    interval = np.where(on_curve, nearest - (side == "before"), np.floor(scaled))
    for curve, kind in (continuity or {}).items():
        if kind == "slit":
            interval[on_curve & (nearest == curve)] = curve - 1
            interval[on_curve & (nearest == curve + 1)] = curve + 1
    interval = np.clip(interval, 0, count - 2).astype(np.intp)
    return Rows(interval, np.where(on_curve, nearest, scaled) - interval)


def row_weights(rows: Rows, w: float, of_slopes: FloatArray, derivative: int = 0) -> FloatArray:
    """(U, K) weights of the K curves' positions in one mode of wave number w on each row.

    Args:
        rows: from :func:`locate`.
        w: wave number in u.
        of_slopes: from :func:`pdeface.pde.joins.slopes` for the same w.
        derivative: order of the derivative with respect to u.
    """
    interval, t = rows
    intervals = len(of_slopes)
    at_ends = hermite(w / intervals, t, derivative)
    weights: FloatArray = at_ends[:, 2, None] * of_slopes[interval, 0]
    weights += at_ends[:, 3, None] * of_slopes[interval, 1]
    row = np.arange(len(t))
    weights[row, interval] += at_ends[:, 0]
    weights[row, interval + 1] += at_ends[:, 1]
    weights *= float(intervals) ** derivative
    weights[np.abs(weights) < NEGLIGIBLE] = 0.0
    return weights


def u_weights(
    u: Any,
    w: float,
    count: int,
    join: Join = "smooth",
    continuity: Mapping[int, Continuity] | None = None,
    side: Side = "after",
    derivative: int = 0,
) -> FloatArray:
    """(U, K) weights of the K curves' positions in one mode of wave number w at each of (U,) u."""
    rows = locate(np.atleast_1d(u), count, side, continuity)
    return row_weights(rows, w, slopes(w, count, join, continuity), derivative)
