# mypy: allow-untyped-defs
# (numba finds the types of compiled functions by itself)
"""Both passes of the mesh warp compiled by numba: as ``_resample_numpy``, ten times faster.

Serial on purpose: numba's threading layers stall on small work, and a caller may run many warps
side by side. Compiled code is kept on disk. A few rows are worked on together, so that writing
them as columns fills whole cache lines. Positions are computed in double precision, pixels in
single. Indices are unsigned, which spares numba's test for negative ones, and the channels come
as a tuple of their number, which makes every loop over them one of known length.
"""

from __future__ import annotations

from typing import Any

import numba
import numpy as np
from numpy.typing import NDArray

from pdeface.texture._resample_numpy import SNAP, THIN, LineMaps

__all__ = ["two_pass"]

_SNAP, _THIN = SNAP, THIN
_BUNDLE_BYTES = 32
"""What one output line gets at a time."""


def two_pass(
    image: NDArray[Any], horizontal: LineMaps, vertical: LineMaps, shape: tuple[int, int]
) -> NDArray[Any]:
    """As :func:`pdeface.texture._resample_numpy.two_pass`."""
    work = np.dtype(np.float64 if image.dtype == np.float64 else np.float32)
    between = _resample(image, horizontal, shape[1], work)
    return _resample(between, vertical, shape[0], image.dtype)


def _resample(
    image: NDArray[Any], maps: LineMaps, width: int, dtype: np.dtype[Any]
) -> NDArray[Any]:
    """Every row of ``image``, resampled to ``width`` pixels; rows become columns."""
    count, length, channels = image.shape
    work = np.float64 if image.dtype == np.float64 else np.float32
    result = np.empty((width, count, channels), dtype)
    _rows(
        np.ascontiguousarray(image).reshape(count, length * channels),
        np.ascontiguousarray(maps[0]),
        np.ascontiguousarray(maps[1]),
        (1,) * channels,
        np.empty((length + 3) * channels, work),
        np.empty(width * channels, work),
        float(np.iinfo(dtype).max) if dtype.kind == "u" else 0.0,
        np.empty((max(1, _BUNDLE_BYTES // dtype.itemsize), width * channels), dtype),
        result.reshape(width, count * channels),
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
def _fill_line(row, channels, line, steps):
    """A source row, its first pixel repeated once before it and its last twice behind."""
    c, size = len(channels), row.size
    for k in range(size):
        line[c + k] = row[k]
    for k in range(c):
        line[k] = row[k]
        line[c + size + k] = line[2 * c + size + k] = row[size - c + k]
    for k in range(size + 2 * c):
        steps[k] = line[k + c] - line[k]


@_jit
def _fill_edges(to, polynomials, length, edges):
    """Preimages of the output pixels' edges: ``_resample_numpy.edge_map`` of one row."""
    k = 0
    for piece in range(polynomials.shape[0]):
        end = edges.size
        if piece < to.size:
            end = max(k, int(min(max(np.ceil(to[piece]), 0.0), float(end))))
        origin = to[max(piece - 1, 0)]
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
    last = float(length - 1)
    for k in range(edges.size):
        whole = min(np.floor(edges[k]), last)
        pixel[k] = np.uint32(whole)
        t[k] = edges[k] - whole
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
    """Mean of the row's curve over every preimage."""
    step = np.uint64(len(channels))
    for j in range(w0.size):
        k = np.uint64(j)
        first = np.uint64(pixel[k])
        beyond = np.uint64(pixel[k + np.uint64(1)]) - first
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
    i = (np.int64(pixel[k]) + 1) * step
    j = (np.int64(pixel[k + 1]) + 1) * step
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
    """Rows of the bundle to columns ``first``, ``first + 1``, ... of the result."""
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
def _rows(image, to, polynomials, channels, line, values, top, bundle, result):
    """The pass: see :func:`_resample`; ``line`` and ``values`` are room to work in."""
    width, length = result.shape[0], image.shape[1] // len(channels)
    edges, t = np.empty(width + 1), np.empty(width + 1)
    pixel = np.empty(width + 1, np.uint32)
    steps = np.empty(line.size - len(channels), line.dtype)
    w0, w1 = np.empty(width, line.dtype), np.empty(width, line.dtype)
    w2 = np.empty(width, line.dtype)
    for first in range(0, image.shape[0], bundle.shape[0]):
        size = min(bundle.shape[0], image.shape[0] - first)
        for b in range(size):
            row = first + b
            _fill_line(image[row], channels, line, steps)
            _fill_edges(to[row], polynomials[row], length, edges)
            _fill_weights(edges, length, pixel, t, w0, w1, w2)
            _fill_means(line, steps, edges, pixel, t, w0, w1, w2, channels, values)
            _store(values, top, bundle[b])
        _transpose(bundle, size, channels, first, result)
