"""Blurs and steps for masks: small tools with numpy alone."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

__all__ = ["blur", "enlarge", "step"]

FloatArray = NDArray[np.floating[Any]]


def step(low: float, high: float, x: FloatArray) -> FloatArray:
    """0 below ``low``, 1 above ``high``, smooth between; falling if ``high`` is the lower."""
    t = np.clip((x - low) / (high - low), 0.0, 1.0)
    return np.asarray(t * t * (3.0 - 2.0 * t))


def blur(image: FloatArray, radius: float) -> FloatArray:
    """(H, W, ...) nearly a Gaussian of this standard deviation, in pixels: three running means.

    Beyond its border an image goes on as it is there.
    """
    # Three means of n pixels have the variance (n^2 - 1) / 4.
    width = max(1, round(float(np.sqrt(4.0 * radius**2 + 1.0))) | 1)
    result = image.astype(np.float32)
    for axis in (0, 1):
        moved = np.moveaxis(result, axis, 0)
        for _ in range(3):
            moved = _running_mean(moved, width)
        result = np.moveaxis(moved, 0, axis)
    return result


def _running_mean(image: FloatArray, width: int) -> FloatArray:
    before = width // 2
    ends = [(before + 1, before)] + [(0, 0)] * (image.ndim - 1)
    sums = np.cumsum(np.pad(image, ends, mode="edge"), axis=0, dtype=np.float64)
    return np.asarray((sums[width:] - sums[:-width]) / width, dtype=np.float32)


def enlarge(image: FloatArray, shape: tuple[int, int], rows: slice | None = None) -> FloatArray:
    """(H, W, ...) the image at another size, bilinear between the middles of its pixels.

    Args:
        image: (h, w, ...).
        shape: (H, W).
        rows: which rows of the result to make; all by default.
    """
    wanted = np.arange(shape[0])[rows or slice(None)], np.arange(shape[1])
    result = image
    for axis, (length, at) in enumerate(zip(shape, wanted, strict=True)):
        moved = np.moveaxis(result, axis, 0)
        count = len(moved)
        place = np.clip((at + 0.5) * (count / length) - 0.5, 0.0, count - 1.0)
        first = np.minimum(place.astype(np.intp), max(count - 2, 0))
        share = (place - first).astype(np.float32).reshape(-1, *[1] * (moved.ndim - 1))
        here, next_ = moved[first], moved[np.minimum(first + 1, count - 1)]
        next_ -= here
        next_ *= share
        next_ += here
        result = np.moveaxis(next_, 0, axis)
    return np.asarray(result)
