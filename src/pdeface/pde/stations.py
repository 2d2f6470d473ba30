"""Stations: a few rows in each interval from which a dense uv mesh gets all its others.

Between two neighbouring curves every mode solves one smooth equation in u, so a handful of rows
determines the rest by interpolation, all modes at once, to the last bit of single precision.
A mesh of a thousand rows is then a fifth as many rows evaluated through the modes, and one
small matrix for each interval.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import DTypeLike, NDArray

from pdeface.pde.kernel import hermite
from pdeface.pde.rows import Rows

__all__ = ["Run", "Stations", "choose_stations"]

FloatArray = NDArray[np.float64]

# Interpolating a row costs about a third of evaluating it through the modes.
WORTHWHILE = 2.0

# Stations to evaluate together: enough for an efficient product, few enough for the cache.
GROUP = 48


class Run(NamedTuple):
    """The rows of one interval, and the (rows, stations) weights that interpolate them."""

    rows: slice
    stations: slice
    weights: NDArray[np.floating]


class Stations(NamedTuple):
    """The rows to evaluate, and how the others follow.

    Attributes:
        rows: the stations.
        groups: stations to evaluate together, and the runs that follow from them, whose
            stations are counted from the first of the group.
        largest_group: the most stations in a group.
    """

    rows: Rows
    groups: list[tuple[slice, list[Run]]]
    largest_group: int


def choose_stations(rows: Rows, omega: float, dtype: DTypeLike) -> Stations | None:
    """The fewest stations that lose nothing, or None where they would not pay.

    Args:
        rows: the rows of the uv mesh.
        omega: the largest wave number of a mode, times the length of an interval.
        dtype: precision that interpolation must not spoil.
    """
    runs = np.split(np.arange(len(rows.t)), np.flatnonzero(np.diff(rows.interval)) + 1)
    most = int(len(rows.t) / (WORTHWHILE * len(runs)))
    for count in range(4, most + 1):
        if _error(count, omega) < 2.0 * np.finfo(dtype).eps:
            return _stations(rows, runs, count, dtype)
    return None


def _stations(rows: Rows, runs: list[NDArray[np.intp]], count: int, dtype: DTypeLike) -> Stations:
    nodes = _nodes(count)
    together = -(-GROUP // count)
    groups = []
    for first in range(0, len(runs), together):
        members = [
            Run(
                slice(run[0], run[-1] + 1),
                slice(index * count, (index + 1) * count),
                _interpolation(nodes, rows.t[run]).astype(dtype),
            )
            for index, run in enumerate(runs[first : first + together])
        ]
        groups.append((slice(first * count, (first + len(members)) * count), members))
    interval = np.repeat([rows.interval[run[0]] for run in runs], count)
    return Stations(Rows(interval, np.tile(nodes, len(runs))), groups, together * count)


def _error(count: int, omega: float) -> float:
    """Largest error of interpolating the solutions, and their slopes, from ``count`` nodes."""
    nodes, t = _nodes(count), np.linspace(0.0, 1.0, 33)
    weights = _interpolation(nodes, t)
    return max(
        float(np.abs(weights @ hermite(omega, nodes, order) - hermite(omega, t, order)).max())
        for order in (0, 1)
    )


def _nodes(count: int) -> FloatArray:
    """Chebyshev points of the second kind in [0, 1], both ends included."""
    return np.asarray(0.5 - 0.5 * np.cos(np.arange(count) * (np.pi / (count - 1))))


def _interpolation(nodes: FloatArray, t: FloatArray) -> FloatArray:
    """(T, nodes) barycentric weights of the polynomial through Chebyshev points (Berrut and
    Trefethen 2004, equation 5.4)."""
    signs = (-1.0) ** np.arange(len(nodes))
    signs[[0, -1]] *= 0.5
    distance = t[:, None] - nodes
    hit = distance == 0.0
    weights = signs / np.where(hit, 1.0, distance)
    weights = np.where(hit.any(axis=1, keepdims=True), hit, weights)
    return np.asarray(weights / weights.sum(axis=1, keepdims=True))
