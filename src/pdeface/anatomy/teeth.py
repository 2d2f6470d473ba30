"""Teeth: each arch a tube bent to a horseshoe, its closed curves its cross-sections."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from pdeface.anatomy.measured import Arch, Frame, arch, jaw_motion
from pdeface.anatomy.outline import Margins, Outline
from pdeface.anatomy.part import PARTS
from pdeface.curves import curve_parameters

__all__ = ["Teeth", "behind_lips"]

FloatArray = NDArray[np.float64]

HEIGHT = 0.0165
"""From the biting edge to the end in the gum, metres on the measured head."""

LIP = 0.0046
"""Thickness of the lips where they lie on the teeth, metres on the measured head."""

OVERBITE = 0.0018
"""How much further back the lower arch stands than on the measured head: chins recede."""

SHOWN = 0.0025
"""How much lower both arches stand than on the measured head, whose upper teeth end so high that
its lips would hide them in a smile, metres."""

SQUARENESS = 0.62
"""Exponent of the superellipse of a cross-section: 1 is an ellipse, 0 a rectangle."""


class Teeth:
    """One arch: outer face, biting edge, inner face and gum in one smooth tube.

    Args:
        name: ``"upper"`` or ``"lower"``; the lower one moves with the jaw.
        frame: takes places on the measured head to the person's.
    """

    def __init__(self, name: str, frame: Frame) -> None:
        self._frame = frame
        self._moves = name == "lower"
        self.rest = frame(_tube(arch(name), name, PARTS[f"{name}_teeth"].shape))
        if self._moves:
            self.rest = self.rest - np.array([0.0, 0.0, OVERBITE * frame.scale])

    def moved(self, outline: Outline, weights: Mapping[str, float]) -> FloatArray:
        """(K, M, 3) displacement, linear in the weights."""
        if not self._moves:
            return np.zeros_like(self.rest)
        return jaw_motion(self.rest, self._frame, weights)


def behind_lips(frame: Frame, margins: Margins) -> Frame:
    """The frame moved back along z until the upper teeth leave room for the lips.

    Args:
        frame: from the measured mouth to the person's.
        margins: the lips at rest.
    """
    upper = arch("upper")
    x, z = _plan(upper.angle, upper.outer, upper.axis_z)
    front = frame(np.stack([x, np.full_like(x, upper.edge.mean()), z], axis=1))
    lips = np.minimum(margins.upper[:, 2], margins.lower[:, 2])
    across = 0.5 * (margins.upper[:, 0] + margins.lower[:, 0])
    in_front = (front[:, 0] > across.min()) & (front[:, 0] < across.max()) & (z > upper.axis_z)
    room = np.interp(front[in_front, 0], across, lips) - front[in_front, 2]
    return frame.shifted(np.array([0.0, 0.0, min(0.0, room.min() - LIP * frame.scale)]))


def _tube(teeth: Arch, name: str, shape: tuple[int, int]) -> FloatArray:
    """(K, M, 3) cross-sections from the subject's right to the left, small at both ends."""
    stations, count = shape
    angle = np.linspace(teeth.angle[0], teeth.angle[-1], stations - 2)
    outer, inner, edge = (
        np.interp(angle, teeth.angle, row) for row in (teeth.outer, teeth.inner, teeth.edge)
    )
    up = 1.0 if name == "upper" else -1.0
    across, along = _superellipse(curve_parameters(count))
    # 0 at the biting edge, 1 in the gum.
    height = 0.5 + 0.5 * up * along
    thickness = 0.5 * (outer - inner)[:, None] * (0.75 + 0.25 * np.sqrt(height))
    radius = 0.5 * (outer + inner)[:, None] + thickness * across
    y = edge[:, None] - SHOWN + up * HEIGHT * height
    x, z = _plan(angle[:, None], radius, teeth.axis_z)
    sections = np.stack([x, y, z], axis=2)
    ends = [
        centre + 0.02 * (section - centre)
        for section in sections[[0, -1]]
        for centre in [section.mean(axis=0) + (0.0, 0.0, -0.0008)]
    ]
    return np.concatenate([ends[:1], sections, ends[1:]])


def _superellipse(v: FloatArray) -> tuple[FloatArray, FloatArray]:
    c, s = np.cos(v), np.sin(v)
    return np.sign(c) * np.abs(c) ** SQUARENESS, np.sign(s) * np.abs(s) ** SQUARENESS


def _plan(angle: FloatArray, radius: FloatArray, axis_z: float) -> tuple[FloatArray, FloatArray]:
    return radius * np.sin(angle), axis_z + radius * np.cos(angle)
