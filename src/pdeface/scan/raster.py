"""What of a scan is seen from one side: a depth buffer in parallel projection, numpy alone."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from pdeface.scan.surface import Scan

__all__ = ["Seen", "look"]

FloatArray = NDArray[np.float64]
IndexArray = NDArray[np.int64]
_Part = tuple[IndexArray, IndexArray, FloatArray, FloatArray]

CHUNK = 2_000_000
SPLAT = 1.7
"""Width of a point of a cloud, in distances to its neighbours: no light shines through."""


@dataclass(frozen=True, eq=False)
class Seen:
    """A view of a scan.

    Attributes:
        item: (H, W) triangle, or point of a cloud, seen in each pixel; -1 for none.
        depth: (H, W) towards the viewer; -inf for none.
        weights: (H, W, 3) barycentric coordinates in the triangle; (1, 0, 0) for points.
        pixels: (V, 3) x, y in pixels, and depth, of every vertex.
    """

    item: IndexArray
    depth: FloatArray
    weights: FloatArray
    pixels: FloatArray

    def corners(self, scan: Scan) -> IndexArray:
        """(P, 3) vertices in the pixels that see something."""
        item = self.item[self.item >= 0]
        return np.repeat(item[:, None], 3, axis=1) if scan.is_cloud else scan.triangles[item]

    def spread(self, scan: Scan, values: FloatArray) -> FloatArray:
        """(H, W, n) of (V, n) values at the vertices; 0 where nothing is seen."""
        seen = self.item >= 0
        image = np.zeros((*self.item.shape, values.shape[1]))
        image[seen] = np.einsum("pc,pcn->pn", self.weights[seen], values[self.corners(scan)])
        return image


def look(
    scan: Scan, axes: FloatArray, centre: FloatArray, width: float, size: tuple[int, int]
) -> Seen:
    """See a scan along the third of three axes.

    Args:
        axes: (3, 3) rows: right, up and towards the viewer, unit vectors.
        centre: (3,) what is in the middle of the picture.
        width: of the picture, in the scan's unit.
        size: (width, height) in pixels.
    """
    columns, rows = size
    seen = (scan.vertices - centre) @ axes.T
    scale = columns / width
    pixels = np.stack(
        [0.5 * columns + scale * seen[:, 0], 0.5 * rows - scale * seen[:, 1], scale * seen[:, 2]],
        axis=1,
    )
    best = np.full(rows * columns, -np.inf)
    item = np.full(rows * columns, -1, np.int64)
    weights = np.zeros((rows * columns, 3))
    parts = _points if scan.is_cloud else _triangles
    for who, at, depth, barycentric in parts(scan, pixels, scale, size):
        np.maximum.at(best, at, depth)
        won = depth >= best[at]
        item[at[won]], weights[at[won]] = who[won], barycentric[won]
    shape = (rows, columns)
    depth = best.reshape(shape) / scale
    pixels[:, 2] /= scale
    return Seen(item.reshape(shape), depth, weights.reshape(*shape, 3), pixels)


def _triangles(
    scan: Scan, pixels: FloatArray, scale: float, size: tuple[int, int]
) -> Iterator[_Part]:
    """Chunks of (triangle, pixel, depth, weights) of pixels within triangles, either way round."""
    columns, rows = size
    # An axis at a time: numpy's reductions over three corners are many times slower.
    sides = scan.triangles.T
    (left, width), (top, height) = (
        _span(pixels[:, axis], sides, most) for axis, most in ((0, columns), (1, rows))
    )
    drawn = np.flatnonzero((width > 0) & (height > 0))
    left, top, width, height = left[drawn], top[drawn], width[drawn], height[drawn]
    corner = pixels[scan.triangles[drawn]]
    one, two = corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0]
    area = one[:, 0] * two[:, 1] - one[:, 1] * two[:, 0]
    count = np.where(area != 0.0, width * height, 0)
    for group in _groups(count):
        part = np.arange(len(count))[group]
        each = np.repeat(part, count[part])
        step = np.arange(len(each)) - np.repeat(np.cumsum(count[part]) - count[part], count[part])
        x, y = left[each] + step % width[each], top[each] + step // width[each]
        dx, dy = x + 0.5 - corner[each, 0, 0], y + 0.5 - corner[each, 0, 1]
        b = (dx * two[each, 1] - dy * two[each, 0]) / area[each]
        c = (one[each, 0] * dy - one[each, 1] * dx) / area[each]
        inside = (b >= -1e-9) & (c >= -1e-9) & (b + c <= 1.0 + 1e-9)
        each, b, c = each[inside], b[inside], c[inside]
        depth = corner[each, 0, 2] + b * one[each, 2] + c * two[each, 2]
        at = (y * columns + x)[inside]
        yield drawn[each], at, depth, np.stack([1.0 - b - c, b, c], axis=1)


def _span(place: FloatArray, sides: IndexArray, most: int) -> tuple[IndexArray, IndexArray]:
    """First pixel whose middle is within each triangle along one axis, and how many there are."""
    a, b, c = (np.ascontiguousarray(place)[corner] for corner in sides)
    low = np.maximum(np.ceil(np.minimum(np.minimum(a, b), c) - 0.5), 0.0)
    high = np.minimum(np.floor(np.maximum(np.maximum(a, b), c) - 0.5), most - 1.0)
    return low.astype(np.int64), np.maximum(high - low + 1.0, 0.0).astype(np.int64)


def _points(scan: Scan, pixels: FloatArray, scale: float, size: tuple[int, int]) -> Iterator[_Part]:
    """Chunks of (point, pixel, depth, weights) of squares about points."""
    columns, rows = size
    reach = int(np.ceil(0.5 * (SPLAT * scan.spacing * scale - 1.0)))
    reach = min(max(reach, 0), 12)
    x, y = np.floor(pixels[:, 0]).astype(np.int64), np.floor(pixels[:, 1]).astype(np.int64)
    for dy in range(-reach, reach + 1):
        for dx in range(-reach, reach + 1):
            inside = (x + dx >= 0) & (x + dx < columns) & (y + dy >= 0) & (y + dy < rows)
            who = np.flatnonzero(inside)
            weights = np.zeros((len(who), 3))
            weights[:, 0] = 1.0
            # The middle of a splat lies in front of its rim.
            depth = pixels[who, 2] - 0.05 * (dx * dx + dy * dy)
            yield who, (y[who] + dy) * columns + x[who] + dx, depth, weights


def _groups(count: IndexArray) -> Iterator[slice]:
    """Runs of triangles of about CHUNK candidates each."""
    total = np.cumsum(count)
    if not len(total):
        return
    cuts = np.searchsorted(total, np.arange(CHUNK, int(total[-1]), CHUNK)) + 1
    edges = np.unique(np.concatenate([[0], cuts, [len(count)]])).tolist()
    for start, stop in pairwise(edges):
        yield slice(start, stop)
