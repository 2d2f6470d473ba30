"""The tongue: rounded cross-sections from the root to the tip."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from pdeface.anatomy.measured import Frame, jaw_motion
from pdeface.anatomy.outline import Outline
from pdeface.anatomy.part import PARTS
from pdeface.curves import curve_parameters

__all__ = ["Tongue"]

FloatArray = NDArray[np.float64]

# The shape is drawn between the measured lower teeth: share of the length, then on the measured
# head z, height of the middle, half width and half thickness, metres.
SECTIONS = np.array(
    [
        (0.00, 0.038, -0.0470, 0.0150, 0.0100),
        (0.30, 0.052, -0.0450, 0.0165, 0.0090),
        (0.55, 0.066, -0.0435, 0.0165, 0.0075),
        (0.75, 0.081, -0.0418, 0.0155, 0.0060),
        (0.88, 0.091, -0.0402, 0.0138, 0.0046),
        (0.96, 0.0962, -0.0390, 0.0098, 0.0032),
        (1.00, 0.0982, -0.0386, 1e-6, 1e-6),
    ]
)

OUT, LIFT, DROOP = 0.036, 0.0105, 0.006
"""Where ``tongueOut`` takes the tip: forward, over the lower teeth and then down, metres."""

ROOT = 0.6
"""Over which share of its length the tongue comes to lie on the jaw: its root stays in the throat,
which an opening jaw would otherwise turn out of the back of the head."""

GROOVE = 0.0012
"""Depth of the furrow along the middle, metres."""


class Tongue:
    """The tongue, which lies on the jaw and comes out by ``tongueOut``.

    Args:
        frame: takes places on the measured head to the person's.
    """

    def __init__(self, frame: Frame) -> None:
        self._frame = frame
        curves, count = PARTS["tongue"].shape
        share = 1.0 - (1.0 - np.arange(curves) / (curves - 1)) ** 1.6
        z, y, width, thickness = (
            np.interp(share, SECTIONS[:, 0], column)[:, None] for column in SECTIONS[:, 1:].T
        )
        angle = np.pi - curve_parameters(count)
        x, top = width * np.cos(angle), np.sin(angle)
        groove = GROOVE * (thickness / thickness.max()) * np.clip(top, 0.0, 1.0) ** 4
        height = y + thickness * np.sign(top) * np.abs(top) ** 0.8 - groove
        self.rest = frame(np.stack([x, height, np.broadcast_to(z, x.shape)], axis=2))
        self._out = frame.scale * _way_out(share)
        lying = (share / ROOT).clip(0.0, 1.0)
        self._on_jaw = (lying * lying * (3.0 - 2.0 * lying))[:, None, None]

    def moved(self, outline: Outline, weights: Mapping[str, float]) -> FloatArray:
        """(K, M, 3) displacement, linear in the weights."""
        moved = self._on_jaw * jaw_motion(self.rest, self._frame, weights)
        return moved + weights.get("tongueOut", 0.0) * self._out[:, None]


def _way_out(share: FloatArray) -> FloatArray:
    """(K, 3) way of each section: forward, up where it passes the teeth, down at the tip."""
    forward = OUT * share**1.5
    rise = np.sin(np.pi * np.minimum(share, 0.8) / 1.6)
    height = LIFT * rise**2 - DROOP * np.clip((share - 0.5) / 0.5, 0.0, 1.0) ** 2
    return np.stack([np.zeros_like(share), height, forward], axis=1)
