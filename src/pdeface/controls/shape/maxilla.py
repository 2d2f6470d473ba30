"""The upper jaw: the mouth, the lips and the philtrum."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from pdeface.controls.shape.fields import ShapeField, move, stretch
from pdeface.controls.shape.sites import MM, Sites, landmark
from pdeface.controls.shape.windows import fall, hill, rise
from pdeface.template.layout import ROWS

__all__ = ["MAXILLA"]

FloatArray = NDArray[np.float64]


def _mouth() -> FloatArray:
    """Where the lips meet."""
    return 0.5 * (landmark("mouth_seam_upper") + landmark("mouth_seam_lower"))


def _width(sites: Sites) -> FloatArray:
    mouth = _mouth()
    up = hill(sites.y, mouth[1] - 30 * MM, mouth[1] - 8 * MM, mouth[1] + 7 * MM, mouth[1] + 25 * MM)
    window = up * fall(sites.aside, 25 * MM, 62 * MM) * rise(sites.depth, 10 * MM, 60 * MM)
    # Along the arch of the teeth: straight to the side, the corners would leave the cheeks.
    arch = move(-window * sites.x**2 / (50 * MM), (0.0, 0.0, 1.0))
    return 0.22 * (stretch(window, sites, mouth, (1.0, 0.0, 0.0)) + arch)


def _protrusion(sites: Sites) -> FloatArray:
    y = _mouth()[1]
    up = hill(sites.y, y - 24 * MM, y - 9 * MM, y + 9 * MM, y + 21 * MM)
    return move(up * fall(sites.aside, 12 * MM, 46 * MM), (0.0, 0.0, 6.5 * MM))


# The lips go by rows: they lie against each other, and no place in space tells them apart. Each
# swells forward as a whole; only its border goes up or down, so that the seam stays where it is.


def _upper_lip(sites: Sites) -> FloatArray:
    border = ROWS["upper_lip_border"]
    across = fall(sites.aside, 5 * MM, 23 * MM)
    swell = hill(sites.rows, border - 1.6, border + 0.1, border + 0.4, border + 2.2)
    lift = hill(sites.rows, border - 1.3, border - 0.1, border, border + 0.9)
    return move(across * swell, (0, 0, 3.2 * MM)) + move(across * lift, (0, 2.8 * MM, 0))


def _lower_lip(sites: Sites) -> FloatArray:
    border = ROWS["lower_lip_border"]
    across = fall(sites.aside, 5 * MM, 23 * MM)
    swell = hill(sites.rows, border - 2.1, border - 0.5, border, border + 1.6)
    drop = hill(sites.rows, border - 0.9, border, border + 0.1, border + 1.5)
    return move(across * swell, (0, 0, 3.2 * MM)) + move(across * drop, (0, -2.9 * MM, 0))


def _philtrum(sites: Sites) -> FloatArray:
    base, lip = landmark("subnasale")[1], landmark("lower_lip_border")[1]
    up = hill(sites.y, lip - 22 * MM, lip - 2 * MM, base - 15 * MM, base + 1 * MM)
    return move(up * fall(sites.aside, 28 * MM, 54 * MM), (0.0, -5 * MM, 0.0))


MAXILLA = (
    ShapeField("mouthWidth", "wide mouth", _width),
    ShapeField("mouthProtrusion", "mouth forward; at -1 it is sunken", _protrusion),
    ShapeField("upperLipFullness", "full upper lip", _upper_lip),
    ShapeField("lowerLipFullness", "full lower lip", _lower_lip),
    ShapeField("philtrumLength", "long upper lip: the mouth is low", _philtrum),
)
