"""The four-dimensional solution space of ``(D^2 - w^2)^2 y = 0`` on one interval.

Separating the variables of equation (1) leaves this ordinary equation for every Fourier mode
(equations 3 to 5 of the paper; w = a n). The paper's basis ``e^{wt}, t e^{wt}, e^{-wt},
t e^{-wt}`` is nearly dependent for small w and overflows for large w. Two bases of the same
space that do neither, each where it is well conditioned, serve every w from 0 to 700.

Here ``t`` runs over [0, 1] and ``omega`` is w times the length of the interval.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache
from math import factorial
from typing import Any

import numpy as np
from numpy.typing import NDArray

__all__ = ["LARGEST_OMEGA", "basis", "cardinals", "hermite"]

FloatArray = NDArray[np.float64]
Condition = tuple[float, int]

# Up to here no exponential of the kernel underflows or overflows.
LARGEST_OMEGA = 700.0

# Below this the power series has converged to the last bit with SERIES_TERMS terms; above it
# the decaying exponentials are far enough from dependent.
SMALL_OMEGA = 1.0
SERIES_TERMS = 11

ENDS: tuple[Condition, ...] = ((0.0, 0), (1.0, 0), (0.0, 1), (1.0, 1))


def basis(omega: float, t: Any, derivative: int = 0) -> FloatArray:
    """Four independent solutions, or their derivatives with respect to t.

    Args:
        omega: wave number times interval length, 0 or more.
        t: (T,) positions in [0, 1].
        derivative: order, 0 or more.

    Returns:
        (T, 4) values.
    """
    t = np.asarray(t, dtype=np.float64)
    if omega <= SMALL_OMEGA:
        return np.stack([_series(omega, t, i - derivative) for i in range(4)], axis=-1)
    return np.concatenate([_decaying(omega, t, derivative), _growing(omega, t, derivative)], -1)


def _series(omega: float, t: FloatArray, order: int) -> FloatArray:
    """``sum_m (m + 1) omega^{2m} t^{2m + order} / (2m + order)!`` over powers of 0 or more.

    For order 3 this is the solution whose first three derivatives vanish at 0 and whose third
    is 1 there; each lower order is the derivative of the one above. As omega tends to 0 the
    four tend to 1, t, t^2/2, t^3/6, the cubic of equation (3).
    """
    first = max(0, (1 - order) // 2)
    square = t * t
    total = np.zeros_like(t)
    for m in reversed(range(first, first + SERIES_TERMS)):
        total = total * square + (m + 1) * omega ** (2 * m) / factorial(2 * m + order)
    return np.asarray(total * t ** (2 * first + order))


def _decaying(omega: float, t: FloatArray, derivative: int) -> FloatArray:
    """``e^{-wt}`` and ``wt e^{-wt}``, the solutions that live at t = 0."""
    x = omega * t
    scale = (-omega) ** derivative * np.exp(-x)
    return np.stack([scale, scale * (x - derivative)], axis=-1)


def _growing(omega: float, t: FloatArray, derivative: int) -> FloatArray:
    """Their reflections ``e^{-w(1-t)}`` and ``w(1-t) e^{-w(1-t)}``, which live at t = 1."""
    return _decaying(omega, 1.0 - t, derivative) * (-1.0) ** derivative


def cardinals(
    omega: float, conditions: Sequence[Condition], t: Any, derivative: int = 0
) -> FloatArray:
    """Weights of four boundary conditions in the solution that meets them.

    Args:
        omega: wave number times interval length, 0 to 700.
        conditions: four pairs (position in [0, 1], order of derivative prescribed there).
        t: (T,) positions in [0, 1].
        derivative: order of the derivative of the solution wanted.

    Returns:
        (T, 4) weights: the solution is ``weights @ prescribed``.
    """
    t = np.asarray(t, dtype=np.float64)
    weights = np.asarray(basis(omega, t, derivative) @ _solved(float(omega), tuple(conditions)))
    for index, (at, order) in enumerate(conditions):
        if order == derivative:  # met by definition: keep rounding out of it
            weights[t == at] = np.eye(4)[index]
    return weights


@lru_cache(maxsize=4096)
def _solved(omega: float, conditions: tuple[Condition, ...]) -> FloatArray:
    """(4, 4) coefficients in the basis, one column for each condition met alone."""
    system = np.stack([basis(omega, at, order) for at, order in conditions])
    # Inner conditions see both ends through exponentially small numbers; scaling each row
    # by its largest entry lets the factorisation keep their relative accuracy.
    scale = 1.0 / np.abs(system).max(axis=1)
    coefficients = np.linalg.solve(system * scale[:, None], np.diag(scale))
    coefficients.setflags(write=False)
    return coefficients


def hermite(omega: float, t: Any, derivative: int = 0) -> FloatArray:
    """(T, 4) weights of y(0), y(1), y'(0), y'(1), with ``' = d/dt``: the form in which
    Bloor and Wilson blend, and in which every join of this package is evaluated."""
    return cardinals(omega, ENDS, t, derivative)
