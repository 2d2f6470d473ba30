"""The legend of a picture in which colour means a number."""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray

from pdeface.pictures.lettering import INK, write
from pdeface.pictures.styles.curvature import diverging

__all__ = ["BAND", "with_colour_bar"]

Pixels = NDArray[np.uint8]

BAND: Final = 0.10
"""Height of the legend at the foot of a picture, as a share of the picture's."""


def with_colour_bar(image: Pixels, limit: float, quantity: str) -> Pixels:
    """A copy of an (H, W, 3) image with a bar from -limit to +limit along its foot."""
    height, width = image.shape[:2]
    letters, middle = 0.20 * BAND * height, 0.5 * width
    top, thick = round((1.0 - 0.58 * BAND) * height), max(2, round(0.14 * BAND * height))
    left, right = round(0.28 * width), round(0.72 * width)
    result = image.copy()
    bar = diverging(np.linspace(-1.0, 1.0, right - left))
    result[top : top + thick, left:right] = np.round(255.0 * bar)
    result = write(result, [(middle, top - 0.35 * letters, quantity)], letters, INK, "mb")
    marks = [(left, f"-{limit:g}"), (middle, "0"), (right, f"+{limit:g}")]
    below = top + thick + 0.4 * letters
    return write(result, [(float(x), below, text) for x, text in marks], letters, INK, "mt")
