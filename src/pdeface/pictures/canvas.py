"""Solids to an anti-aliased picture, by whichever rasteriser there is."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import cache
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from pdeface.pictures import raster_numpy, raster_vtk
from pdeface.pictures.camera import Camera
from pdeface.pictures.solid import Solid

__all__ = ["picture_of"]

FloatArray = NDArray[np.floating[Any]]

Draw = Callable[[Sequence[Solid], Camera, tuple[int, int]], FloatArray]

SUPERSAMPLING: Final = 2
"""Samples a pixel along each axis; PyVista takes four more within each."""


def picture_of(solids: Sequence[Solid], camera: Camera, size: tuple[int, int]) -> FloatArray:
    """(H, W, 4) premultiplied red, green, blue and coverage, 0 to 1, anti-aliased."""
    width, height = size
    fine = _rasteriser()(solids, camera, (width * SUPERSAMPLING, height * SUPERSAMPLING))
    blocks = fine.reshape(height, SUPERSAMPLING, width, SUPERSAMPLING, 4)
    return blocks.mean(axis=(1, 3))


@cache
def _rasteriser() -> Draw:
    """PyVista where it can draw, set up once for all pictures; numpy elsewhere."""
    return raster_vtk.Canvas().draw if raster_vtk.available() else raster_numpy.draw
