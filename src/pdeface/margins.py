"""Displacements of the margins of openings, carried by the uv mesh and faded out beside them.

Curves of a few dozen points cannot follow lids to a tenth of a millimetre. What they leave undone
along a margin, d(v), is added to the places beside it as ``d(v) (1 - x^2)^3``, where x is how far
away they lie: 0 on the margin, 1 on an arch from corner to corner and beyond it, where nothing is
added. The field is a function of (u, v), so that it is the same one on every uv mesh.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from pdeface.openings import Cut
from pdeface.uvmesh import UVMesh

__all__ = ["REACH", "MarginField"]

FloatArray = NDArray[np.float64]

REACH = 3.0 / 27.0
"""How far from the middle of a margin the field reaches, in u."""


class MarginField:
    """What displacements of margins add to the nodes of a uv mesh that is cut.

    Args:
        mesh: the uv mesh; a margin that it lacks adds nothing.

    Attributes:
        nodes: (n,) the nodes that move.
        places: (n, 2) their u and v.
    """

    def __init__(self, mesh: UVMesh) -> None:
        names = [opening.name for opening in mesh.openings]
        sides = [
            _Side(mesh, cut, names.index(cut.opening.name), upper)
            for cut in mesh.cuts
            for upper in (True, False)
        ]
        self._sides = sides
        found = [np.zeros(0, np.intp), *(side.nodes for side in sides)]
        self.nodes = np.concatenate(found)
        self.places = mesh.nodes[self.nodes]

    def displacements(self, margins: FloatArray) -> FloatArray:
        """(3, n, 3) displacement of the nodes, and its derivatives by u and by v.

        Args:
            margins: (openings, 2, samples, 3) of the upper and the lower margin of each opening.
        """
        found = [side.displacements(margins) for side in self._sides]
        return np.concatenate([np.zeros((3, 0, 3)), *found], axis=1)


class _Side:
    """The field beside one margin."""

    def __init__(self, mesh: UVMesh, cut: Cut, opening: int, upper: bool) -> None:
        which = 0 if upper else 1
        self._margin = opening, which
        columns = cut.columns[1:-1]
        v = mesh.v[columns]
        line, slope = cut.opening.lines(v)[which], cut.opening.slopes(v)[which]
        arch, arch_slope = _arch(cut, v)
        away = -1.0 if upper else 1.0
        u = mesh.nodes[:, 0].reshape(mesh.rows, mesh.columns)[:, columns]
        x = away * (u - line) / arch
        row, edge = np.arange(mesh.rows)[:, None], (cut.upper if upper else cut.lower)[1:-1]
        within = ((row <= edge) if upper else (row >= edge)) & (x < 1.0)
        rows, self._column = np.nonzero(within)
        self.nodes = rows * mesh.columns + columns[self._column]
        at, x = self._column, np.maximum(x[within], 0.0)
        fall = -6.0 * x * (1.0 - x * x) ** 2
        self._fade = np.array(
            [
                (1.0 - x * x) ** 3,
                fall * away / arch[at],
                -fall * (away * slope[at] + x * arch_slope[at]) / arch[at],
            ]
        )
        samples = np.array(cut.opening.v)
        unit = np.eye(len(samples))
        self._value, self._slope = (
            np.stack([np.interp(v, samples, each) for each in table.T], axis=1)
            for table in (unit, np.asarray(np.gradient(unit, samples, axis=0)))
        )

    def displacements(self, margins: FloatArray) -> FloatArray:
        """(3, n, 3) displacement of the side's nodes and its derivatives by u and v."""
        margin = margins[self._margin]
        value, slope = (weights @ margin for weights in (self._value, self._slope))
        field = self._fade[:, :, None] * value[self._column]
        field[2] += self._fade[0][:, None] * slope[self._column]
        return np.asarray(field)


def _arch(cut: Cut, v: FloatArray) -> tuple[FloatArray, FloatArray]:
    """How far the field reaches at each v between the corners, half an ellipse, and its slope."""
    start, end = cut.opening.corners
    across = (2.0 * v - start - end) / (end - start)
    arch = REACH * np.sqrt(1.0 - across * across)
    return arch, -(REACH**2) * across * 2.0 / ((end - start) * arch)
