"""Smooth rows that never cross: t as a function of u and v that increases with u by construction.

``t(u, v) = integral_0^u rho / integral_0^1 rho`` with ``rho = exp(g)``. The exponent g is a cubic
B-spline in u times cosines of 2 m v, which makes rows symmetric about the midline and flat where
they meet the plane of reflection; a few narrow bumps let rows close up at the lids and lips without
disturbing their neighbours.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import BSpline, CubicSpline

__all__ = ["Bump", "Pins", "RowMap"]

FloatArray = NDArray[np.float64]

KNOTS, WAVES, CELLS = 16, 8, 27 * 12
BENDING, WAVINESS, SLOPE, SIZE = 2e-4, 1e-4, 6e-5, 1e-5
LARGEST_STEP, CONVERGED, ROUNDS = 1.5, 1e-4, 60


@dataclass(frozen=True)
class Bump:
    """A place where rows may close up.

    Attributes:
        row: at u = row / 27.
        width: standard deviation, rows.
        start, end: from and to which distance from the midline, radians of v.
        softness: width of its two flanks, radians.
    """

    row: float
    width: float
    start: float
    end: float
    softness: float = 0.05

    def along_u(self, u: FloatArray) -> FloatArray:
        """Its profile across the rows."""
        return np.asarray(np.exp(-0.5 * ((u * 27.0 - self.row) / self.width) ** 2))

    def along_v(self, v: FloatArray) -> FloatArray:
        """Its window along the rows."""
        away = np.abs(v - np.pi / 2)
        return np.asarray(
            _logistic((away - self.start) / self.softness)
            * _logistic((self.end - away) / self.softness)
        )


class Pins(NamedTuple):
    """Where rows shall lie: t at (u, v), with a weight; four arrays of one length."""

    u: FloatArray
    v: FloatArray
    t: FloatArray
    weight: FloatArray


class RowMap:
    """t(u, v), fitted to pins by regularised Gauss-Newton steps."""

    def __init__(self, bumps: list[Bump], pins: Pins) -> None:
        self._edges = np.linspace(0.0, 1.0, CELLS + 1)
        middles = 0.5 * (self._edges[1:] + self._edges[:-1])
        knots = np.concatenate([[0.0] * 3, np.linspace(0.0, 1.0, KNOTS - 2), [1.0] * 3])
        spline = BSpline.design_matrix(middles, knots, 3).toarray()
        self._bumps = bumps
        self._along_u = np.column_stack([spline, *(b.along_u(middles) for b in bumps)])
        self._spline = np.zeros((KNOTS, WAVES))
        self._heights = np.zeros(len(bumps))
        for _ in range(ROUNDS):
            step = self._step(pins)
            self._spline += step[: KNOTS * WAVES].reshape(KNOTS, WAVES)
            self._heights += step[KNOTS * WAVES :]
            if np.abs(step).max() < CONVERGED:
                break

    def __call__(self, u: FloatArray, v: FloatArray) -> FloatArray:
        """(U, V) values of t."""
        return np.asarray(CubicSpline(self._edges, self._cumulative(self._density(v)))(u))

    def inverse(self, t: float, v: float) -> float:
        """u at which t is reached on the column v."""
        column = self._cumulative(self._density(np.array([v])))[:, 0]
        return float(np.interp(t, column, self._edges))

    def _density(self, v: FloatArray) -> FloatArray:
        """(cells, V) values of rho."""
        along_v = self._along_v(v)
        exponent = self._along_u[:, :KNOTS] @ self._spline @ along_v[:WAVES]
        exponent += self._along_u[:, KNOTS:] @ (self._heights[:, None] * along_v[WAVES:])
        return np.asarray(np.exp(exponent))

    def _along_v(self, v: FloatArray) -> FloatArray:
        cosines = np.cos(2.0 * np.multiply.outer(np.arange(WAVES), v))
        return np.concatenate([cosines, *(b.along_v(v)[None] for b in self._bumps)])

    @staticmethod
    def _cumulative(density: FloatArray) -> FloatArray:
        total = np.concatenate([np.zeros((1, density.shape[1])), np.cumsum(density, axis=0)])
        return np.asarray(total / total[-1])

    def _step(self, pins: Pins) -> FloatArray:
        """One Gauss-Newton step towards the pins."""
        along_v = self._along_v(pins.v)
        density = self._density(pins.v)
        position = pins.u * CELLS
        cell = np.minimum(position.astype(int), CELLS - 1)
        rows, residuals = [], []
        for k, weight in enumerate(pins.weight):
            parts = density[:, k, None] * np.column_stack([np.ones(CELLS), self._along_u])
            part = parts[: cell[k]].sum(axis=0) + (position[k] - cell[k]) * parts[cell[k]]
            whole = parts.sum(axis=0)
            t = part[0] / whole[0]
            change = (part[1:] - t * whole[1:]) / whole[0]
            spline = np.multiply.outer(change[:KNOTS], along_v[:WAVES, k]).ravel()
            bumps = change[KNOTS:] * along_v[WAVES:, k]
            rows.append(weight * np.concatenate([spline, bumps]))
            residuals.append(weight * (pins.t[k] - t))
        stiffness, tension = self._regularisation()
        system = np.concatenate([rows, stiffness])
        step = np.linalg.lstsq(system, np.concatenate([residuals, tension]), rcond=None)[0]
        return np.asarray(step * min(1.0, LARGEST_STEP / np.abs(step).max()))

    def _regularisation(self) -> tuple[FloatArray, FloatArray]:
        wave = np.arange(WAVES)
        stiffness = np.concatenate(
            [
                BENDING * np.kron(np.diff(np.eye(KNOTS), 2, axis=0), np.eye(WAVES)),
                WAVINESS * np.kron(np.eye(KNOTS), np.diag(wave**2)),
                SLOPE * np.kron(np.diff(np.eye(KNOTS), axis=0), np.diag(1 + wave)),
            ]
        )
        stiffness = np.column_stack([stiffness, np.zeros((len(stiffness), len(self._bumps)))])
        stiffness = np.concatenate([stiffness, SIZE * np.eye(stiffness.shape[1])])
        return stiffness, -stiffness @ np.concatenate([self._spline.ravel(), self._heights])


def _logistic(x: FloatArray) -> FloatArray:
    return np.asarray(1.0 / (1.0 + np.exp(-x)))
