"""What is known of faces before the scan is seen: the neutral one, and how people differ."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pdeface.controls import measured
from pdeface.pde import GridEvaluator, PDESurface
from pdeface.template import neutral_curves

__all__ = ["IDENTITIES", "Grid", "Places", "dense_neutral", "grid", "places"]

FloatArray = NDArray[np.float64]

IDENTITIES = measured.IDENTITIES
_SIZE = 28, 46
_FINEST = "109x184"


@lru_cache(maxsize=1)
def _modes() -> FloatArray:
    """(modes, 28, 46, 3) displacements of the curves by one standard deviation of each mode."""
    return np.array([measured.identities({index: 1.0}, _SIZE) for index in range(IDENTITIES)])


@dataclass(frozen=True, eq=False)
class Places:
    """Places (u, v) on the face and how people differ there.

    Attributes:
        neutral: (n, 3) metres.
        modes: (modes, n, 3) metres for one standard deviation of each.
    """

    neutral: FloatArray
    modes: FloatArray

    def of(self, weights: FloatArray) -> FloatArray:
        """(n, 3) the places on the person with these weights."""
        return np.asarray(self.neutral + np.tensordot(weights, self.modes, 1))


def places(u: FloatArray, v: FloatArray) -> Places:
    """The face at (n,) u and (n,) v."""
    neutral = PDESurface(neutral_curves(_FINEST).points)(u, v)
    modes = np.array([PDESurface(mode)(u, v) for mode in _modes()])
    return Places(neutral, modes)


@dataclass(frozen=True, eq=False)
class Grid:
    """The face on a grid of (u, v): rows ``u = i / (U - 1)``, columns ``v = (j + 1/2) pi / V``.

    Attributes:
        u, v: (U,) and (V,).
        neutral: (U, V, 3) metres.
        modes: (modes, U, V, 3).
    """

    u: FloatArray
    v: FloatArray
    neutral: FloatArray
    modes: FloatArray

    def of(self, weights: FloatArray) -> FloatArray:
        """(U, V, 3) the person with these weights."""
        return np.asarray(self.neutral + np.tensordot(weights, self.modes, 1))


def dense_neutral(u: NDArray[Any], v: NDArray[Any]) -> FloatArray:
    """(U, V, 3) the neutral face at its finest level."""
    curves = neutral_curves(_FINEST)
    return np.ascontiguousarray(GridEvaluator(curves.shape, u, v).positions(curves.points))


@lru_cache(maxsize=4)
def grid(rows: int, columns: int) -> Grid:
    """The face on a grid of so many rows, and columns from ear to ear."""
    u: FloatArray = np.linspace(0.0, 1.0, rows).astype(np.float64)
    v: FloatArray = ((np.arange(columns) + 0.5) * (np.pi / columns)).astype(np.float64)
    modes = np.array(GridEvaluator(_SIZE, u, v).positions(_modes()), np.float64, order="C")
    return Grid(u, v, dense_neutral(u, v), modes)
