"""Where lids and lips meet: how far apart they are, and displacements that bring them together.

Expressions are added, and what lids and lips do when several are added is nobody's measurement. The
gap between the two sides of an opening is linear in the data points, and so is the correction that
gives it the size it should have.
"""

from __future__ import annotations

from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pdeface.controls.measured import slits
from pdeface.curves import curve_parameters, mirror_points
from pdeface.openings import Opening
from pdeface.pde import PDESurface
from pdeface.pde.scattered import point_weights
from pdeface.template import neutral_curves, openings
from pdeface.template.layout import PAPER_ROWS

__all__ = ["Seam", "nearest", "seam"]

FloatArray = NDArray[np.float64]

REACH = {"right_eye": 4.0, "left_eye": 4.0, "mouth": 5.0}
"""Rows of the paper over which a correction of a side fades out."""

DAMPING = 0.3
"""Of the data points that are corrected: a correction does not ring."""

WIDTH, OUTSIDE = 2.0, 10
"""How far beyond each corner data points are corrected, in points, and at how many places there
they are asked to do nothing."""


class Seam:
    """The two sides of an opening, on faces of one size.

    Args:
        opening: the opening.
        size: (K, M) of the curves.
        a, modes: as for :class:`pdeface.pde.PDESurface`.
    """

    def __init__(self, opening: Opening, size: tuple[int, int], a: float, modes: int) -> None:
        v = np.array(opening.v)
        options: dict[str, Any] = {"a": a, "modes": modes}
        parting = slits(size[0])
        lines = np.array(opening.upper), np.array(opening.lower)
        on_curves = [
            opening.belonging(line, v, upper=upper)
            for line, upper in zip(lines, (True, False), strict=True)
        ]
        upper, lower = (
            (
                point_weights(size, line, v, **options),
                point_weights(size, curve, v, continuity=parting, **options),
            )
            for line, curve in zip(lines, on_curves, strict=True)
        )
        self._weights = upper, lower
        self._meeting = _meeting(opening)
        self._half = size[0], size[1] // 2
        row = np.linspace(0.0, PAPER_ROWS - 1.0, size[0])
        above, below = (u * (PAPER_ROWS - 1.0) for u in opening.rows)
        reach = REACH[opening.name]
        self._fades = [
            np.where(away >= -1e-9, (1.0 - (away / reach).clip(0.0, 1.0) ** 2) ** 3, 0.0)
            for away in (above - row, row - below)
        ]
        at = curve_parameters(size[1])[: size[1] // 2]
        beside = np.linspace(0.0, WIDTH, OUTSIDE + 1)[1:] * (at[1] - at[0])
        places = np.concatenate([v, v[0] - beside, v[-1] + beside])
        near = (at > places.min()) & (at < places.max())
        importance = _importance(v, len(places))
        self._solve = []
        for u, fade in zip(opening.rows, self._fades, strict=True):
            curve = np.full(len(places), u)
            weights = point_weights(size, curve, places, continuity=parting, **options)
            line = np.einsum("nkm,k->nm", weights.reshape(-1, *size), fade)
            solution = _solution(line, near, importance)
            self._solve.append(solution[:, :, : len(v)] * opening.apart(v)[0])

    def lines(self, smooth: FloatArray, parting: FloatArray) -> tuple[FloatArray, FloatArray]:
        """(n, 3) places on the upper and the lower side, of points and parting displacements."""
        flat = smooth.reshape(-1, 3), parting.reshape(-1, 3)
        upper, lower = (of[0] @ flat[0] + of[1] @ flat[1] for of in self._weights)
        return upper, lower

    def gap(self, smooth: FloatArray, parting: FloatArray) -> FloatArray:
        """(n, 3) the upper less the lower side."""
        upper, lower = self.lines(smooth, parting)
        return np.asarray(upper - lower)

    def meeting(self, lower: FloatArray) -> FloatArray:
        """(n, 3) where the two sides meet: on the lower one, that both are shut along.

        At one v the two sides lie across from each other only roughly. They meet half-way along
        the lower one between its own place and the one as far across the opening as the upper's.
        """
        return self._meeting @ lower

    def moved(self, upper: FloatArray, lower: FloatArray) -> FloatArray:
        """(K, M, 3) parting displacement that moves the two sides by (n, 3) each, as well as
        curves can; beyond the corners, where the sides are one, it does nothing."""
        half = np.zeros((*self._half, 3))
        for change, fade, solve in zip((upper, lower), self._fades, self._solve, strict=True):
            half += fade[:, None, None] * np.einsum("cvn,nc->vc", solve, change)
        return mirror_points(half)


def _importance(v: FloatArray, places: int) -> FloatArray:
    """(places, 1) of each place: columns crowd at corners, where next to nothing is to change."""
    importance = np.ones((places, 1))
    importance[: len(v), 0] = np.sqrt(np.gradient(v) / np.gradient(v).mean())
    return importance


def _solution(line: FloatArray, near: NDArray[np.bool_], importance: FloatArray) -> FloatArray:
    """(3, M/2, n) weights of the change wanted at n places on a curve, in x, y and z, in the data
    points of half a curve whose fading displacement makes it."""
    half = line.shape[1] // 2
    front, back = line[:, :half] * near, line[:, half:][:, ::-1] * near
    even, odd = (_least_squares(front + sign * back, importance) for sign in (1.0, -1.0))
    # Of the mirrored back half, x and y go with those of the front and z goes against it.
    return np.stack([even, even, odd])


def _least_squares(system: FloatArray, importance: FloatArray) -> FloatArray:
    damped = np.concatenate([importance * system, DAMPING * np.eye(system.shape[1])])
    return np.asarray(np.linalg.pinv(damped)[:, : len(system)] * importance.T)


def _meeting(opening: Opening) -> FloatArray:
    """(n, n) weights of the places of the lower line where the two sides of an opening meet."""
    surface, v = PDESurface(neutral_curves().points), np.array(opening.v)
    upper, lower = (_along(surface(np.array(u), v)) for u in (opening.upper, opening.lower))
    across_from = np.interp(upper, lower, v)
    return np.stack([np.interp(0.5 * (v + across_from), v, row) for row in np.eye(len(v))], axis=1)


def _along(line: FloatArray) -> FloatArray:
    """(n,) how far along a line each of its (n, 3) places lies, 0 to 1."""
    length = np.cumsum(np.linalg.norm(np.diff(line, axis=0), axis=1))
    return np.concatenate([[0.0], length / length[-1]])


def nearest(line: FloatArray, places: FloatArray) -> FloatArray:
    """(n, 3) the place on a line of segments nearest to each of (n, 3) places."""
    start, along = line[:-1], np.diff(line, axis=0)
    away = places[:, None] - start
    t = np.einsum("nsi,si->ns", away, along) / np.einsum("si,si->s", along, along)
    foot = start + t.clip(0.0, 1.0)[..., None] * along
    best = np.linalg.norm(foot - places[:, None], axis=2).argmin(axis=1)
    return np.asarray(foot[np.arange(len(places)), best])


@lru_cache(maxsize=16)
def seam(name: str, size: tuple[int, int], a: float = 1.0, modes: int = 6) -> Seam:
    """The seam of a named opening, kept for the next face."""
    (opening,) = (opening for opening in openings() if opening.name == name)
    return Seam(opening, size, a, modes)
