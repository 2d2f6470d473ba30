"""Text on pictures, with the font that Pillow brings."""

from __future__ import annotations

from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from pdeface.errors import require

__all__ = ["INK", "Label", "text_size", "write"]

Pixels = NDArray[np.uint8]
Label = tuple[float, float, str]
"""x, y and text."""

INK: Final = (45, 52, 64)


def write(
    image: Pixels,
    labels: list[Label],
    height: float,
    color: tuple[int, int, int] = INK,
    anchor: str = "mm",
    halo: tuple[int, int, int] | None = None,
) -> Pixels:
    """A copy of an (H, W, 3) image with labels.

    Args:
        labels: position in pixels, and text, of each.
        height: size of the letters, pixels.
        anchor: Pillow's two letters: which point of the text lies at its position.
        halo: colour of an outline that keeps the text legible, or None.
    """
    picture = require("PIL.Image", "render", "to write on pictures").fromarray(image)
    draw = require("PIL.ImageDraw", "render", "to write on pictures").Draw(picture)
    outline = {"stroke_width": max(1, round(height / 9)), "stroke_fill": halo} if halo else {}
    for x, y, text in labels:
        draw.text((x, y), text, fill=color, font=_font(height), anchor=anchor, **outline)
    return np.array(picture)


def text_size(text: str, height: float) -> tuple[float, float]:
    """(width, height) in pixels of a text."""
    left, top, right, bottom = _font(height).getbbox(text)
    return right - left, bottom - top


def _font(height: float) -> Any:
    return require("PIL.ImageFont", "render", "to write on pictures").load_default(height)
