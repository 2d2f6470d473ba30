"""The head as a whole."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from pdeface.controls.shape.fields import ShapeField, move, stretch
from pdeface.controls.shape.sites import MM, Sites, landmark, mirror_z
from pdeface.controls.shape.windows import fall, hill, rise

__all__ = ["HEAD"]

FloatArray = NDArray[np.float64]


def _scaling(x: float, y: float, z: float, sites: Sites) -> FloatArray:
    centre = (0.0, landmark("nose_ridge")[1], mirror_z())
    return stretch(np.ones_like(sites.x), sites, centre, (x, y, z))


def _width(sites: Sites) -> FloatArray:
    return _scaling(0.12, 0.0, 0.0, sites)


def _height(sites: Sites) -> FloatArray:
    return _scaling(0.0, 0.11, 0.0, sites)


def _depth(sites: Sites) -> FloatArray:
    return _scaling(0.0, 0.0, 0.14, sites)


def _asymmetry(sites: Sites) -> FloatArray:
    """Nose, mouth and chin to the left, left eye and left side of the mouth high.

    Even in x along x and odd in x along y and z, so that -1 is the mirror image of +1.
    """
    y, aside = sites.y, sites.aside
    left = 2.0 * rise(sites.x, -45 * MM, 45 * MM) - 1.0
    shift = fall(y, -30 * MM, 28 * MM) * fall(aside, 28 * MM, 68 * MM)
    eyes = hill(y, 2 * MM, 26 * MM, 60 * MM, 92 * MM) * left
    mouth = hill(y, -64 * MM, -42 * MM, -26 * MM, -6 * MM) * left * fall(aside, 36 * MM, 68 * MM)
    cheek = hill(y, -42 * MM, -4 * MM, 14 * MM, 48 * MM) * left * fall(aside, 40 * MM, 69 * MM)
    return (
        move(shift, (4.5 * MM, 0, 0))
        + move(eyes - 0.9 * mouth, (0, 2.6 * MM, 0))
        + move(cheek, (0, 0, -2.5 * MM))
    )


HEAD = (
    ShapeField("faceWidth", "wide face", _width),
    ShapeField("faceHeight", "long face", _height),
    ShapeField("faceDepth", "deep face, its profile drawn out", _depth),
    ShapeField("asymmetry", "crooked: nose, mouth and chin to the left", _asymmetry),
)
