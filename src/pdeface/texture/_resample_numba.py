# mypy: allow-untyped-defs
# (numba finds the types of compiled functions by itself)
"""Both passes of the mesh warp compiled by numba: as ``_resample_numpy``, ten times faster.

Serial on purpose: numba's threading layers stall on small work, and a caller may run many warps
side by side. Compiled code is kept on disk. The target image is made in strips of columns, so
that what lies between the passes stays in the cache; a few lines are worked on together, so that
turning rows into columns fills whole cache lines. Positions are computed in double precision,
pixels in single. Indices are unsigned, which spares numba's test for negative ones, and the
channels come as a tuple of their number, which makes every loop over them one of known length.
"""

from __future__ import annotations

from typing import Any

import numba
import numpy as np
from numpy.typing import NDArray

from pdeface.texture import _spline
from pdeface.texture._resample_numpy import SNAP, THIN

__all__ = ["two_pass"]

FloatArray = NDArray[np.float64]

_SNAP, _THIN = SNAP, THIN
_STRIP = 64


def two_pass(
    image: NDArray[Any],
    horizontal: tuple[FloatArray, FloatArray],
    vertical: tuple[FloatArray, FloatArray],
    shape: tuple[int, int],
) -> NDArray[Any]:
    """As :func:`pdeface.texture._resample_numpy.two_pass`."""
    rows, length, channels = image.shape
    whole = image.dtype.kind == "u"
    result = np.empty((*shape, channels), image.dtype)
    _two_pass(
        np.ascontiguousarray(image).reshape(rows, length * channels),
        (1,) * channels,
        np.ascontiguousarray(horizontal[0]),
        _spline.coefficients(*horizontal),
        np.ascontiguousarray(vertical[0]),
        _spline.coefficients(*vertical),
        float(np.iinfo(image.dtype).max) if whole else 0.0,
        np.empty(0, np.float64 if image.dtype == np.float64 else np.float32),
        result.reshape(shape[0], shape[1] * channels),
    )
    return result


def _jit(function: Any) -> Any:
    """Compile ``function``, keeping the machine code on disk where there is a place for it."""
    options: dict[str, Any] = {"error_model": "numpy", "fastmath": {"contract"}}
    try:
        return numba.njit(cache=True, **options)(function)
    except RuntimeError:  # no folder that can be written to
        return numba.njit(**options)(function)


@_jit
def _fill_line(row, first, last, channels, line, steps):
    """Pixels ``first - 1`` to ``last + 2`` of a row, and their differences.

    Beyond its ends the row repeats its last pixels. ``line`` begins at pixel ``first - 1``.
    """
    c, length = len(channels), row.size // len(channels)
    low, high = max(first - 1, 0), min(last + 3, length)
    shift = (low - first + 1) * c
    for k in range((high - low) * c):
        line[shift + k] = row[low * c + k]
    if low == first:
        for k in range(c):
            line[k] = line[c + k]
    end = shift + (high - low) * c
    size = (last - first + 4) * c
    for k in range(end, size):
        line[k] = line[k - c]
    for k in range(size - c):
        steps[k] = line[k + c] - line[k]


@_jit
def _fill_edges(to, polynomials, start, length, edges):
    """Preimages of the output pixels' edges from ``start``: ``edge_map`` of one row."""
    k = 0
    for piece in range(polynomials.shape[0]):
        end = edges.size
        if piece < to.size:
            end = max(k, int(min(max(np.ceil(to[piece]) - start, 0.0), float(end))))
        origin = to[max(piece - 1, 0)] - start
        c0, c1, c2, c3 = polynomials[piece]
        for j in range(k, end):
            d = j - origin
            x = ((c3 * d + c2) * d + c1) * d + c0
            nearest = np.rint(x)
            x = nearest if abs(x - nearest) < _SNAP else x
            edges[j] = min(max(x, 0.0), float(length))
        k = end


@_jit
def _fill_weights(edges, length, pixel, t, w0, w1, w2):
    """Pixel and place within it of every edge; weights as in ``_resample_numpy._weights``."""
    last = np.uint32(length - 1)
    for k in range(edges.size):
        pixel[k] = min(np.uint32(edges[k]), last)
        t[k] = edges[k] - pixel[k]
    for k in range(edges.size - 1):
        t0, t1 = t[k], t[k + 1]
        s0, s1 = 1.0 - t0, 1.0 - t1
        a0, b0 = 0.5 * t0 * s0 * s0, 0.5 * t0 * t0 * s0
        a1, b1 = 0.5 * t1 * s1 * s1, 0.5 * t1 * t1 * s1
        width = edges[k + 1] - edges[k]
        inverse = 1.0 / max(width, _THIN)
        same, thin = pixel[k] == pixel[k + 1], width < _THIN
        x0 = (a0 - a1 if same else a0) * inverse
        x1 = (b0 - b1 if same else b0 + t1 - a1) * inverse
        x2 = (0.0 if same else -b1) * inverse
        w0[k] = -0.5 * s0 * (1.0 - 3.0 * t0) if thin else x0
        w1[k] = -0.5 * t0 * (2.0 - 3.0 * t0) if thin else x1
        w2[k] = 0.0 if thin else x2


@_jit
def _fill_means(line, steps, edges, pixel, t, w0, w1, w2, channels, out):
    """Mean of the row's curve over every preimage; ``line`` begins one pixel early."""
    step = np.uint64(len(channels))
    for j in range(w0.size):
        k = np.uint64(j)
        first = np.uint64(pixel[k] - pixel[0])
        beyond = np.uint64(pixel[k + np.uint64(1)] - pixel[k])
        if beyond < np.uint64(2):
            for c in range(len(channels)):
                at = first * step + np.uint64(c)
                out[k * step + np.uint64(c)] = (
                    line[at + step]
                    + w0[k] * steps[at]
                    + w1[k] * steps[at + step]
                    + w2[k] * steps[at + step + step]
                )
        else:
            _wide_mean(line, edges, pixel, t, j, channels, out)


@_jit
def _wide_mean(line, edges, pixel, t, k, channels, out):
    """Mean over output pixel ``k``'s preimage, which contains whole pixels."""
    step, t0, t1 = len(channels), t[k], t[k + 1]
    a0, b0 = 0.5 * t0 * (1.0 - t0) ** 2, 0.5 * t0 * t0 * (1.0 - t0)
    a1, b1 = 0.5 * t1 * (1.0 - t1) ** 2, 0.5 * t1 * t1 * (1.0 - t1)
    i = (np.int64(pixel[k]) - np.int64(pixel[0]) + 1) * step
    j = (np.int64(pixel[k + 1]) - np.int64(pixel[0]) + 1) * step
    for c in range(step):
        f0, f1 = line[i + c], line[j + c]
        total = 0.0
        for m in range(i + c + step, j + c, step):
            total += line[m] - f0
        total += a0 * (f0 - line[i + c - step]) + b0 * (line[i + c + step] - f0)
        total += (f1 - f0) * t1
        total -= a1 * (f1 - line[j + c - step]) + b1 * (line[j + c + step] - f1)
        out[k * step + c] = f0 + total / (edges[k + 1] - edges[k])


@_jit
def _store(values, top, out):
    """Values as the type of ``out``: rounded and clipped to ``top`` where that is positive."""
    if top > 0.0:
        limit = values.dtype.type(top)
        zero = values.dtype.type(0.0)
        for k in range(values.size):
            out[k] = min(max(np.rint(values[k]), zero), limit)
    else:
        for k in range(values.size):
            out[k] = values[k]


@_jit
def _transpose(bundle, size, channels, first, result):
    """Lines of the bundle to columns ``first``, ``first + 1``, ... of the result."""
    step = np.uint64(len(channels))
    for j in range(result.shape[0]):
        k = np.uint64(j)
        for i in range(size):
            b = np.uint64(i)
            for c in range(len(channels)):
                result[k, (np.uint64(first) + b) * step + np.uint64(c)] = bundle[
                    b, k * step + np.uint64(c)
                ]


@_jit
def _pass(image, channels, to, polynomials, start, top, work, bundle, result):
    """Resample every row of ``image`` from output pixel ``start`` on, into columns of ``result``."""
    width, length = result.shape[0], image.shape[1] // len(channels)
    edges, t, pixel = np.empty(width + 1), np.empty(width + 1), np.empty(width + 1, np.uint32)
    w0, w1, w2 = (
        np.empty(width, work.dtype),
        np.empty(width, work.dtype),
        np.empty(width, work.dtype),
    )
    values = np.empty(width * len(channels), work.dtype)
    line = np.empty((length + 3) * len(channels), work.dtype)
    steps = np.empty_like(line)
    for first in range(0, image.shape[0], bundle.shape[0]):
        size = min(bundle.shape[0], image.shape[0] - first)
        for b in range(size):
            row = first + b
            _fill_edges(to[row], polynomials[row], start, length, edges)
            _fill_weights(edges, length, pixel, t, w0, w1, w2)
            low, high = np.int64(pixel[0]), np.int64(pixel[width])
            _fill_line(image[row], low, high, channels, line, steps)
            _fill_means(line, steps, edges, pixel, t, w0, w1, w2, channels, values)
            _store(values, top, bundle[b])
        _transpose(bundle, size, channels, first, result)


@_jit
def _two_pass(image, channels, to_x, from_x, to_y, from_y, top, work, result):
    """Both passes, a strip of columns at a time; see :func:`two_pass`."""
    step, height, width = len(channels), result.shape[0], result.shape[1] // len(channels)
    between = np.empty((_STRIP, image.shape[0] * step), work.dtype)
    columns = np.empty((32 // result.itemsize, height * step), result.dtype)
    rows = np.empty((8, _STRIP * step), work.dtype)
    for start in range(0, width, _STRIP):
        size = min(_STRIP, width - start)
        end = start + size
        strip = between[:size]
        _pass(image, channels, to_x, from_x, start, 0.0, work, rows, strip)
        part = result[:, start * step : end * step]
        _pass(strip, channels, to_y[start:end], from_y[start:end], 0, top, work, columns, part)
