"""Take the parting of lids and lips out of a displacement.

Where an opening opens, its two sides move apart. A C2 spline answers such a jump with overshoot on
both sides, so the jump is taken out and carried by curves whose surface is slit there; what is left
is smooth across the opening. Beyond the corners of an opening the jump is zero, and the surface
stays in one piece.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pdeface.template.layout import PAPER_ROWS, ROWS

__all__ = ["Opening", "split"]

FloatArray = NDArray[np.float64]


@dataclass(frozen=True)
class Opening:
    """An opening between two rows.

    Attributes:
        upper, lower: names of the rows on its two sides.
        start, end: v of its corners, radians.
        reach: over how many rows the jump fades out on both sides.
        upper_share: what the upper side takes of the jump, 0 to 1; the lower takes the rest. The
            side that moves should have it, so that what the other does is fitted without a break.
        softness: over how many radians it fades out towards the corners.
    """

    upper: str
    lower: str
    start: float
    end: float
    reach: float
    upper_share: float
    softness: float = 0.12

    def window(self, v: FloatArray) -> FloatArray:
        """1 inside the opening, falling smoothly to 0 at its corners."""
        rise, fall = ((d / self.softness).clip(0.0, 1.0) for d in (v - self.start, self.end - v))
        return rise**2 * (3.0 - 2.0 * rise) * fall**2 * (3.0 - 2.0 * fall)

    def share(self, row: FloatArray) -> FloatArray:
        """What each row takes of the jump: ``upper_share`` on the upper side, against it, and the
        rest on the lower."""
        upper, lower = ROWS[self.upper], ROWS[self.lower]
        away = np.where(row < upper, upper - row, np.maximum(row - lower, 0.0)) / self.reach
        fade = (1.0 - away.clip(0.0, 1.0) ** 2) ** 3
        between = ((row - upper) / (lower - upper)).clip(0.0, 1.0) - self.upper_share
        sides = np.where(row <= upper, -self.upper_share, 1.0 - self.upper_share)
        return np.where((row > upper) & (row < lower), between, sides * fade)


def split(
    samples: FloatArray, v: FloatArray, openings: list[Opening]
) -> tuple[FloatArray, FloatArray]:
    """Split displacements into a part smooth across the openings and a part that parts them.

    Args:
        samples: (U, V, 3) displacements, rows at even steps of u, among them the rows of the paper.
        v: (V,) radians.
        openings: where the surface may part.

    Returns:
        Two arrays like ``samples``, whose sum it is.
    """
    row = np.linspace(0.0, PAPER_ROWS - 1, len(samples))
    step = (len(samples) - 1) // (PAPER_ROWS - 1)
    parting = np.zeros_like(samples)
    for opening in openings:
        jump = samples[step * ROWS[opening.lower]] - samples[step * ROWS[opening.upper]]
        jump = jump * opening.window(v)[:, None]
        parting += opening.share(row)[:, None, None] * jump
    return samples - parting, parting
