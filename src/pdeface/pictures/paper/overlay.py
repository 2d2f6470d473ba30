"""Lines, dots and numbers on a photo."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from pdeface.errors import require

__all__ = ["Overlay", "mesh_lines"]

FloatArray = NDArray[np.float64]
Pixels = NDArray[np.uint8]
Color = tuple[int, int, int]

FINE: Final = 3
"""Pillow draws without anti-aliasing: at this many times the size, then shrunk."""


class Overlay:
    """A part of a photo, enlarged, to draw on.

    Args:
        image: (H, W, 3) photo.
        window: (left, top, right, bottom) of the part shown, pixels of the photo.
        size: (width, height) of the result; the part keeps its proportions and the rest is white.
    """

    def __init__(self, image: Pixels, window: Sequence[float], size: tuple[int, int]) -> None:
        pillow = require("PIL.Image", "render", "to draw on photos")
        left, top, right, bottom = window
        width, height = FINE * size[0], FINE * size[1]
        self._size = size
        self._scale = min(width / (right - left), height / (bottom - top))
        # Where the photo's top left corner comes to lie in the picture.
        middle = 0.5 * np.array([left + right, top + bottom])
        self._shift = 0.5 * np.array([width, height]) - self._scale * middle
        box = -self._shift / self._scale
        affine = (1.0 / self._scale, 0.0, box[0], 0.0, 1.0 / self._scale, box[1])
        photo = pillow.fromarray(np.ascontiguousarray(image[..., :3]))
        self._picture = photo.transform(
            (width, height),
            pillow.Transform.AFFINE,
            affine,
            resample=pillow.Resampling.BICUBIC,
            fillcolor=(255, 255, 255),
        )
        draw: Any = require("PIL.ImageDraw", "render", "to draw on photos")
        self._draw = draw.Draw(self._picture)

    def lines(self, paths: Iterable[FloatArray], color: Color, width: float = 1.2) -> None:
        """Draw polylines, each (P, 2) pixels of the photo."""
        for path in paths:
            points = [tuple(p) for p in self._placed(path)]
            self._draw.line(points, fill=color, width=round(width * FINE), joint="curve")

    def dots(
        self, points: FloatArray, color: Color, width: float = 7.0, rim: Color | None = None
    ) -> None:
        """Draw a disc on each of (P, 2) points."""
        radius = 0.5 * width * FINE
        for x, y in self._placed(points).reshape(-1, 2):
            box = (x - radius, y - radius, x + radius, y + radius)
            self._draw.ellipse(box, fill=color, outline=rim, width=FINE)

    def text(self, point: FloatArray, text: str, height: float, color: Color, halo: Color) -> None:
        """Write beside a point, above it and to its right."""
        font = require("PIL.ImageFont", "render", "to draw on photos").load_default(height * FINE)
        x, y = self._placed(point) + FINE * height * np.array([0.35, -0.3])
        stroke = {"stroke_width": 2 * FINE, "stroke_fill": halo}
        self._draw.text((x, y), text, fill=color, font=font, anchor="ls", **stroke)

    def image(self) -> Pixels:
        """(H, W, 3) what was drawn."""
        pillow = require("PIL.Image", "render", "to draw on photos")
        return np.asarray(self._picture.resize(self._size, pillow.Resampling.BOX))

    def _placed(self, points: FloatArray) -> FloatArray:
        return np.asarray(points, dtype=np.float64) * self._scale + self._shift


def mesh_lines(nodes: FloatArray) -> list[FloatArray]:
    """The rows and columns of an (R, C, 2) mesh as polylines."""
    return [*nodes, *nodes.transpose(1, 0, 2)]
