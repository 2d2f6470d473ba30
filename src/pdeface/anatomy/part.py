"""What a part is: named closed curves that move linearly, a material and a uv mesh."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property, lru_cache
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from pdeface.errors import InputError
from pdeface.pde import GridEvaluator, PDESurface
from pdeface.uvmesh import UVMesh

__all__ = ["PARTS", "Part", "part"]

FloatArray = NDArray[np.float64]


@dataclass(frozen=True)
class Part:
    """A part of the anatomy: one PDE surface through a few closed curves.

    Attributes:
        name: such as ``"left_eyeball"``.
        material: ``"eye"``, ``"lids"``, ``"mouth"``, ``"teeth"`` or ``"tongue"``.
        shape: (K, M), curves and points on each.
        rows, columns: samples along u in [0, 1] and along v in [0, 2 pi], both ends included, so
            that the last column lies on the first and a texture closes without a seam.
    """

    name: str
    material: str
    shape: tuple[int, int]
    rows: int
    columns: int

    @cached_property
    def grid(self) -> UVMesh:
        """The uv mesh; its v, which ends at pi, stands for half of the part's."""
        return UVMesh(self.rows, self.columns)

    def surface(self, curves: FloatArray) -> PDESurface:
        """The PDE surface through (K, M, 3) curves, smooth everywhere."""
        return PDESurface(curves)

    def positions(self, curves: FloatArray) -> FloatArray:
        """(..., rows columns, 3) vertices through (..., K, M, 3) curves, or displacements."""
        positions = _evaluator(self).positions(curves)
        return positions.astype(np.float64, order="C").reshape(*curves.shape[:-3], -1, 3)

    def normals(self, curves: FloatArray) -> FloatArray:
        """(..., rows columns, 3) unit normals on the side that is seen."""
        normals = _evaluator(self).normals(curves)
        return normals.astype(np.float64, order="C").reshape(*curves.shape[:-3], -1, 3)


@lru_cache(maxsize=32)
def _evaluator(part: Part) -> GridEvaluator:
    return GridEvaluator(part.shape, part.grid.u, 2.0 * part.grid.v)


PARTS: Mapping[str, Part] = MappingProxyType(
    {
        each.name: each
        for each in (
            Part("right_eyeball", "eye", (16, 16), 33, 49),
            Part("left_eyeball", "eye", (16, 16), 33, 49),
            Part("right_lids", "lids", (5, 64), 9, 97),
            Part("left_lids", "lids", (5, 64), 9, 97),
            Part("mouth", "mouth", (10, 64), 37, 97),
            Part("upper_teeth", "teeth", (29, 20), 113, 25),
            Part("lower_teeth", "teeth", (29, 20), 113, 25),
            Part("tongue", "tongue", (12, 20), 34, 33),
        )
    }
)
"""Every part by name."""


def part(name: str) -> Part:
    """The part of that name.

    Raises:
        InputError: there is none.
    """
    if name not in PARTS:
        raise InputError(f"no part is called {name!r}; the parts are {', '.join(PARTS)}")
    return PARTS[name]
