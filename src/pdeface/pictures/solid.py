"""What a picture is made of: coloured triangles, already lit.

Light is worked out per vertex, from the analytic normals, before anything is drawn
(:mod:`pdeface.pictures.light`). A rasteriser only has to interpolate colours, so that the two
of them give the same picture.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

__all__ = ["Solid", "merge"]

FloatArray = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Solid:
    """Triangles to draw. Only their front sides (anticlockwise) are seen.

    Attributes:
        vertices: (V, 3) metres.
        triangles: (T, 3) indices.
        colors: (V, 3) sRGB values from 0 to 1; they multiply the texture if there is one.
        texcoords: (V, 2) with the origin at the top left, or None.
        texture: (H, W, 3) uint8, or None.
    """

    vertices: FloatArray
    triangles: NDArray[np.int32]
    colors: FloatArray
    texcoords: FloatArray | None = None
    texture: NDArray[np.uint8] | None = None


def merge(solids: Sequence[Solid]) -> Solid:
    """One untextured solid made of several."""
    starts = np.cumsum([0, *(len(s.vertices) for s in solids[:-1])])
    return Solid(
        np.concatenate([s.vertices for s in solids]),
        np.concatenate([s.triangles + n for s, n in zip(solids, starts, strict=True)]).astype(
            np.int32
        ),
        np.concatenate([s.colors for s in solids]),
    )
