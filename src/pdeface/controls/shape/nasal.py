"""The nasal bones and the cartilage before them."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from pdeface.controls.shape.fields import ShapeField, both_sides, move, stretch, turn
from pdeface.controls.shape.sites import MM, Sites, landmark
from pdeface.controls.shape.windows import dome, fall, hill

__all__ = ["NASAL"]

FloatArray = NDArray[np.float64]


def _root() -> float:
    """Height of the root of the nose, between the inner corners of the eyes and the brows."""
    return landmark("upper_lid_fold")[1]


def _tip() -> float:
    return landmark("nose_tip")[1]


def _base() -> float:
    return landmark("subnasale")[1]


def _across(sites: Sites, inner: float, outer: float) -> FloatArray:
    """From 1 on the nose to 0 on cheeks and eyes: a window that is narrow between the eyes."""
    width = 0.4 + 0.6 * fall(sites.y, _tip() + 2 * MM, _root() - 8 * MM)
    return fall(sites.aside / width, inner, outer)


def _length(sites: Sites) -> FloatArray:
    base, root = _base(), _root()
    up = hill(sites.y, base - 11 * MM, base + 2 * MM, root - 1 * MM, root + 20 * MM)
    along = 1.25 * fall(sites.y, base, root - 1 * MM) - 0.25
    return move(_across(sites, 15 * MM, 33 * MM) * up * along, (0.0, -5.5 * MM, 1.4 * MM))


def _width(sites: Sites) -> FloatArray:
    up = hill(sites.y, _base() - 9 * MM, _base(), _tip() + 22 * MM, _root() - 2 * MM)
    window = _across(sites, 15 * MM, 33 * MM) * up
    return stretch(window, sites, landmark("nose_tip"), (0.19, 0.0, 0.0))


def _bridge_height(sites: Sites) -> FloatArray:
    root = _root()
    up = hill(sites.y, _tip() - 2 * MM, _tip() + 17 * MM, root - 11 * MM, root + 9 * MM)
    return move(up * fall(sites.aside, 0.0, 15 * MM), (0.0, 0.0, 7 * MM))


def _tip_projection(sites: Sites) -> FloatArray:
    up = hill(sites.y, _base() - 8 * MM, _tip() - 7 * MM, _tip() + 4 * MM, _root() - 9 * MM)
    return move(up * _across(sites, 7 * MM, 27 * MM), (0.0, 0.0, 7.5 * MM))


def _tip_rotation(sites: Sites) -> FloatArray:
    up = hill(sites.y, _base() - 9 * MM, _base() + 1 * MM, _tip() + 8 * MM, _root() - 7 * MM)
    centre = (0.0, _tip() - 6 * MM, landmark("nose_tip")[2] - 25 * MM)
    return turn(up * _across(sites, 11 * MM, 32 * MM), sites, centre, (-0.27, 0.0, 0.0))


def _nostril_width(sites: Sites) -> FloatArray:
    wing = (17 * MM, _tip() - 3 * MM, 0.0)
    return move(dome(sites.points, wing, (16 * MM, 20 * MM, np.inf), 0.15), (3.6 * MM, 0.0, 0.0))


NASAL = (
    ShapeField("noseLength", "long nose", _length),
    ShapeField("noseWidth", "wide nose, from the bridge to the wings", _width),
    ShapeField("noseBridgeHeight", "high bridge; at -1 it is a saddle", _bridge_height),
    ShapeField("noseTipProjection", "tip of the nose far forward", _tip_projection),
    ShapeField("noseTipRotation", "tip of the nose turned up", _tip_rotation),
    ShapeField("nostrilWidth", "flared nostrils", both_sides(_nostril_width)),
)
