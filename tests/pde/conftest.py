"""An oracle: the same boundary-value problems in high precision, in the paper's own basis."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from types import SimpleNamespace
from typing import Any

import mpmath
import numpy as np
import pytest
from mpmath import mp

Solution = Callable[[Any, int], Any]


@pytest.fixture(scope="session")
def oracle() -> SimpleNamespace:
    """Functions that solve in mpmath what pdeface.pde solves in double precision."""
    return SimpleNamespace(solve=solve, spline=spline, patches=patches, digits=digits)


@pytest.fixture
def rng() -> np.random.Generator:
    return np.random.default_rng(20080115)


def digits(w: float) -> int:
    """Decimal digits that leave 50 after the cancellations of the paper's basis."""
    return 90 + int(w)


def paper_basis(w: Any) -> list[Solution]:
    """The four solutions of equations (3) to (5), with derivatives of any order."""
    if w == 0:
        return [
            lambda t, d, i=i: mpmath.ff(i, d) * t ** (i - d) if i >= d else mp.zero
            for i in range(4)
        ]

    def grown(sign: int) -> Solution:
        return lambda t, d: (sign * w) ** d * mp.exp(sign * w * t)

    def t_times(sign: int) -> Solution:
        return lambda t, d: (
            ((sign * w * t + d) * (sign * w) ** (d - 1) if d else t) * mp.exp(sign * w * t)
        )

    return [grown(1), t_times(1), grown(-1), t_times(-1)]


def _combined(basis: list[Solution], coefficients: Any) -> Solution:
    return lambda t, d=0: mpmath.fdot(
        (c, function(t, d)) for c, function in zip(coefficients, basis, strict=True)
    )


def solve(w: Any, conditions: Sequence[tuple[Any, int]], values: Sequence[Any]) -> Solution:
    """Solution y(t, derivative) of (D^2 - w^2)^2 y = 0 with four prescribed values."""
    basis = paper_basis(w)
    system = mpmath.matrix([[f(mp.mpf(at), order) for f in basis] for at, order in conditions])
    return _combined(basis, mpmath.lu_solve(system, mpmath.matrix(values)))


def patches(w: Any, values: Sequence[Any]) -> Solution:
    """Four position curves a patch: y(u, derivative) on [0, 1], from after at a curve."""
    intervals = len(values) - 1
    own = [
        solve(w, [(mp.mpf(first + i) / intervals, 0) for i in range(4)], values[first : first + 4])
        for first in range(0, intervals, 3)
    ]
    return lambda u, d=0: own[min(int(mp.floor(u * intervals)) // 3, len(own) - 1)](u, d)


def spline(w: Any, values: Sequence[Any], continuity: Mapping[int, str] | None = None) -> Solution:
    """The smooth join, one dense system of 4 (K - 1) equations; creases and slits included."""
    continuity = continuity or {}
    intervals = len(values) - 1
    omega = w / intervals
    basis = paper_basis(omega)
    system, right = mpmath.zeros(4 * intervals), mpmath.zeros(4 * intervals, 1)
    row = 0

    def equation(terms: Sequence[tuple[int, Any, Callable[[Solution], Any]]], value: Any) -> None:
        nonlocal row
        for interval, factor, of in terms:
            for column, function in enumerate(basis):
                system[row, 4 * interval + column] += factor * of(function)
        right[row] = value
        row += 1

    def at(t: int, order: int) -> Callable[[Solution], Any]:
        return lambda f: f(mp.mpf(t), order)

    def free(t: int) -> Callable[[Solution], Any]:
        return lambda f: f(mp.mpf(t), 2) - omega**2 * f(mp.mpf(t), 0)

    slits = {
        curve + edge for curve, kind in continuity.items() if kind == "slit" for edge in (0, 1)
    }
    for i in range(intervals):
        equation([(i, 1, at(0, 0))], values[i])
        equation([(i, 1, at(1, 0))], values[i + 1])
    for curve in range(intervals + 1):
        before, after = curve - 1, curve
        if curve == 0:
            equation([(after, 1, free(0))], 0)
        elif curve == intervals:
            equation([(before, 1, free(1))], 0)
        elif curve in slits or continuity.get(curve) == "crease":
            equation([(before, 1, free(1))], 0)
            equation([(after, 1, free(0))], 0)
        else:
            equation([(before, 1, at(1, 1)), (after, -1, at(0, 1))], 0)
            equation([(before, 1, at(1, 2)), (after, -1, at(0, 2))], 0)
    coefficients = mpmath.lu_solve(system, right)
    pieces = [_combined(basis, coefficients[4 * i : 4 * i + 4]) for i in range(intervals)]

    def evaluate(u: Any, d: int = 0) -> Any:
        interval = min(int(mp.floor(u * intervals)), intervals - 1)
        return pieces[interval](u * intervals - interval, d) * intervals**d

    return evaluate
