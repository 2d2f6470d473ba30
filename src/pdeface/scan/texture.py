"""A scan's colours on the uv mesh."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from pdeface.pde import GridEvaluator
from pdeface.scan.fitting import ScanFit
from pdeface.scan.nearest import Target, flat
from pdeface.scan.pictures_of import colours_at

__all__ = ["texture_of"]

FloatArray = NDArray[np.float64]
Pixels = NDArray[np.uint8]

SIZE = 1024
"""Texels along either side of a texture."""

_CHUNK = 128
_SEEN = 3.0e-3
_ALIKE = 0.3
"""Metres, and cosine of the angle between normals, from which on a place of the scan says nothing
of a texel."""


def texture_of(fit: ScanFit, size: int = SIZE) -> Pixels | None:
    """(size, size, 3) texture of the face, or None if the scan has no colours.

    Every texel takes the colour of the place of the scan that is nearest to its place on the face;
    where the scan has a hole the colours around it are carried on.
    """
    if not fit.scan.has_colors:
        return None
    target = Target(fit.scan)
    curves = fit.at_level(109, 184).face.curves
    middle = (np.arange(size) + 0.5) / size
    image, known = np.zeros((size, size, 3)), np.zeros((size, size), bool)
    for start in range(0, size, _CHUNK):
        rows = slice(start, start + _CHUNK)
        grid = GridEvaluator(curves.shape, middle[rows], np.pi * middle)
        points, normals = grid.positions_and_normals(curves.points)
        found = target.nearest(flat(points))
        alike = (found.normals * flat(normals)).sum(axis=1)
        shape = points.shape[:2]
        colors = colours_at(fit.scan, found.corners, found.weights)
        image[rows] = colors.reshape(*shape, 3)
        known[rows] = ((found.away < _SEEN) & (alike > _ALIKE)).reshape(shape)
    return np.rint(_filled(image, known)).clip(0, 255).astype(np.uint8)


def _filled(image: FloatArray, known: NDArray[np.bool_]) -> FloatArray:
    """The image with what is unknown taken from ever smaller pictures of what is known."""
    if known.all() or not known.any():
        return image
    weight = known[..., None].astype(np.float64)
    half_image, half_weight = _halved(image * weight), _halved(weight)
    half = half_image / np.maximum(half_weight, 1e-12)
    if min(half.shape[:2]) > 1:
        half = _filled(half, half_weight[..., 0] > 0.0)
    wide = np.repeat(np.repeat(half, 2, axis=0), 2, axis=1)[: image.shape[0], : image.shape[1]]
    return np.where(known[..., None], image, wide)


def _halved(image: FloatArray) -> FloatArray:
    rows, columns = image.shape[0] % 2, image.shape[1] % 2
    even = np.pad(image, ((0, rows), (0, columns), (0, 0)))
    return even.reshape(even.shape[0] // 2, 2, even.shape[1] // 2, 2, -1).sum(axis=(1, 3))
