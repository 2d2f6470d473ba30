"""What can be asked of a picture besides the face and the view."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from pdeface.controls.neck import PIVOT, rotations
from pdeface.errors import InputError
from pdeface.face import Face, Openings
from pdeface.pde import Join
from pdeface.uvmesh import FaceMesh, UVMesh

__all__ = ["FINE_MESH", "PAPER_MESH", "Options", "check_size"]

FINE_MESH: Final = (217, 241)
"""Rows and columns at which nobody sees the cells; with 28, 55 or 109 curves each of them lies on
a row, so that a crease of the surface is an edge of the mesh."""

PAPER_MESH: Final = (28, 41)
"""The uv mesh of the paper (section 2.2)."""

LARGEST: Final = 4096


@dataclass(frozen=True)
class Options:
    """How a style draws.

    Attributes:
        mesh: (rows, columns) of the uv mesh; None for the style's own choice.
        join: ``"smooth"`` or ``"patchwise"``.
        light: name of a rig in :data:`pdeface.pictures.light.RIGS`; None for the style's own.
        loops: show the closed curves, back halves included (style ``curves``).
        height: height of the picture in pixels, by which lines get their width.
        openings: ``"cut"``, or ``"none"`` for the paper's closed face.
        head: (3,) yaw, pitch and roll of the head, radians, in the styles that draw nothing but
            the uv mesh.
    """

    mesh: tuple[int, int] | None = None
    join: Join = "smooth"
    light: str | None = None
    loops: bool = False
    height: int = 1000
    openings: Openings = "cut"
    head: NDArray[np.float64] | None = None

    @property
    def is_cut(self) -> bool:
        """Whether the eyes and the mouth of a face that has them are open."""
        return self.openings == "cut" and self.join == "smooth"

    def sample(self, face: Face, otherwise: tuple[int, int] = FINE_MESH) -> FaceMesh:
        """The face on the uv mesh asked for."""
        rows, columns = self.mesh or otherwise
        mesh = face.mesh(rows, columns, join=self.join, openings=self.openings)
        return mesh if self.head is None else mesh.turned(rotations(self.head), PIVOT)

    def uv_mesh(self, face: Face, otherwise: tuple[int, int] = FINE_MESH) -> UVMesh:
        """The uv mesh of :meth:`sample`."""
        rows, columns = self.mesh or otherwise
        return face.uv_mesh(rows, columns, join=self.join, openings=self.openings)


def check_size(size: tuple[int, int]) -> tuple[int, int]:
    """(width, height) as whole numbers, or InputError."""
    try:
        width, height = (int(side) for side in size)
        whole = bool(np.all(np.asarray(size) == (width, height)))
    except (TypeError, ValueError):
        whole, width, height = False, 0, 0
    if not whole or min(width, height) < 1 or max(width, height) > LARGEST:
        raise InputError(
            f"size is (width, height), whole numbers from 1 to {LARGEST}, got {size!r}; "
            "try (800, 1000)"
        )
    return width, height
