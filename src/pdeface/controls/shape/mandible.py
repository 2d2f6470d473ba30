"""The lower jaw and the chin."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from pdeface.controls.shape.fields import ShapeField, both_sides, move, stretch
from pdeface.controls.shape.sites import MM, Sites, landmark
from pdeface.controls.shape.windows import fall, rise

__all__ = ["MANDIBLE"]

FloatArray = NDArray[np.float64]


def _lip() -> float:
    return landmark("lower_lip_border")[1]


def _jaw_width(sites: Sites) -> FloatArray:
    mouth = landmark("mouth_seam_upper")[1]
    window = rise(sites.x, 26 * MM, 58 * MM) * fall(sites.y, mouth - 8 * MM, mouth + 42 * MM)
    return move(window, (8 * MM, 0.0, 0.0))


def _jaw_angle(sites: Sites) -> FloatArray:
    mouth = landmark("mouth_seam_upper")[1]
    window = rise(sites.x, 24 * MM, 60 * MM) * fall(sites.y, mouth - 14 * MM, mouth + 30 * MM)
    return move(window, (1.5 * MM, -9 * MM, 0.0))


def _chin_protrusion(sites: Sites) -> FloatArray:
    lip = _lip()
    window = fall(sites.y, lip - 21 * MM, lip - 3 * MM) * fall(sites.aside, 10 * MM, 42 * MM)
    return move(window * rise(sites.depth, 34 * MM, 79 * MM), (0.0, 0.0, 8 * MM))


def _chin_height(sites: Sites) -> FloatArray:
    lip = _lip()
    window = fall(sites.y, lip - 36 * MM, lip - 3 * MM) * fall(sites.aside, 16 * MM, 60 * MM)
    return move(window, (0.0, -9 * MM, 0.0))


def _chin_width(sites: Sites) -> FloatArray:
    lip = _lip()
    window = fall(sites.y, lip - 26 * MM, lip - 4 * MM) * fall(sites.aside, 16 * MM, 50 * MM)
    return stretch(window, sites, landmark("chin"), (0.3, 0.0, 0.0))


MANDIBLE = (
    ShapeField("jawWidth", "wide jaw", both_sides(_jaw_width)),
    ShapeField("jawAngle", "square jaw, low at its angle; at -1 it rises", both_sides(_jaw_angle)),
    ShapeField("chinProtrusion", "chin far forward; at -1 it recedes", _chin_protrusion),
    ShapeField("chinHeight", "long chin", _chin_height),
    ShapeField("chinWidth", "broad chin; at -1 it is pointed", _chin_width),
)
