"""Triangles to pixels with numpy alone: what draws where there is no OpenGL.

Every triangle's bounding box is laid out as one long list of candidate pixels; the nearest
candidate inside its triangle wins the pixel. Slower than a graphics library, and needs none.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from pdeface.pictures.camera import Camera
from pdeface.pictures.solid import Solid

__all__ = ["draw"]

FloatArray = NDArray[np.float64]
IndexArray = NDArray[np.int64]

CHUNK = 2_000_000
"""Candidate pixels worked on at once: some 200 MB."""

NEAR = 1e-3
"""Metres in front of the camera from which on triangles are drawn."""


def draw(solids: Sequence[Solid], camera: Camera, size: tuple[int, int]) -> NDArray[np.uint8]:
    """(H, W, 4) premultiplied red, green, blue and coverage, 0 to 255, without anti-aliasing."""
    width, height = size
    image = np.zeros((height * width, 4), np.uint8)
    depth = np.full(height * width, np.inf)
    for solid in solids:
        xy, z = camera.project(solid.vertices, size)
        inverse = 1.0 / z
        for part, pixel, weights in _candidates(xy, z, solid.triangles, size):
            corners = solid.triangles[part]
            near = 1.0 / np.einsum("pc,pc->p", weights, inverse[corners])
            np.minimum.at(depth, pixel, near)
            won = near <= depth[pixel]
            corners, pixel, weights = corners[won], pixel[won], weights[won]
            weights = weights * inverse[corners] * near[won][:, None]
            image[pixel, :3] = np.round(255.0 * _colors(solid, corners, weights))
            image[pixel, 3] = 255
    return image.reshape(height, width, 4)


def _candidates(
    xy: FloatArray, z: FloatArray, triangles: NDArray[np.int32], size: tuple[int, int]
) -> Iterator[tuple[IndexArray, IndexArray, FloatArray]]:
    """(triangle, pixel, barycentric weights) of all pixels inside front-facing triangles."""
    width, height = size
    corner = xy[triangles]
    low = np.maximum(np.ceil(corner.min(axis=1) - 0.5), 0.0).astype(np.int64)
    high = np.minimum(np.floor(corner.max(axis=1) - 0.5), [width - 1, height - 1]).astype(np.int64)
    span = np.maximum(high - low + 1, 0)
    edge1, edge2 = corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0]
    area = edge1[:, 0] * edge2[:, 1] - edge1[:, 1] * edge2[:, 0]
    # y points down in the picture, so what is anticlockwise in space has a negative area.
    front = (area < 0.0) & (z[triangles].min(axis=1) > NEAR)
    count = np.where(front, span[:, 0] * span[:, 1], 0)
    drawn = np.flatnonzero(count)
    for group in _groups(count[drawn]):
        part = drawn[group]
        each = np.repeat(part, count[part])
        step = np.arange(len(each)) - np.repeat(np.cumsum(count[part]) - count[part], count[part])
        x = low[each, 0] + step % span[each, 0]
        y = low[each, 1] + step // span[each, 0]
        dx, dy = x + 0.5 - corner[each, 0, 0], y + 0.5 - corner[each, 0, 1]
        b = (dx * edge2[each, 1] - dy * edge2[each, 0]) / area[each]
        c = (edge1[each, 0] * dy - edge1[each, 1] * dx) / area[each]
        # A hair of tolerance: a pixel on a shared edge must not fall between two triangles.
        inside = (b >= -1e-9) & (c >= -1e-9) & (b + c <= 1.0 + 1e-9)
        b, c = b[inside], c[inside]
        yield each[inside], (y * width + x)[inside], np.stack([1.0 - b - c, b, c], axis=1)


def _groups(count: IndexArray) -> Iterator[slice]:
    """Runs of triangles of about CHUNK candidates each."""
    if len(count) == 0:
        return
    total = np.cumsum(count)
    cuts = np.searchsorted(total, np.arange(CHUNK, int(total[-1]), CHUNK)) + 1
    edges = np.unique(np.concatenate([[0], cuts, [len(count)]]))
    for start, stop in pairwise(edges):
        yield slice(int(start), int(stop))


def _colors(solid: Solid, corners: NDArray[np.int32], weights: FloatArray) -> FloatArray:
    """(P, 3) interpolated colours, times the texture if there is one."""
    color: FloatArray = np.einsum("pc,pck->pk", weights, solid.colors[corners])
    if solid.texture is None or solid.texcoords is None:
        return color
    at = np.einsum("pc,pck->pk", weights, solid.texcoords[corners])
    return color * _sample(solid.texture, at)


def _sample(texture: NDArray[np.uint8], at: FloatArray) -> FloatArray:
    """(P, 3) bilinear samples, 0 to 1; texel [i, j] has its centre at (j + 1/2, i + 1/2)."""
    rows, columns = texture.shape[:2]
    place = at * [columns, rows] - 0.5
    place = np.clip(place, 0.0, [columns - 1, rows - 1])
    first = np.minimum(place.astype(np.int64), np.maximum([columns - 2, rows - 2], 0))
    f, g = (place - first).T[:, :, None]
    j, i = first.T
    right, below = np.minimum(j + 1, columns - 1), np.minimum(i + 1, rows - 1)
    upper = texture[i, j] * (1.0 - f) + texture[i, right] * f
    lower = texture[below, j] * (1.0 - f) + texture[below, right] * f
    return np.asarray((upper * (1.0 - g) + lower * g) / 255.0)
