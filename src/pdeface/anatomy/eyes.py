"""Eyeballs that turn, and the rims that give the lids their thickness."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

import numpy as np
from numpy.typing import NDArray

from pdeface.anatomy.measured import Frame, data, reference
from pdeface.anatomy.outline import Loop, Margins, Outline, middle
from pdeface.anatomy.part import PARTS
from pdeface.curves import curve_parameters

__all__ = ["CLEARANCE", "LOOK", "Eyeball", "Lids"]

FloatArray = NDArray[np.float64]

CLEARANCE = 4e-4
"""Distance between the eyeball and the nearest point of the lid margins, metres."""

LOOK = np.radians(30.0)
"""How far an eye turns at a weight of 1."""

BACK = np.radians(150.0)
"""Angle from the pupil to the last circle, where the optic nerve would leave."""

SPACING = 1.3
"""Circle k of K lies at the angle ``BACK (k / (K - 1)) ** SPACING``: denser at the pupil."""

PUPIL = 1e-6
"""Radius of the first circle, metres: not 0, where a surface has no normal."""

# Distance from the eyeball, way outwards beneath the skin (both metres) and share of the motion of
# the margin, for each curve of a rim after the first.
RIM = ((1.5e-4, 0.0, 1.0), (2e-4, 0.6e-3, 1.0), (3e-4, 1.8e-3, 1.0), (3e-4, 4e-3, 0.9))


class Eyeball:
    """A sphere behind the lids, drawn as circles about the direction of the gaze.

    Its place and size are the measured ones, brought to the person by the width of the eye; then
    it moves along z until the nearest lid is :data:`CLEARANCE` in front of it.

    Args:
        side: ``"right"`` or ``"left"``.
        margins: the lids at rest.
        others: further positions of the lids, such as half and wholly closed.
    """

    def __init__(self, side: str, margins: Margins, others: Iterable[Margins] = ()) -> None:
        self._side = side
        name = f"{side}_eye"
        frame = Frame.between(getattr(reference(), name), margins)
        mirror = np.array([1.0 if side == "left" else -1.0, 1.0, 1.0])
        self.radius = frame.scale * float(data()["eye_radius"])
        self.centre = frame(mirror * data()["eye_centre"])
        lids = np.concatenate([points for each in (margins, *others) for points in each])
        self.centre = self.centre - (0.0, 0.0, _way_back(lids, self.centre, self.radius))
        self._relative = self.radius * _sphere(PARTS[f"{side}_eyeball"].shape, self.radius)
        self.rest = self.centre + self._relative

    def moved(self, outline: Outline, weights: Mapping[str, float]) -> FloatArray:
        """(K, M, 3) displacement by looks, about the centre.

        A look at weight w alone does ``w (R - I) x``, as a morph target does. Looks aside and up or
        down are made one after the other: their sum would swell the eyeball through its lids.
        """
        outwards = 1.0 if self._side == "left" else -1.0
        turned = self._relative
        for axis, looks in (
            (1, (("Out", outwards), ("In", -outwards))),
            (0, (("Up", -1.0), ("Down", 1.0))),
        ):
            turn = np.eye(3)
            for look, sign in looks:
                weight = weights.get(f"eyeLook{look}{self._side.capitalize()}", 0.0)
                turn += weight * (_rotation(axis, sign * LOOK) - np.eye(3))
            turned = turned @ turn.T
        return np.asarray(turned - self._relative)


class Lids:
    """The rim of the lids: from their margin back to the eyeball and away beneath the skin.

    At the corners of the eye its two halves meet, so that the opening ends in a point.
    """

    def __init__(self, side: str, margins: Margins, ball: Eyeball) -> None:
        self._name = f"{side}_eye"
        self._loop = Loop(margins, PARTS[f"{side}_lids"].shape[1])
        self._taper = self._loop.taper(0.2)
        loop = self._loop(margins)
        pinched = self._pinched(loop)
        outwards = loop - loop.mean(axis=0)
        outwards[:, 2] = 0.0
        outwards /= np.linalg.norm(outwards, axis=1, keepdims=True)
        curves = [loop]
        for gap, out, _ in RIM:
            from_centre = pinched + out * outwards - ball.centre
            length = np.linalg.norm(from_centre, axis=1, keepdims=True)
            curves.append(ball.centre + from_centre * ((ball.radius + gap) / length))
        self.rest = np.array(curves)

    def moved(self, outline: Outline, weights: Mapping[str, float]) -> FloatArray:
        """(K, M, 3) displacement, linear in that of the margins."""
        loop = self._loop(getattr(outline, self._name))
        pinched = self._pinched(loop)
        return np.array([loop, *(share * pinched for _, _, share in RIM)])

    def _pinched(self, loop: FloatArray) -> FloatArray:
        centre = middle(loop)
        return centre + self._taper * (loop - centre)


def _way_back(lids: FloatArray, centre: FloatArray, radius: float) -> float:
    """How far back a sphere must go to lie behind every point, just clear of the nearest."""
    away = lids - centre
    in_front = (radius + CLEARANCE) ** 2 - (away[:, :2] ** 2).sum(axis=1)
    reached = in_front > 0.0
    return float((np.sqrt(in_front[reached]) - away[reached, 2]).max())


def _sphere(shape: tuple[int, int], radius: float) -> FloatArray:
    """(K, M, 3) circles of the unit sphere, from +Z to the back, denser at the pupil."""
    circles, count = shape
    angle = BACK * (np.arange(circles) / (circles - 1)) ** SPACING
    angle[0] = PUPIL / radius
    v = curve_parameters(count)
    ring = np.stack([np.cos(v), np.sin(v), np.zeros(count)], axis=1)
    axis = np.array([0.0, 0.0, 1.0])
    return np.asarray(
        np.sin(angle)[:, None, None] * ring + np.cos(angle)[:, None, None] * axis,
    )


def _rotation(axis: int, angle: float) -> FloatArray:
    """(3, 3) rotation about the x axis (0) or the y axis (1)."""
    c, s = np.cos(angle), np.sin(angle)
    if axis == 0:
        return np.array([[1.0, 0.0, 0.0], [0.0, c, -s], [0.0, s, c]])
    return np.array([[c, 0.0, s], [0.0, 1.0, 0.0], [-s, 0.0, c]])
