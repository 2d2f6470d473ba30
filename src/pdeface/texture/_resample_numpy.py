"""The two passes of the mesh warp in numpy: every line of the image resampled by its own map.

A source row is taken as the continuous curve that is a parabola within each pixel, has the
pixel's value as its mean there, and meets its neighbour half-way between their values on the edge
they share. An output pixel is the exact mean of that curve over the pixel's preimage. So nothing
is skipped where a row shrinks (no aliasing), nothing is repeated where it grows (no blocks), a
preimage that is one whole pixel gives that pixel to the last bit, and a constant stays constant.

Within pixel i, at t from its left edge, the integral of the curve from that edge is ::

    f[i] t - a D[i] - b D[i + 1],    a = t (1 - t)^2 / 2,    b = t^2 (1 - t) / 2

with the differences ``D[i] = f[i] - f[i - 1]``; beyond its ends the row repeats its last pixel.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from pdeface.texture import _spline

__all__ = ["SNAP", "THIN", "LineMaps", "edge_map", "two_pass"]

FloatArray = NDArray[np.float64]
IndexArray = NDArray[np.intp]

LineMaps = tuple[FloatArray, FloatArray]
"""Of n lines: (n, C) knots in the output, and the (n, C + 1, 4) polynomials of
``_spline.coefficients`` that lead from there to the source."""

SNAP = 1e-6
"""A preimage's end so near to a pixel's edge is on it: rounding must not blur an identity."""

THIN = 1e-3
"""Preimages narrower than this many pixels are read off as points."""

_BLOCK = 1 << 16
"""Samples worked on at a time: what stays in a processor's cache."""


def edge_map(maps: LineMaps, width: int, length: int) -> FloatArray:
    """Where the edges between the output pixels of each row come from.

    Args:
        maps: of n rows.
        width: pixels of an output row.
        length: pixels of a source row.

    Returns:
        (n, width + 1) positions in [0, length], never decreasing along a row.
    """
    edges = _spline.evaluate(*maps, np.arange(width + 1.0))
    nearest = np.rint(edges)
    edges = np.where(np.abs(edges - nearest) < SNAP, nearest, edges)
    return np.asarray(np.clip(edges, 0.0, length))


def two_pass(
    image: NDArray[Any], horizontal: LineMaps, vertical: LineMaps, shape: tuple[int, int]
) -> NDArray[Any]:
    """Resample every row, then every column of the result.

    Args:
        image: (h, w, channels).
        horizontal: from each output row to the source row, h of them.
        vertical: from each output column to the source column, ``width`` of them.
        shape: (height, width) of the result.

    Returns:
        (height, width, channels), of the image's type; integers are rounded and clipped.
    """
    between = _resample(image, horizontal, shape[1], _work(image.dtype))
    return _resample(between, vertical, shape[0], image.dtype)


def _resample(
    image: NDArray[Any], maps: LineMaps, width: int, dtype: np.dtype[Any]
) -> NDArray[Any]:
    """Every row of ``image``, resampled to ``width`` pixels; rows become columns."""
    count, length, channels = image.shape
    result = np.empty((width, count, channels), dtype)
    block = max(1, _BLOCK // max(width, length))
    for first in range(0, count, block):
        part = slice(first, first + block)
        edges = edge_map((maps[0][part], maps[1][part]), width, length)
        values = _means(np.asarray(image[part], _work(image.dtype)), edges)
        if dtype.kind == "u":
            values = np.clip(np.rint(values), 0, np.iinfo(dtype).max)
        result[:, part] = values.transpose(1, 0, 2)
    return result


def _work(dtype: np.dtype[Any]) -> np.dtype[Any]:
    """The type to compute in: single precision, unless the image is double."""
    return np.dtype(np.float64 if dtype == np.float64 else np.float32)


def _means(rows: NDArray[Any], edges: FloatArray) -> NDArray[Any]:
    """Mean of each row's curve between neighbouring edges: (n, width, channels)."""
    count, length, channels = rows.shape
    pixel = np.minimum(edges.astype(np.intp), length - 1)
    t = edges - pixel
    padded = np.pad(rows, ((0, 0), (1, 2), (0, 0)), mode="edge").reshape(-1, channels)
    index = pixel[:, :-1] + (np.arange(count) * (length + 3))[:, None]
    before, value, after, second = (np.take(padded, index + k, axis=0) for k in range(4))
    w0, w1, w2 = (w.astype(rows.dtype)[..., None] for w in _weights(edges, pixel, t))
    means = value + w0 * (value - before) + w1 * (after - value) + w2 * (second - after)
    wide = np.nonzero(np.diff(pixel, axis=1) > 1)
    if len(wide[0]):
        means[wide] = _wide_means(rows, edges, pixel, t, wide)
    return np.asarray(means)


def _weights(edges: FloatArray, pixel: IndexArray, t: FloatArray) -> tuple[FloatArray, ...]:
    """Weights of D[i], D[i + 1], D[i + 2] for preimages from pixel i to at most pixel i + 1."""
    s = 1.0 - t
    a, b = 0.5 * t * s * s, 0.5 * t * t * s
    t0, s0, a0, b0 = t[:, :-1], s[:, :-1], a[:, :-1], b[:, :-1]
    t1, a1, b1 = t[:, 1:], a[:, 1:], b[:, 1:]
    same = pixel[:, 1:] == pixel[:, :-1]
    width = np.diff(edges, axis=1)
    inverse = 1.0 / np.maximum(width, THIN)
    thin = width < THIN
    w0 = np.where(same, a0 - a1, a0) * inverse
    w1 = np.where(same, b0 - b1, b0 + t1 - a1) * inverse
    w2 = np.where(same | thin, 0.0, -b1 * inverse)
    w0 = np.where(thin, -0.5 * s0 * (1.0 - 3.0 * t0), w0)
    w1 = np.where(thin, -0.5 * t0 * (2.0 - 3.0 * t0), w1)
    return w0, w1, w2


def _wide_means(
    rows: NDArray[Any],
    edges: FloatArray,
    pixel: IndexArray,
    t: FloatArray,
    wide: tuple[IndexArray, ...],
) -> FloatArray:
    """Means over preimages that contain whole pixels: (m, channels), from sums along the row."""
    row, left = wide
    right = left + 1
    # Relative to the row's first pixel, so that a constant row sums to exactly nothing.
    padded = np.pad(rows.astype(float), ((0, 0), (1, 1), (0, 0)), mode="edge")
    relative = padded - padded[:, :1]
    sums = np.cumsum(relative, axis=1)

    def partial(edge: IndexArray) -> FloatArray:
        """Integral from the edge of its pixel, and from the row's start: (m, channels)."""
        i, x = pixel[row, edge] + 1, t[row, edge][:, None]
        f = relative[row, i]
        curve = (1.0 - x) * (f - relative[row, i - 1]) + x * (relative[row, i + 1] - f)
        return np.asarray(sums[row, i - 1] + f * x - 0.5 * x * (1.0 - x) * curve)

    width = (edges[row, right] - edges[row, left])[:, None]
    return np.asarray(padded[row, 0] + (partial(right) - partial(left)) / width)
