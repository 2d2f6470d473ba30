"""Smooth curves over time, from which the built-in clips are made.

All are continuously differentiable: a face that stops or starts in one frame looks like a machine.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

__all__ = ["bump", "eased", "through", "window"]

FloatArray = NDArray[np.float64]


def eased(times: FloatArray, start: float, stop: float) -> FloatArray:
    """0 before ``start``, 1 after ``stop``, and between them the fairest quintic.

    It is ``10 s^3 - 15 s^4 + 6 s^5``, the path of least jerk, which hands and heads follow.
    """
    share = np.clip((times - start) / (stop - start), 0.0, 1.0)
    return share**3 * (10.0 + share * (6.0 * share - 15.0))


def bump(times: FloatArray, middle: float, width: float, plateau: float = 0.0) -> FloatArray:
    """0, up to 1 around ``middle`` and down again.

    Args:
        times: seconds.
        middle: seconds.
        width: from where it leaves 0 to where it is back, seconds.
        plateau: how long it stays at 1, seconds.
    """
    ramp = (width - plateau) / 2.0
    begin, end = middle - width / 2.0, middle + width / 2.0
    return eased(times, begin, begin + ramp) - eased(times, end - ramp, end)


def window(times: FloatArray, duration: float, ramp: float) -> FloatArray:
    """1 within 0..duration, and 0 at both its ends."""
    return bump(times, duration / 2.0, duration, duration - 2.0 * ramp)


def through(times: FloatArray, knots: Sequence[tuple[float, float]]) -> FloatArray:
    """The monotone cubic through (time, value) knots; it holds the first and the last.

    Between knots it never leaves their values (Fritsch and Butland's slopes: the weighted harmonic
    mean of the two neighbouring ones, 0 at turning points), and at both ends it is level.
    """
    at, values = (np.array(column, dtype=np.float64) for column in zip(*knots, strict=True))
    steps, slopes = np.diff(at), np.diff(values) / np.diff(at)
    tangents = np.zeros(len(at))
    same = slopes[:-1] * slopes[1:] > 0
    before, after = 2 * steps[1:] + steps[:-1], steps[1:] + 2 * steps[:-1]
    safe = np.where(same, slopes[:-1], 1.0), np.where(same, slopes[1:], 1.0)
    mean = (before + after) / (before / safe[0] + after / safe[1])
    tangents[1:-1] = np.where(same, mean, 0.0)

    moments = np.clip(times, at[0], at[-1])
    left = np.clip(np.searchsorted(at, moments, side="right") - 1, 0, len(steps) - 1)
    share, step = (moments - at[left]) / steps[left], steps[left]
    rest = 1.0 - share
    return (
        values[left] * rest**2 * (1.0 + 2.0 * share)
        + values[left + 1] * share**2 * (1.0 + 2.0 * rest)
        + step * share * rest * (tangents[left] * rest - tangents[left + 1] * share)
    )
