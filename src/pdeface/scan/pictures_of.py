"""Pictures of a scan to look for a face in: its own colours, or clay."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from pdeface.scan.raster import Seen
from pdeface.scan.surface import Scan

__all__ = ["clay", "colours_at", "own_colours"]

FloatArray = NDArray[np.float64]
Pixels = NDArray[np.uint8]

_GROUND = 150
_SKIN = np.array([214.0, 172.0, 146.0])
_LAMP = np.array([-0.25, 0.45, 0.86])
_AMBIENT = 0.3


def clay(scan: Scan, seen: Seen, axes: FloatArray) -> Pixels:
    """(H, W, 3) picture in skin-coloured clay; both sides of the surface are lit."""
    normals = seen.spread(scan, scan.normals) @ axes.T
    length = np.linalg.norm(normals, axis=2)
    normals /= np.where(length > 0.0, length, 1.0)[..., None]
    normals *= np.where(normals[..., 2:] < 0.0, -1.0, 1.0)
    light = _AMBIENT + (1.0 - _AMBIENT) * np.clip(normals @ (_LAMP / np.linalg.norm(_LAMP)), 0, 1)
    picture = np.full((*seen.item.shape, 3), float(_GROUND))
    inside = seen.item >= 0
    picture[inside] = light[inside, None] * _SKIN
    return picture.astype(np.uint8)


def own_colours(scan: Scan, seen: Seen) -> Pixels:
    """(H, W, 3) picture in the colours of the scan, lit as they are."""
    picture = np.full((*seen.item.shape, 3), _GROUND, np.uint8)
    inside = seen.item >= 0
    picture[inside] = colours_at(scan, seen.corners(scan), seen.weights[inside])
    return picture


def colours_at(scan: Scan, corners: NDArray[np.int64], weights: FloatArray) -> Pixels:
    """(P, 3) colours of places on triangles.

    Args:
        corners: (P, 3) vertices.
        weights: (P, 3) of each of them.
    """
    if scan.image is None or scan.texcoords is None:
        assert scan.colors is not None
        mixed = np.einsum("pc,pcn->pn", weights, scan.colors[corners].astype(np.float64))
        return np.rint(mixed).astype(np.uint8)
    at = np.einsum("pc,pcn->pn", weights, scan.texcoords[corners])
    return _bilinear(scan.image, at)


def _bilinear(image: Pixels, at: FloatArray) -> Pixels:
    rows, columns = image.shape[:2]
    place = np.where(np.isfinite(at), at, 0.0)
    place = (place - np.floor(place)) * (columns, rows) - 0.5  # textures repeat
    place = place.clip(0.0, (columns - 1, rows - 1))
    first = np.minimum(place.astype(np.int64), np.maximum((columns - 2, rows - 2), 0))
    (j, i), (f, g) = first.T, (place - first).T[..., None]
    right, below = np.minimum(j + 1, columns - 1), np.minimum(i + 1, rows - 1)
    upper = image[i, j] * (1.0 - f) + image[i, right] * f
    lower = image[below, j] * (1.0 - f) + image[below, right] * f
    return np.rint(upper * (1.0 - g) + lower * g).astype(np.uint8)
