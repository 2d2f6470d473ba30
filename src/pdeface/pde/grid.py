"""Evaluation on a fixed uv mesh: everything that does not depend on the face, computed once."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import DTypeLike, NDArray

from pdeface.errors import InputError
from pdeface.pde.differential import unit_normal
from pdeface.pde.fourier import analysis, synthesis, wave_numbers
from pdeface.pde.joins import Continuity, Join, check_join, slopes
from pdeface.pde.kernel import hermite
from pdeface.pde.surface import Side, check_parameters, locate

__all__ = ["GridEvaluator"]

FloatArray = NDArray[np.float64]

# Weights below this are denormals in the making: they cost much and count for nothing.
NEGLIGIBLE = 1e-12


class GridEvaluator:
    """Positions and normals of any face with K curves of M points on one uv mesh.

    The surface is linear in the data points and separates: weights along u, one small matrix
    for each distinct wave number, and Fourier waves along v. A new face costs small matrix
    products; leading axes of ``points`` are a batch.

    Args:
        shape: (K, M) of the curves.
        u: (U,) values in [0, 1].
        v: (V,) radians.
        a, modes, join, continuity: as for :class:`pdeface.pde.PDESurface`.
        side: which side of a curve its own u means, at a crease or slit.
        dtype: precision of the evaluation.
    """

    def __init__(
        self,
        shape: tuple[int, int],
        u: Any,
        v: Any,
        *,
        a: float = 1.0,
        modes: int = 6,
        join: Join = "smooth",
        continuity: Mapping[int, Continuity] | None = None,
        side: Side = "after",
        dtype: DTypeLike = np.float64,
    ) -> None:
        check_parameters(a, modes)
        check_join(shape[0], join, continuity or {})
        self.shape = shape
        self.u = np.asarray(u, dtype=np.float64)
        self.v = np.asarray(v, dtype=np.float64)
        self.dtype = np.dtype(dtype)
        w_of_mode = wave_numbers(shape[1], a, modes)
        self._groups = [np.flatnonzero(w_of_mode == w) for w in np.unique(w_of_mode)]
        distinct = np.unique(w_of_mode)
        self._along_u = {
            d: [u_weights(self.u, w, shape[0], join, continuity, side, d) for w in distinct]
            for d in (0, 1)
        }
        self._waves = {d: synthesis(shape[1], self.v, d) for d in (0, 1)}
        self._analysis = analysis(shape[1])

    def positions(self, points: Any) -> NDArray[np.floating]:
        """(..., U, V, 3) positions of the faces with (..., K, M, 3) data points."""
        return self._evaluate(self._coefficients(points), 0, 0)

    def normals(self, points: Any) -> NDArray[np.floating]:
        """(..., U, V, 3) unit outward normals."""
        return self.positions_and_normals(points)[1]

    def positions_and_normals(
        self, points: Any
    ) -> tuple[NDArray[np.floating], NDArray[np.floating]]:
        """Positions and unit outward normals, each (..., U, V, 3)."""
        c = self._coefficients(points)
        normals = unit_normal(self._evaluate(c, 1, 0), self._evaluate(c, 0, 1))
        return self._evaluate(c, 0, 0), normals.astype(self.dtype)

    def _coefficients(self, points: Any) -> FloatArray:
        points = np.asarray(points, dtype=np.float64)
        if points.shape[-3:] != (*self.shape, 3):
            raise InputError(
                f"this evaluator serves points of shape (..., {self.shape[0]}, {self.shape[1]}, "
                f"3), got {points.shape}; build one for the other level"
            )
        return np.asarray(np.einsum("cnm,...kmx->...cknx", self._analysis, points))

    def _evaluate(self, coefficients: FloatArray, du: int, dv: int) -> NDArray[np.floating]:
        along = [
            np.einsum("uk,...ckgx->...cugx", weights, coefficients[..., group, :])
            for weights, group in zip(self._along_u[du], self._groups, strict=True)
        ]
        modes = np.concatenate(along, axis=-2)
        return np.einsum("cvn,...cunx->...uvx", self._waves[dv], modes).astype(self.dtype)


def u_weights(
    u: FloatArray,
    w: float,
    count: int,
    join: Join = "smooth",
    continuity: Mapping[int, Continuity] | None = None,
    side: Side = "after",
    derivative: int = 0,
) -> FloatArray:
    """(U, K) weights of the K curves' positions in one mode of wave number w at each u."""
    interval, t = locate(u, count - 1, side)
    at_ends = hermite(w / (count - 1), t, derivative)
    of_slopes = slopes(w, count, join, continuity)[interval]
    weights = np.einsum("ue,uek->uk", at_ends[:, 2:], of_slopes)
    row = np.arange(len(u))
    weights[row, interval] += at_ends[:, 0]
    weights[row, interval + 1] += at_ends[:, 1]
    weights *= float(count - 1) ** derivative
    weights[np.abs(weights) < NEGLIGIBLE] = 0.0
    return weights
