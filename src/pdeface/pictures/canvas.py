"""Solids to an anti-aliased picture, by whichever rasteriser there is."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import cache
from typing import Final

import numpy as np
from numpy.typing import NDArray

from pdeface.pictures import raster_numpy, raster_vtk
from pdeface.pictures.camera import Camera
from pdeface.pictures.solid import Solid

__all__ = ["picture_of"]

Draw = Callable[[Sequence[Solid], Camera, tuple[int, int]], NDArray[np.uint8]]

SUPERSAMPLING: Final = 2
"""Samples a pixel along each axis; PyVista takes four more within each."""


def picture_of(
    solids: Sequence[Solid], camera: Camera, size: tuple[int, int]
) -> NDArray[np.float32]:
    """(H, W, 4) premultiplied red, green, blue and coverage, 0 to 1, anti-aliased."""
    width, height = size
    fine = _rasteriser()(solids, camera, (width * SUPERSAMPLING, height * SUPERSAMPLING))
    total = np.zeros((height, width, 4), np.uint16)
    for row, column in np.ndindex(SUPERSAMPLING, SUPERSAMPLING):
        total += fine[row::SUPERSAMPLING, column::SUPERSAMPLING]
    return total * np.float32(1.0 / (255.0 * SUPERSAMPLING**2))


@cache
def _rasteriser() -> Draw:
    """PyVista where it can draw, set up once for all pictures; numpy elsewhere."""
    return raster_vtk.Canvas().draw if raster_vtk.available() else raster_numpy.draw
