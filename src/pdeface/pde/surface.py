"""The PDE surface through closed curves, evaluated anywhere."""

from __future__ import annotations

import copy
from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pdeface.errors import InputError
from pdeface.pde import differential
from pdeface.pde.fourier import analysis, synthesis, wave_numbers
from pdeface.pde.joins import Continuity, Join, check_join, slopes
from pdeface.pde.kernel import hermite
from pdeface.pde.rows import Side, locate

__all__ = ["PDESurface", "Side", "check_parameters"]

FloatArray = NDArray[np.float64]

# Scattered points are evaluated in slices, so that memory does not grow with their number.
SLICE = 4096


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
        >>> np.round(cylinder(1 / 3, np.pi / 2), 6)
        array([0., 1., 1.])
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
        self._prepare(points, a, modes, continuity or {})
        for w, group in self._groups:
            weights = slopes(w, len(points), join, continuity)
            self._ends[:, 2:, :, group] = np.tensordot(weights, self._values[:, :, group], axes=1)

    @classmethod
    def blend(cls, points: Any, derivatives: Any, *, a: float = 1.0, modes: int = 6) -> PDESurface:
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
        surface._prepare(points, a, modes, {})
        surface._ends[0, 2:] = _coefficients(derivatives)
        return surface

    def _prepare(
        self, points: FloatArray, a: float, modes: int, continuity: Mapping[int, Continuity]
    ) -> None:
        """Take the Fourier coefficients of the curves; leave the slopes to the join."""
        check_parameters(a, modes)
        self._shape = points.shape[:2]
        self._continuity = dict(continuity)
        # Indices: curve; cosine or sine, mode, coordinate.
        self._values = _coefficients(points)
        # Indices: interval; value and value, slope and slope at its two ends; as before.
        self._ends = np.zeros((len(points) - 1, 4, *self._values.shape[1:]))
        self._ends[:, 0] = self._values[:-1]
        self._ends[:, 1] = self._values[1:]
        w_of_mode = wave_numbers(points.shape[1], a, modes)
        self._groups = [(float(w), np.flatnonzero(w_of_mode == w)) for w in np.unique(w_of_mode)]

    def __add__(self, other: PDESurface) -> PDESurface:
        """The sum of two surfaces through as many curves of as many points: a displaced surface.

        Each keeps its own continuity, so that a displacement may part where the face does not.

        Raises:
            InputError: other shapes or parameters.
        """
        if not isinstance(other, PDESurface):
            return NotImplemented
        mine, theirs = ((*s._shape, *(w for w, _ in s._groups)) for s in (self, other))
        if mine != theirs:
            raise InputError(
                "surfaces can be added if their curves, points, a and modes agree, got "
                f"{self._shape} and {other._shape}; make both with the same parameters"
            )
        total = copy.copy(self)
        total._values = self._values + other._values
        total._ends = self._ends + other._ends
        total._continuity = {**self._continuity, **other._continuity}
        return total

    def __call__(self, u: Any, v: Any, *, side: Side = "after") -> FloatArray:
        """Positions S(u, v), metres.

        Args:
            u: values in [0, 1], any shape that broadcasts with v.
            v: radians, any value (period 2 pi).
            side: which side of a curve its own u means, at a crease.

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
        interval, t = locate(u.ravel(), self._shape[0], side, self._continuity)
        flat_v = v.ravel()
        result = np.empty((u.size, 3))
        for start in range(0, u.size, SLICE):
            part = slice(start, start + SLICE)
            result[part] = self._evaluate(interval[part], t[part], flat_v[part], du, dv)
        return result.reshape(*u.shape, 3)

    def _evaluate(
        self, interval: NDArray[np.intp], t: FloatArray, v: FloatArray, du: int, dv: int
    ) -> FloatArray:
        """One weight for each end, cosine or sine and mode; then one product an interval."""
        curves, count = self._shape
        waves = synthesis(count, v, dv).transpose(1, 0, 2)
        at_ends = np.empty((len(t), 4, 1, waves.shape[2]))
        for w, group in self._groups:
            weights = hermite(w / (curves - 1), t, du) * float(curves - 1) ** du
            at_ends[:, :, 0, group] = weights[..., None]
        features = (at_ends * waves[:, None]).reshape(len(t), -1)
        ends = self._ends.reshape(curves - 1, -1, 3)
        result = np.empty((len(t), 3))
        for each in np.unique(interval):
            inside = interval == each
            result[inside] = features[inside] @ ends[each]
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


def _coefficients(curves: FloatArray) -> FloatArray:
    """(curves, 2, modes, 3) cosine and sine coefficients of (curves, M, 3) points."""
    waves = analysis(curves.shape[1])
    flat = waves.reshape(-1, curves.shape[1]) @ curves
    return np.asarray(flat.reshape(len(curves), *waves.shape[:2], 3))


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
