"""Take the parting of lids and lips out of a displacement.

Where an opening opens, its two sides move apart. A C2 spline answers such a jump with overshoot on
both sides, so the jump is taken out and carried by curves whose surface is slit there; what is left
is smooth across the opening. A little beyond the corners of an opening the jump is zero, and the
surface stays in one piece.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pdeface.template.layout import PAPER_ROWS, ROWS

__all__ = ["Opening", "split"]

FloatArray = NDArray[np.float64]

BRIDGE = 0.1
"""How many radians beyond the corners the rows of an opening go on being bridged."""


@dataclass(frozen=True)
class Opening:
    """An opening between two rows.

    Attributes:
        upper, lower: names of the rows on its two sides.
        start, end: v of its corners, radians.
        reach: over how many rows the jump fades out on both sides.
        upper_share: what the upper side takes of the jump, 0 to 1; the lower takes the rest. The
            side that moves should have it, so that what the other does is fitted without a break.
        softness: over how many radians it fades out about the corners.
        beyond: how many radians beyond the corners it has faded out.
    """

    upper: str
    lower: str
    start: float
    end: float
    reach: float
    upper_share: float
    softness: float = 0.12
    beyond: float = 0.0

    def window(self, v: FloatArray) -> FloatArray:
        """1 inside the opening, falling smoothly to 0 at or beyond its corners."""
        inside = v - self.start + self.beyond, self.end + self.beyond - v
        rise, fall = ((d / self.softness).clip(0.0, 1.0) for d in inside)
        return rise**2 * (3.0 - 2.0 * rise) * fall**2 * (3.0 - 2.0 * fall)

    def bridged(self, samples: FloatArray, v: FloatArray) -> FloatArray:
        """Displacements that go evenly from one side of the opening to the other.

        Where the head has lips, the step from one to the other lies somewhere between the two
        rows; nothing of it is seen, and a fit that followed it would ring on both sides.
        """
        step = (len(samples) - 1) // (PAPER_ROWS - 1)
        between = slice(step * ROWS[self.upper], step * ROWS[self.lower] + 1)
        strip = samples[between]
        across = np.linspace(0.0, 1.0, len(strip))[:, None, None]
        even = strip[0] + across * (strip[-1] - strip[0])
        inside = np.minimum(v - self.start, self.end - v)
        share = (1.0 + inside / BRIDGE).clip(0.0, 1.0)[:, None]
        bridged = samples.copy()
        bridged[between] += share * (even - strip)
        return bridged

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

    Between the two rows of an opening they are bridged (:meth:`Opening.bridged`).

    Args:
        samples: (U, V, 3) displacements, rows at even steps of u, among them the rows of the paper.
        v: (V,) radians.
        openings: where the surface may part.

    Returns:
        Two arrays like ``samples``, whose sum it is outside the openings.
    """
    row = np.linspace(0.0, PAPER_ROWS - 1, len(samples))
    step = (len(samples) - 1) // (PAPER_ROWS - 1)
    for opening in openings:
        samples = opening.bridged(samples, v)
    parting = np.zeros_like(samples)
    for opening in openings:
        jump = samples[step * ROWS[opening.lower]] - samples[step * ROWS[opening.upper]]
        jump = jump * opening.window(v)[:, None]
        parting += opening.share(row)[:, None, None] * jump
    return samples - parting, parting
