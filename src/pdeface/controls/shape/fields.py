"""Displacement fields: what a control does to the data points of the neutral face, at +1.

A field is a motion of space (a translation, a scaling, a rotation) times a window. Windows are
(5, 5, K, M/2) weights, of every data point and its neighbours, which the motions average.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pdeface.controls.control import Control
from pdeface.controls.shape.sites import Sites, averaged

__all__ = ["Field", "ShapeField", "both_sides", "move", "stretch", "turn"]

FloatArray = NDArray[np.float64]

Field = Callable[[Sites], FloatArray]
"""Data points to their (K, M/2, 3) displacements, metres."""

_SIDES = np.array([-1.0, 1.0, 1.0])


class ShapeField(NamedTuple):
    """A shape control with the field that it stands for.

    Attributes:
        name: camelCase.
        description: what it does at +1.
        field: displacement at +1.
    """

    name: str
    description: str
    field: Field

    def control(self, group: str) -> Control:
        """The control, which goes from -1 to 1."""
        return Control(self.name, group, "shape", -1.0, 1.0, self.description)


def move(window: FloatArray, by: ArrayLike) -> FloatArray:
    """(K, M/2, 3) a translation by (3,) metres where the window is 1."""
    return averaged(window)[..., None] * np.asarray(by)


def stretch(
    window: FloatArray, sites: Sites, about: ArrayLike, by: tuple[float, float, float]
) -> FloatArray:
    """(K, M/2, 3) a scaling about a place, by so much of the distance along x, y and z."""
    return averaged(window)[..., None] * (sites.places - np.asarray(about)) * np.asarray(by)


def turn(window: FloatArray, sites: Sites, about: ArrayLike, by: ArrayLike) -> FloatArray:
    """(K, M/2, 3) a rotation about an axis (3,), whose length is the angle in radians.

    It is linear in the weight, so a place moves along the tangent of its circle.
    """
    arms = sites.points - np.asarray(about)
    # The tip of the nose stands out by more than the curves of the paper can turn without ripples:
    # the arms are averaged, too.
    return averaged(window[..., None] * np.cross(np.asarray(by, dtype=np.float64), arms))


def both_sides(left: Field) -> Field:
    """The field of the subject's left, and its mirror image on the right."""

    def field(sites: Sites) -> FloatArray:
        return left(sites) + _SIDES * left(sites.swapped)

    return field
