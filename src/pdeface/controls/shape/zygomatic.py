"""The zygomatic bones and the cheeks below them."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from pdeface.controls.shape.fields import ShapeField, both_sides, move
from pdeface.controls.shape.sites import MM, Sites, landmark
from pdeface.controls.shape.windows import dome, hill, rise

__all__ = ["ZYGOMATIC"]

FloatArray = NDArray[np.float64]


def _cheekbone_width(sites: Sites) -> FloatArray:
    # As far back as the ear: the arch of the bone ends there.
    bone = landmark("nose_ridge")[1] + 3 * MM
    up = hill(sites.y, bone - 50 * MM, bone - 4 * MM, bone + 4 * MM, bone + 48 * MM)
    return move(up * rise(sites.x, 41 * MM, 66 * MM), (6.5 * MM, 0.0, 0.0))


def _cheek_fullness(sites: Sites) -> FloatArray:
    cheek = (46 * MM, landmark("subnasale")[1] + 2 * MM, 90 * MM)
    window = dome(sites.points, cheek, (29 * MM, 37 * MM, 60 * MM), 0.0)
    return move(window, (4.3 * MM, -0.5 * MM, 6 * MM))


ZYGOMATIC = (
    ShapeField("cheekboneWidth", "wide cheekbones", both_sides(_cheekbone_width)),
    ShapeField("cheekFullness", "full cheeks; at -1 they are hollow", both_sides(_cheek_fullness)),
)
