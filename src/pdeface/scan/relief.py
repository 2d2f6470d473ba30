"""What the curves of a fit leave out of its scan, as a relief."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from pdeface.pde import GridEvaluator
from pdeface.relief import Relief
from pdeface.scan.fitting import ScanFit
from pdeface.scan.laying import met
from pdeface.scan.nearest import Target, flat

__all__ = ["relief_of"]

FloatArray = NDArray[np.float64]

SIZE = 512
"""Texels along either side of a relief: half a millimetre of the face."""

_CUTOFF, _ROUNDS, _CHUNK = 4.0e-3, 3, 128
_BREADTH = 2.0e-3
_ROUND = 0.5
"""Share of the way to the vertices' tangent planes: facets of a scan are no relief."""

_DETAIL, _FACE = 0.25, 0.2
"""Share of a scan's spacing below which heights follow its triangles, not its shape; and metres
that a relief is wide and high."""


def relief_of(fit: ScanFit, size: int = SIZE) -> Relief:
    """Heights of the scan over the fit, along the normals of its surface.

    Each texel goes to the nearest place of the scan that faces the same way, and goes on from there
    along its normal. Towards places that are far or face elsewhere, and over holes, heights fall
    to 0. Nothing is finer than a quarter of the scan's own triangles.

    Args:
        size: texels along either side.
    """
    from scipy.ndimage import gaussian_filter

    target = Target(fit.scan, _BREADTH)
    curves = fit.face.curves
    middle = (np.arange(size) + 0.5) / size
    heights = np.zeros((size, size))
    for start in range(0, size, _CHUNK):
        rows = slice(start, start + _CHUNK)
        grid = GridEvaluator(curves.shape, middle[rows], np.pi * middle)
        points, normals = (flat(of) for of in grid.positions_and_normals(curves.points))
        heights[rows] = _heights(target, points, normals).reshape(-1, size)
    width = _DETAIL * fit.scan.spacing / _FACE * size
    return Relief(gaussian_filter(heights, width, mode="nearest"))


def _heights(target: Target, points: FloatArray, normals: FloatArray) -> FloatArray:
    """(n,) metres along normals to the scan."""
    height = np.zeros(len(points))
    for _ in range(_ROUNDS):
        found = target.nearest(points + height[:, None] * normals, normals)
        off = found.bent(target.scan, _ROUND) - points
        alike = (found.normals * normals).sum(axis=1)
        trust = met(np.linalg.norm(off, axis=1), alike, _CUTOFF)
        height = trust * (off * normals).sum(axis=1)
    return height
