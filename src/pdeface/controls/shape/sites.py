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

__all__ = ["MM", "Sites", "averaged", "landmark", "mirror_z", "sites"]

FloatArray = NDArray[np.float64]

MM = 1e-3
"""A millimetre."""

# Fields live on the neutral surface of the paper's level. At that level a motion without a window
# is then the exact motion of every data point, and at finer ones the same smooth motion. Made from
# the nostrils and lids of a finer level, it would ripple when it is sampled at 28 curves.
_LEVEL = "28x46"

# Windows are averaged over neighbours in space with these weights, upwards and sideways: what is
# too fine for the 28 x 46 data points of the paper, and would ripple between them, is gone before
# it is sampled. (Neighbours in u would not do: where rows crowd, they would leave a ledge.)
_WEIGHTS = np.array([1.0, 4.0, 6.0, 4.0, 1.0]) / 16.0
_NEIGHBOURS = 2
_STEP_UP = 4.0 * MM
_STEP_ASIDE = 6.0 * MM
_STEP_ROWS = 0.35

_SIDES = np.array([-1.0, 1.0, 1.0])


@dataclass(frozen=True, eq=False)
class Sites:
    """The data points of front halves on the neutral face, each amid 5 x 5 neighbours.

    Attributes:
        points: (5, 5, K, M/2, 3) metres; neighbours from above to below, from the subject's
            right to left, curves, points.
        rows: (5, 5, K, M/2) u in rows of the paper, 0 to 27 and a little beyond.
    """

    points: FloatArray
    rows: FloatArray

    @property
    def places(self) -> FloatArray:
        """(K, M/2, 3) the data points themselves."""
        return self.points[_NEIGHBOURS, _NEIGHBOURS]

    @property
    def x(self) -> FloatArray:
        """(5, 5, K, M/2) towards the subject's left."""
        return self.points[..., 0]

    @property
    def y(self) -> FloatArray:
        """(5, 5, K, M/2) upwards."""
        return self.points[..., 1]

    @property
    def z(self) -> FloatArray:
        """(5, 5, K, M/2) forwards."""
        return self.points[..., 2]

    @cached_property
    def aside(self) -> FloatArray:
        """(5, 5, K, M/2) distance from the midline plane."""
        return np.abs(self.x)

    @property
    def depth(self) -> FloatArray:
        """(5, 5, K, M/2) distance in front of the plane of reflection."""
        return self.z - mirror_z()

    @cached_property
    def swapped(self) -> Sites:
        """The same places with left and right exchanged."""
        return Sites(self.points * _SIDES, self.rows)


def averaged(window: FloatArray) -> FloatArray:
    """(K, M/2) weights of the data points from those of their (5, 5, K, M/2) neighbours."""
    return np.einsum("a,b,ab...->...", _WEIGHTS, _WEIGHTS, window)


def mirror_z() -> float:
    """Height of the plane of reflection of the neutral face, metres."""
    return neutral_curves(_LEVEL).mirror_z


@lru_cache(maxsize=16)
def sites(shape: tuple[int, int]) -> Sites:
    """The data points of K curves of M points on the neutral face."""
    v = curve_parameters(shape[1])[: shape[1] // 2]
    u = np.linspace(0.0, 1.0, shape[0])
    places = _on_neutral(u, v)
    # The face is symmetrical but for rounding; what is made from it shall be so to the last bit.
    places = 0.5 * (places + _SIDES * places[:, ::-1])
    steps = np.arange(-_NEIGHBOURS, _NEIGHBOURS + 1.0)
    points = np.tile(places, (len(steps), len(steps), 1, 1, 1))
    points[..., 1] -= _STEP_UP * steps[:, None, None, None]
    points[..., 0] += _STEP_ASIDE * steps[:, None, None]
    rows = (PAPER_ROWS - 1.0) * u[:, None] + _STEP_ROWS * steps[:, None, None, None]
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
