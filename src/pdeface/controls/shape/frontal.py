"""The frontal bone: the forehead (the first four curves) and the brow ridge."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from pdeface.controls.shape.fields import ShapeField, move, stretch
from pdeface.controls.shape.sites import MM, Sites, landmark
from pdeface.controls.shape.windows import fall, hill, rise

__all__ = ["FRONTAL"]

FloatArray = NDArray[np.float64]


def _protrusion(sites: Sites) -> FloatArray:
    brow = landmark("brow")[1]
    window = rise(sites.y, brow + 2 * MM, brow + 32 * MM) * fall(sites.aside, 30 * MM, 74 * MM)
    return move(window * rise(sites.depth, 0.0, 50 * MM), (0.0, 0.0, 9 * MM))


def _height(sites: Sites) -> FloatArray:
    # By rows: the hairline is lower at the temples than in the middle, and moves as one.
    return move(rise(sites.rows, 3.6, -1.5), (0.0, 16 * MM, 0.0))


def _width(sites: Sites) -> FloatArray:
    brow = landmark("brow")
    return stretch(rise(sites.y, brow[1] - 20 * MM, brow[1] + 18 * MM), sites, brow, (0.11, 0, 0))


def _brow_ridge(sites: Sites) -> FloatArray:
    brow = landmark("brow")[1]
    window = hill(sites.y, brow - 17 * MM, brow - 3 * MM, brow + 2 * MM, brow + 22 * MM)
    return move(window * fall(sites.aside, 26 * MM, 58 * MM), (0.0, -1 * MM, 5.5 * MM))


FRONTAL = (
    ShapeField("foreheadProtrusion", "forehead bulges forward; at -1 it slopes back", _protrusion),
    ShapeField("foreheadHeight", "high forehead", _height),
    ShapeField("foreheadWidth", "wide forehead and temples", _width),
    ShapeField("browRidge", "heavy brow ridge", _brow_ridge),
)
