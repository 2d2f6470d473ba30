"""The frontal bone: the forehead (the first four curves) and the brow ridge."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from pdeface.controls.shape.fields import ShapeField, both_sides, move, stretch
from pdeface.controls.shape.sites import MM, Sites, landmark
from pdeface.controls.shape.windows import dome, fall, rise

__all__ = ["FRONTAL"]

FloatArray = NDArray[np.float64]


def _protrusion(sites: Sites) -> FloatArray:
    brow = landmark("brow")[1]
    window = rise(sites.y, brow - 6 * MM, brow + 60 * MM) * fall(sites.aside, 26 * MM, 76 * MM)
    return move(window * rise(sites.depth, 0.0, 50 * MM), (0.0, 0.0, 11.5 * MM))


def _height(sites: Sites) -> FloatArray:
    # By rows: the hairline is lower at the temples than in the middle, and moves as one.
    return move(rise(sites.rows, 3.6, -1.5), (0.0, 16 * MM, 0.0))


def _width(sites: Sites) -> FloatArray:
    brow = landmark("brow")
    return stretch(rise(sites.y, brow[1] - 32 * MM, brow[1] + 32 * MM), sites, brow, (0.11, 0, 0))


def _brow_ridge(sites: Sites) -> FloatArray:
    brow = (25 * MM, landmark("brow")[1] + 4 * MM, 0.0)
    window = dome(sites.points, brow, (37 * MM, 23 * MM, np.inf))
    return move(window, (0.0, -0.5 * MM, 6 * MM))


FRONTAL = (
    ShapeField("foreheadProtrusion", "forehead bulges forward; at -1 it slopes back", _protrusion),
    ShapeField("foreheadHeight", "high forehead", _height),
    ShapeField("foreheadWidth", "wide forehead and temples", _width),
    ShapeField("browRidge", "heavy brow ridge", both_sides(_brow_ridge)),
)
