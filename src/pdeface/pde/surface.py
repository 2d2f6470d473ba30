"""The PDE surface through closed curves, evaluated anywhere."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from pdeface.errors import InputError
from pdeface.pde import differential
from pdeface.pde.fourier import analysis, synthesis, wave_numbers
from pdeface.pde.joins import Continuity, Join, check_join, slopes
from pdeface.pde.kernel import hermite

__all__ = ["PDESurface", "Side", "check_parameters"]

FloatArray = NDArray[np.float64]

Side = Literal["before", "after"]
"""From which side a curve's own u is approached, where a crease or a slit makes a difference."""

# Scattered points are evaluated in slices, so that memory does not grow with their number.
SLICE = 8192


def check_parameters(a: float, modes: int) -> None:
    """Refuse parameters for which equation (1) is not the paper's.

    Raises:
        InputError: a below 1 or not finite, or a negative number of modes.
    """
    if not (np.isfinite(a) and a >= 1.0):
        raise InputError(f"a must be a number >= 1 (equation 1), got {a}")
    if int(modes) != modes or modes < 0:
        raise InputError(f"modes must be a whole number >= 0 (equation 6), got {modes}")


class PDESurface:
    """Solution S(u, v) of equation (1), ``(d^2/du^2 + a^2 d^2/dv^2)^2 S = 0``, between curves.

    Curve k lies at ``u = k / (K - 1)``; v runs round the closed curves with period 2 pi. The
    surface passes through every data point and is linear in them.

    Args:
        points: (K, M, 3) data points, point j of a curve at ``v = (j + 1/2) 2 pi / M``.
        a: relative rate of smoothing between u and v, 1 or more (equation 1).
        modes: N, the Fourier modes solved one by one; the rest is the remainder (equation 6).
        join: ``"smooth"`` (C2) or ``"patchwise"`` (the paper's, K = 3p + 1).
        continuity: inner curves that are a ``"crease"`` or a ``"slit"``; smooth join only.

    Raises:
        InputError: shapes or parameters that no such surface has.

    Example:
        >>> import numpy as np
        >>> v = (np.arange(8) + 0.5) * 2 * np.pi / 8
        >>> rings = [np.stack([np.cos(v), 0 * v + h, np.sin(v)], -1) for h in (0, 1, 2, 3)]
        >>> cylinder = PDESurface(rings)
        >>> np.round(cylinder(0.5, 0.0), 6)
        array([1. , 1.5, 0. ])
    """

    def __init__(
        self,
        points: Any,
        *,
        a: float = 1.0,
        modes: int = 6,
        join: Join = "smooth",
        continuity: Mapping[int, Continuity] | None = None,
    ) -> None:
        points = _checked(points, "points")
        check_join(len(points), join, continuity or {})
        self._prepare(points, a, modes)
        for w, group in self._groups:
            weights = slopes(w, len(points), join, continuity)
            self._slopes[..., group, :] = np.einsum(
                "ies,csgx->ecigx", weights, self._values[:, :, group]
            )

    @classmethod
    def blend(
        cls, points: Any, derivatives: Any, *, a: float = 1.0, modes: int = 6
    ) -> PDESurface:
        """Bloor and Wilson's boundary conditions: two curves of position, two of derivative.

        Args:
            points: (2, M, 3) the curves at u = 0 and u = 1.
            derivatives: (2, M, 3) the curves of dS/du there.
            a, modes: as for :class:`PDESurface`.
        """
        points = _checked(points, "points")
        derivatives = _checked(derivatives, "derivatives")
        if len(points) != 2 or points.shape != derivatives.shape:
            raise InputError(
                "a blend needs two curves of position and two of derivative of the same size, "
                f"got {points.shape} and {derivatives.shape}"
            )
        surface = cls.__new__(cls)
        surface._prepare(points, a, modes)
        waves = analysis(points.shape[1])
        surface._slopes[:, :, 0] = np.einsum("cnm,emx->ecnx", waves, derivatives)
        return surface

    def _prepare(self, points: FloatArray, a: float, modes: int) -> None:
        """Take the Fourier coefficients of the curves; leave the slopes to the join."""
        check_parameters(a, modes)
        self._count = points.shape[1]
        waves = analysis(self._count)
        # Indices: cosine or sine, curve, mode, coordinate; end of the interval before them.
        self._values = np.einsum("cnm,kmx->cknx", waves, points)
        self._slopes = np.zeros((2, 2, len(points) - 1, *self._values.shape[2:]))
        w_of_mode = wave_numbers(self._count, a, modes)
        self._groups = [(float(w), np.flatnonzero(w_of_mode == w)) for w in np.unique(w_of_mode)]

    def __call__(self, u: Any, v: Any, *, side: Side = "after") -> FloatArray:
        """Positions S(u, v), metres.

        Args:
            u: values in [0, 1], any shape that broadcasts with v.
            v: radians, any value (period 2 pi).
            side: which side of a curve its own u means, at a crease or slit.

        Returns:
            (..., 3) positions.
        """
        return self.derivative(u, v, 0, 0, side=side)

    def derivative(
        self, u: Any, v: Any, du: int = 0, dv: int = 0, *, side: Side = "after"
    ) -> FloatArray:
        """The partial derivative of order ``du`` in u and ``dv`` in v, in closed form.

        Raises:
            InputError: u outside [0, 1], numbers that are not finite, or a negative order.
        """
        if du < 0 or dv < 0:
            raise InputError(f"orders of derivative must be 0 or more, got du={du}, dv={dv}")
        u, v = np.broadcast_arrays(_finite(u, "u"), _finite(v, "v"))
        if u.size and (u.min() < 0.0 or u.max() > 1.0):
            raise InputError(f"u must lie in [0, 1], got {u.min():g} to {u.max():g}")
        result = np.empty((u.size, 3))
        flat_u, flat_v = u.ravel(), v.ravel()
        for start in range(0, u.size, SLICE):
            part = slice(start, start + SLICE)
            result[part] = self._evaluate(flat_u[part], flat_v[part], du, dv, side)
        return result.reshape(*u.shape, 3)

    def _evaluate(
        self, u: FloatArray, v: FloatArray, du: int, dv: int, side: Side
    ) -> FloatArray:
        intervals = self._slopes.shape[2]
        interval, t = locate(u, intervals, side)
        waves = synthesis(self._count, v, dv)
        result = np.zeros((u.size, 3))
        for w, group in self._groups:
            weights = hermite(w / intervals, t, du) * float(intervals) ** du
            ends = (
                self._values[:, interval][:, :, group],
                self._values[:, interval + 1][:, :, group],
                self._slopes[0][:, interval][:, :, group],
                self._slopes[1][:, interval][:, :, group],
            )
            for weight, end in zip(weights.T, ends, strict=True):
                result += weight[:, None] * np.einsum("cpg,cpgx->px", waves[:, :, group], end)
        return result

    def normal(self, u: Any, v: Any, *, side: Side = "after") -> FloatArray:
        """(..., 3) unit outward normals, exact."""
        s_u, s_v = (self.derivative(u, v, *order, side=side) for order in ((1, 0), (0, 1)))
        return differential.unit_normal(s_u, s_v)

    def curvature(self, u: Any, v: Any, *, side: Side = "after") -> differential.Curvature:
        """Gaussian and mean curvature, exact; the mean is positive where the face bulges."""
        orders = ((1, 0), (0, 1), (2, 0), (1, 1), (0, 2))
        return differential.curvature(
            *(self.derivative(u, v, *order, side=side) for order in orders)
        )


def locate(u: FloatArray, intervals: int, side: Side) -> tuple[NDArray[np.intp], FloatArray]:
    """Interval of each u and the position in [0, 1] within it."""
    scaled = u * intervals
    nearest = np.rint(scaled)
    # u = k / (K - 1) rounds to either side of curve k; it shall mean the curve.
    scaled = np.where(np.abs(scaled - nearest) < 1e-12 * intervals, nearest, scaled)
    index = np.ceil(scaled) - 1 if side == "before" else np.floor(scaled)
    interval = np.clip(index, 0, intervals - 1).astype(np.intp)
    return interval, scaled - interval


def _finite(values: Any, name: str) -> FloatArray:
    array = np.asarray(values, dtype=np.float64)
    if not np.isfinite(array).all():
        raise InputError(f"{name} must be finite numbers, got NaN or infinity")
    return array


def _checked(points: Any, name: str) -> FloatArray:
    array = _finite(points, name)
    if array.ndim != 3 or array.shape[0] < 2 or array.shape[1] < 3 or array.shape[2] != 3:
        raise InputError(
            f"{name} must have the shape (curves >= 2, points >= 3, 3), got {array.shape}"
        )
    return array
