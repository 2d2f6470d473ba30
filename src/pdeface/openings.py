"""Openings of the face in the parameter domain: where a uv mesh is cut, and how.

An opening lies between two lines over v that meet at its two corners: an eye between its lid
margins, which are apart at rest, or a mouth between its lips, which are one line at rest. A uv mesh
that has the opening moves, in every column between the corners, one node onto each line, and has no
cells between them.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

__all__ = ["SAMPLES", "Cut", "Opening", "cut_rows", "snapped"]

FloatArray = NDArray[np.float64]
IndexArray = NDArray[np.intp]

FEWEST = 5
"""Columns of an opening, its two corners among them, on the coarsest mesh that has it."""

SAMPLES = 41
"""Places at which the template gives each line of an opening."""

MERGING = 0.1
"""Of the width of an opening, from each corner: there its two sides come to move as one."""


@dataclass(frozen=True)
class Opening:
    """An opening between two lines.

    Attributes:
        name: such as ``"mouth"``.
        v: values of v, increasing, the first and the last of them its corners, radians.
        upper: u of the upper line at each v.
        lower: u of the lower line at each v; the same as the upper at the corners.
        rows: u of the curve above, to which the upper line belongs, and of the curve below.
    """

    name: str
    v: tuple[float, ...]
    upper: tuple[float, ...]
    lower: tuple[float, ...]
    rows: tuple[float, float]

    @property
    def corners(self) -> tuple[float, float]:
        """v of the two corners, radians."""
        return self.v[0], self.v[-1]

    def lines(self, v: FloatArray) -> tuple[FloatArray, FloatArray]:
        """u of the upper and of the lower line at each v between the corners."""
        return np.interp(v, self.v, self.upper), np.interp(v, self.v, self.lower)

    def slopes(self, v: FloatArray) -> tuple[FloatArray, FloatArray]:
        """du/dv of the upper and of the lower line at each v, as of smooth lines."""
        upper, lower = (np.gradient(np.array(u), self.v) for u in (self.upper, self.lower))
        return np.interp(v, self.v, upper), np.interp(v, self.v, lower)

    def apart(self, v: FloatArray) -> tuple[FloatArray, FloatArray]:
        """How far each side moves by itself at each v, 0 at the corners to 1, and d/dv of it."""
        start, end = self.corners
        reach = MERGING * (end - start)
        near = (np.minimum(v - start, end - v) / reach).clip(0.0, 1.0)
        rise = np.where(v - start < end - v, 6.0, -6.0) / reach
        return near * near * (3.0 - 2.0 * near), rise * near * (1.0 - near)

    def belonging(self, u: FloatArray, v: FloatArray, *, upper: bool) -> FloatArray:
        """u at which what parts a side is read, for places (u, v) on it.

        Between its line and its curve a side moves as the curve does; at a corner, where there is
        but one line, both move as the surface between the two curves.
        """
        above, below = self.rows
        limit = np.minimum(u, above) if upper else np.maximum(u, below)
        return np.asarray(u + self.apart(v)[0] * (limit - u))


@dataclass(frozen=True)
class Cut:
    """How a uv mesh of R rows is cut by an opening.

    Attributes:
        opening: the opening.
        first: the column of its first corner; C columns from it on have a node on each line.
        upper, lower: (C,) the rows of these nodes; one and the same at both corners.
        upper_u, lower_u: (C,) where they are moved to.
    """

    opening: Opening
    first: int
    upper: IndexArray
    lower: IndexArray
    upper_u: FloatArray
    lower_u: FloatArray

    @property
    def columns(self) -> IndexArray:
        """(C,) the columns."""
        return self.first + np.arange(len(self.upper))

    @property
    def is_open(self) -> bool:
        """Whether enough columns lie between the corners for an opening to look like one."""
        return len(self.upper) >= FEWEST


def snapped(v: FloatArray, openings: tuple[Opening, ...]) -> FloatArray:
    """The columns, those nearest to a corner of an opening moved onto it.

    A column is moved once; an opening whose corners find none of their own is left uncut, as it
    is on a uv mesh too coarse for it.
    """
    moved = v.copy()
    taken: set[int] = {0, len(v) - 1}
    for opening in openings:
        nearest = [int(np.abs(v - corner).argmin()) for corner in opening.corners]
        if nearest[1] - nearest[0] < 2 or taken & set(nearest):
            continue
        taken |= set(nearest)
        moved[nearest] = opening.corners
    return moved if (np.diff(moved) > 0.0).all() else v


def cut_rows(rows: int, v: FloatArray, opening: Opening) -> Cut | None:
    """Which nodes of a uv mesh of so many rows an opening moves, or None if it is too coarse."""
    corners = [np.flatnonzero(v == corner) for corner in opening.corners]
    if not all(len(at) for at in corners):
        return None
    first, last = int(corners[0][0]), int(corners[1][0])
    upper_u, lower_u = opening.lines(v[first : last + 1])
    upper, lower = (np.rint(u * (rows - 1)).astype(np.intp) for u in (upper_u, lower_u))
    # Two lines in one row: its node and the next are shared out between them.
    shut = upper >= lower
    upper[shut] = np.floor(upper_u[shut] * (rows - 1)).astype(np.intp)
    lower[shut] = upper[shut] + 1
    for end in (0, -1):
        upper[end] = lower[end] = int(np.rint(upper_u[end] * (rows - 1)))
    return Cut(opening, first, upper, lower, upper_u, lower_u)
