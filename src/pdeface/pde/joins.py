"""How the intervals between neighbouring curves are joined: slopes from positions.

Between two neighbouring curves every mode solves its own equation and is fixed by two positions
and two slopes (:func:`pdeface.pde.kernel.hermite`). A *join* supplies the slopes, linearly, from
the positions of all curves. That is the only place where one join differs from another.

``patchwise`` is the paper's: four consecutive curves are the boundary conditions of one patch,
and patches share a curve but no tangent. ``smooth`` asks for continuous first and second
derivatives at every inner curve and ``y'' - w^2 y = 0`` at the two ends, which makes it the
minimiser of the integral of ``(y'' - w^2 y)^2`` (an exponential spline; for w = 0 the natural
cubic spline). A curve can be taken out of that continuity: see :data:`Continuity`.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from functools import lru_cache
from itertools import pairwise
from typing import Literal, get_args

import numpy as np
from numpy.typing import NDArray

from pdeface.errors import InputError
from pdeface.pde.kernel import LARGEST_OMEGA, cardinals, hermite

__all__ = ["Continuity", "Join", "check_join", "slopes"]

FloatArray = NDArray[np.float64]

Join = Literal["smooth", "patchwise"]

Continuity = Literal["C2", "crease", "slit"]
"""What happens at an inner curve of a smooth join. ``C2``: nothing, the default. ``crease``: the
surface stays in one piece and its tangent may break. ``slit``: the surface parts between this
curve and the next. Each side of a crease or slit is a spline of its own with free ends; the strip
of a slit belongs to neither side and is spanned by its two curves alone."""

PATCH: tuple[tuple[float, int], ...] = ((0.0, 0), (1 / 3, 0), (2 / 3, 0), (1.0, 0))


def check_join(count: int, join: Join, continuity: Mapping[int, Continuity]) -> None:
    """Refuse a join that ``count`` curves cannot have.

    Raises:
        InputError: an unknown join or continuity, a count that does not divide into patches,
            or a continuity at a curve that is not an inner one.
    """
    if join not in get_args(Join):
        raise InputError(f"join must be 'smooth' or 'patchwise', got {join!r}")
    if join == "patchwise" and (count < 4 or count % 3 != 1):
        raise InputError(
            f"the patchwise join needs 3p + 1 curves (4, 7, ..., 28, ...), got {count}; "
            "use join='smooth' or another level"
        )
    if join == "patchwise" and continuity:
        raise InputError("continuity can be chosen for the smooth join only; use join='smooth'")
    for curve, kind in continuity.items():
        if kind not in get_args(Continuity):
            raise InputError(
                f"continuity at a curve must be 'C2', 'crease' or 'slit', got {kind!r} at "
                f"curve {curve!r}"
            )
        if not isinstance(curve, int | np.integer) or not 1 <= curve <= count - 2:
            raise InputError(
                f"continuity can be chosen at the inner curves, 1 to {count - 2} of {count}, "
                f"got curve {curve!r}; leave it out"
            )


def slopes(
    w: float, count: int, join: Join = "smooth", continuity: Mapping[int, Continuity] | None = None
) -> FloatArray:
    """Slopes at both ends of every interval, as weights of the curves' positions.

    Args:
        w: wave number in u, 0 or more; curve k lies at ``u = k / (count - 1)``.
        count: number of curves K.
        join: ``"smooth"`` or ``"patchwise"``.
        continuity: what departs from C2, by curve; smooth join only.

    Returns:
        (K - 1, 2, K) weights, read-only, of the slopes d/dt at t = 0 and t = 1 of each
        interval, with t running from 0 to 1 over it.

    Raises:
        InputError: a patch in which the solution exceeds every floating-point number.
    """
    if join == "patchwise":
        return _patchwise(w, count)
    return _smooth(w, count, tuple(_pieces(count, continuity or {})))


@lru_cache(maxsize=256)
def _patchwise(w: float, count: int) -> FloatArray:
    """Four consecutive curves bound each patch, whose first and last its neighbours share."""
    omega = 3.0 * w / (count - 1)
    if omega > LARGEST_OMEGA:
        raise InputError(
            f"a patch must have a wave number of at most {LARGEST_OMEGA:g}, got {omega:g} with "
            f"{count} curves; lower a or modes, or use join='smooth'"
        )
    at_curves = cardinals(omega, PATCH, np.arange(4) / 3.0, derivative=1) / 3.0
    result = np.zeros((count - 1, 2, count))
    for first in range(0, count - 1, 3):
        result[first : first + 3, 0, first : first + 4] = at_curves[:-1]
        result[first : first + 3, 1, first : first + 4] = at_curves[1:]
    result.setflags(write=False)
    return result


@lru_cache(maxsize=256)
def _smooth(w: float, count: int, pieces: tuple[tuple[int, int], ...]) -> FloatArray:
    """A spline through the curves of each piece."""
    result = np.zeros((count - 1, 2, count))
    for first, last in pieces:
        at_curves = _spline_slopes(w / (count - 1), last - first + 1)
        result[first:last, 0, first : last + 1] = at_curves[:-1]
        result[first:last, 1, first : last + 1] = at_curves[1:]
    result.setflags(write=False)
    return result


def _pieces(count: int, continuity: Mapping[int, Continuity]) -> Iterator[tuple[int, int]]:
    """First and last curve of every spline."""
    breaks = {curve for curve, kind in continuity.items() if kind != "C2"}
    breaks |= {curve + 1 for curve, kind in continuity.items() if kind == "slit"}
    ends = [0, *sorted(breaks - {count - 1}), count - 1]
    yield from pairwise(ends)


def _spline_slopes(omega: float, count: int) -> FloatArray:
    """(count, count) slopes at the curves of one C2 spline, as weights of its positions."""
    start, end = hermite(omega, np.array([0.0, 1.0]), derivative=2)
    of_slopes = np.zeros((count, count))
    of_positions = np.zeros((count, count))
    for k in range(count - 1):  # y'' arriving at curve k + 1 and leaving curve k
        of_slopes[k + 1, k : k + 2] += end[2:]
        of_positions[k + 1, k : k + 2] -= end[:2]
        of_slopes[k, k : k + 2] -= start[2:]
        of_positions[k, k : k + 2] += start[:2]
    # The two ends have one side only, where y'' = w^2 y.
    of_positions[0, 0] -= omega**2
    of_positions[-1, -1] += omega**2
    return np.asarray(np.linalg.solve(of_slopes, of_positions), dtype=np.float64)
