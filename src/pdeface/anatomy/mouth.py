"""The cavity of the mouth: lips that roll inwards, the inside of the cheeks, the throat."""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from pdeface.anatomy.measured import Frame, jaw_motion
from pdeface.anatomy.outline import Loop, Margins, Outline, middle
from pdeface.anatomy.part import PARTS
from pdeface.curves import curve_parameters

__all__ = ["Cavity"]

FloatArray = NDArray[np.float64]


class _Roll(NamedTuple):
    """A curve of the lips: how far behind the margin (metres) and how much of it is open."""

    depth: float
    open: float


class _Ring(NamedTuple):
    """A curve of the cavity on the measured head: two half ellipses bent about the teeth, metres.

    ``follow`` is the share of the motion of the margin; the rest is the jaw's, below.
    """

    depth: float
    half_width: float
    above: float
    below: float
    bend: float
    follow: float


LIPS = (_Roll(1.2e-3, 0.35), _Roll(3.0e-3, 0.0), _Roll(4.6e-3, 0.5))
RINGS = (
    _Ring(0.0085, 0.0295, 0.0120, 0.0060, 0.020, 0.80),
    _Ring(0.0220, 0.0340, 0.0180, 0.0140, 0.016, 0.35),
    _Ring(0.0380, 0.0350, 0.0225, 0.0190, 0.010, 0.0),
    _Ring(0.0500, 0.0310, 0.0210, 0.0190, 0.004, 0.0),
    _Ring(0.0570, 0.0200, 0.0130, 0.0170, 0.0, 0.0),
    _Ring(0.0610, 1e-6, 1e-6, 1e-6, 0.0, 0.0),
)


class Cavity:
    """The inside of the mouth, seen through the lips.

    Behind the margins the lips roll in until they touch, so that a mouth at rest is closed; the
    cavity then widens round the teeth and narrows to the throat.

    Args:
        margins: the lips at rest.
        frame: takes places on the measured head to the person's.
    """

    def __init__(self, margins: Margins, frame: Frame) -> None:
        count = PARTS["mouth"].shape[1]
        self._frame = frame
        self._loop = Loop(margins, count)
        loop = self._loop(margins)
        taper = self._loop.taper(0.15)
        angle = np.pi - curve_parameters(count)
        below = 0.5 - 0.5 * np.sin(angle)[:, None]
        self._below = below * below * (3.0 - 2.0 * below)
        centre = middle(loop)
        curves = [loop]
        for roll in LIPS:
            half = roll.open * taper * (loop - centre)
            curves.append(centre + half - (0.0, 0.0, roll.depth * frame.scale))
        front = frame.origin + np.array([0.0, 0.0, MIDDLE])
        curves += [frame(front + _ellipse(ring, angle)) for ring in RINGS]
        self.rest = np.array(curves)

    def moved(self, outline: Outline, weights: Mapping[str, float]) -> FloatArray:
        """(K, M, 3) displacement, linear in that of the margins and in the weights."""
        loop = self._loop(outline.mouth)
        moved = np.empty_like(self.rest)
        moved[: 1 + len(LIPS)] = loop
        rings = self.rest[1 + len(LIPS) :]
        jaw = self._below * jaw_motion(rings, self._frame, weights)
        follow = np.array([ring.follow for ring in RINGS])[:, None, None]
        moved[1 + len(LIPS) :] = follow * loop + (1.0 - follow) * jaw
        return moved


MIDDLE = 0.006
"""From the mean of the margins on the measured head forward to the lips' middle, metres."""


def _ellipse(ring: _Ring, angle: FloatArray) -> FloatArray:
    x, height = ring.half_width * np.cos(angle), np.sin(angle)
    y = np.where(height > 0.0, ring.above, ring.below) * height
    return np.stack([x, y, -ring.depth - ring.bend * np.cos(angle) ** 2], axis=1)
