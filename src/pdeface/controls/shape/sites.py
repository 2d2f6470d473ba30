"""Where the data points lie on the neutral face: what a displacement is a function of."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property, lru_cache

import numpy as np
from numpy.typing import NDArray

from pdeface.curves import curve_parameters
from pdeface.pde import GridEvaluator
from pdeface.template import LEVELS, neutral_curves
from pdeface.template.layout import PAPER_ROWS, ROWS

__all__ = ["MM", "Sites", "landmark", "mirror_z", "sites"]

FloatArray = NDArray[np.float64]

MM = 1e-3
"""A millimetre."""

# The paper's level. Its surface is smooth enough that sampling it at any level's data points loses
# nothing, and there a control whose window is 1 is the exact motion of every data point. Finer
# levels take the same field, so that a control does the same at all of them.
_LEVEL = "28x46"

_SIDES = np.array([-1.0, 1.0, 1.0])


@dataclass(frozen=True, eq=False)
class Sites:
    """Places on the neutral face.

    Attributes:
        points: (..., 3) metres.
        rows: (...) u in rows of the paper, 0 to 27.
    """

    points: FloatArray
    rows: FloatArray

    @property
    def x(self) -> FloatArray:
        """(...) towards the subject's left."""
        return self.points[..., 0]

    @property
    def y(self) -> FloatArray:
        """(...) upwards."""
        return self.points[..., 1]

    @property
    def z(self) -> FloatArray:
        """(...) forwards."""
        return self.points[..., 2]

    @cached_property
    def aside(self) -> FloatArray:
        """(...) distance from the midline plane."""
        return np.abs(self.x)

    @property
    def depth(self) -> FloatArray:
        """(...) distance in front of the plane of reflection."""
        return self.z - mirror_z()

    @cached_property
    def swapped(self) -> Sites:
        """The same places with left and right exchanged."""
        return Sites(self.points * _SIDES, self.rows)


def mirror_z() -> float:
    """Height of the plane of reflection of the neutral face, metres."""
    return neutral_curves(_LEVEL).mirror_z


@lru_cache(maxsize=16)
def sites(shape: tuple[int, int]) -> Sites:
    """Where the (K, M/2) data points of the front halves lie on the neutral face, with neighbours.

    Returns:
        (5, 5, K, M/2) places: :data:`TAPS` about each data point across u, and along v.
    """
    v = curve_parameters(shape[1])[: shape[1] // 2]
    u = np.linspace(0.0, 1.0, shape[0])
    steps = 0.5 * np.arange(-2.0, 3.0)
    # Nothing lies beyond the first and the last curve: there the neighbours draw together.
    reach = np.minimum(1.0 / (PAPER_ROWS - 1.0), np.minimum(u, 1.0 - u))
    us = np.clip(u + steps[:, None] * reach, 0.0, 1.0)
    vs = v + steps[:, None] * (2.0 * np.pi / LEVELS[_LEVEL][1])
    points = _on_neutral(us.ravel(), vs.ravel()).reshape(*us.shape, *vs.shape, 3).swapaxes(1, 2)
    # The face is symmetrical but for rounding; what is made from it shall be so to the last bit.
    points = 0.5 * (points + _SIDES * points[:, ::-1, :, ::-1])
    rows = (PAPER_ROWS - 1.0) * us[:, None, :, None]
    return Sites(points, np.broadcast_to(rows, points.shape[:-1]))


@lru_cache(maxsize=64)
def landmark(row: str, v: float = 0.5) -> FloatArray:
    """(3,) the place on the neutral face at a named row and v, in units of pi; 0.5 is the midline.

    Left is beyond 0.5.
    """
    place = _on_neutral(np.array([ROWS[row] / (PAPER_ROWS - 1.0)]), np.array([np.pi * v]))[0, 0]
    place.setflags(write=False)
    return place


def _on_neutral(u: FloatArray, v: FloatArray) -> FloatArray:
    evaluator = GridEvaluator(LEVELS[_LEVEL], u, v)
    return np.ascontiguousarray(evaluator.positions(neutral_curves(_LEVEL).points))
