"""The orbits: the eyes with their lids.

Lids and mid-eye row move as one, nearly rigidly, so that an eyeball fits behind them.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from pdeface.controls.shape.fields import ShapeField, both_sides, move, stretch, turn
from pdeface.controls.shape.sites import MM, Sites, landmark
from pdeface.controls.shape.windows import dome

__all__ = ["ORBITAL"]

FloatArray = NDArray[np.float64]

_LEFT_EYE = 0.684
"""v / pi of the middle of the left eye."""


def _eye() -> FloatArray:
    return landmark("mid_eye", _LEFT_EYE)


def _around_eye(sites: Sites, across: float, up: float, core: float) -> FloatArray:
    return dome(sites.points, _eye(), (across, up, np.inf), core)


def _size(sites: Sites) -> FloatArray:
    window = _around_eye(sites, 32 * MM, 28 * MM, 0.48)
    return stretch(window, sites, _eye(), (0.23, 0.23, 0.23))


def _spacing(sites: Sites) -> FloatArray:
    return move(_around_eye(sites, 33 * MM, 29 * MM, 0.5), (4.5 * MM, 0.0, 0.0))


def _depth(sites: Sites) -> FloatArray:
    # A socket is deeper below the eye than above: the brow stays.
    socket = _eye() - (0.0, 5 * MM, 0.0)
    return move(dome(sites.points, socket, (34 * MM, 31 * MM, np.inf), 0.32), (0.0, 0.0, -5 * MM))


def _tilt(sites: Sites) -> FloatArray:
    return turn(_around_eye(sites, 31 * MM, 26 * MM, 0.5), sites, _eye(), (0.0, 0.0, 0.2))


ORBITAL = (
    ShapeField("eyeSize", "large eyes", both_sides(_size)),
    ShapeField("eyeSpacing", "eyes far apart", both_sides(_spacing)),
    ShapeField("eyeDepth", "deep-set eyes", both_sides(_depth)),
    ShapeField("eyeTilt", "outer corners of the eyes high", both_sides(_tilt)),
)
