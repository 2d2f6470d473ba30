"""Boxes and arrows: a flowchart drawn with Pillow."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Final, Literal

import numpy as np
from numpy.typing import NDArray

from pdeface.errors import require
from pdeface.pictures.lettering import INK

__all__ = ["Box", "Chart"]

Pixels = NDArray[np.uint8]
Color = tuple[int, int, int]
Point = tuple[float, float]

FINE: Final = 3
"""Pillow draws without anti-aliasing: at this many times the size, then shrunk."""

CODE: Final[Color] = (38, 92, 138)
LINE: Final[Color] = (96, 108, 126)
FILLS: Final[dict[str, Color]] = {
    "data": (232, 239, 247),
    "work": (255, 255, 255),
    "choice": (253, 243, 224),
}
LETTERS: Final = 25.0
SMALL: Final = 19.0
HEAD: Final = 9.0
"""Half the width of an arrow's head; it is twice as long."""


@dataclass(frozen=True, eq=False)
class Box:
    """A box of the chart.

    Attributes:
        text: what stands in it, its lines divided by ``\\n``.
        code: full name of the code that does it or holds it, written below.
        middle: of the box, pixels.
        size: (width, height), pixels.
        kind: ``"data"`` (rounded), ``"work"`` (square) or ``"choice"`` (a rhombus).
        picture: (H, W, 3) shown at the left inside, or None.
    """

    text: str
    code: str
    middle: Point
    size: tuple[float, float] = (470.0, 116.0)
    kind: Literal["data", "work", "choice"] = "work"
    picture: Pixels | None = None

    def side(self, name: str) -> Point:
        """The middle of a side: ``"top"``, ``"bottom"``, ``"left"`` or ``"right"``."""
        x, y = {"top": (0, -1), "bottom": (0, 1), "left": (-1, 0), "right": (1, 0)}[name]
        return self.middle[0] + 0.5 * x * self.size[0], self.middle[1] + 0.5 * y * self.size[1]


class Chart:
    """A white sheet to draw boxes and arrows on.

    Args:
        size: (width, height), pixels.
    """

    def __init__(self, size: tuple[int, int]) -> None:
        self._size = size
        self._pillow = require("PIL.Image", "render", "to draw diagrams")
        self._font = require("PIL.ImageFont", "render", "to draw diagrams").load_default
        fine = (size[0] * FINE, size[1] * FINE)
        self._picture: Any = self._pillow.new("RGB", fine, (255, 255, 255))
        self._draw: Any = require("PIL.ImageDraw", "render", "to draw diagrams").Draw(self._picture)

    def box(self, box: Box) -> None:
        """Draw a box with its text and picture."""
        (x, y), (width, height) = box.middle, box.size
        corners = [(x - 0.5 * width) * FINE, (y - 0.5 * height) * FINE]
        corners += [(x + 0.5 * width) * FINE, (y + 0.5 * height) * FINE]
        style = {"fill": FILLS[box.kind], "outline": INK, "width": 2 * FINE}
        if box.kind == "choice":
            sides = [box.side(name) for name in ("top", "right", "bottom", "left")]
            self._draw.polygon([(a * FINE, b * FINE) for a, b in sides], **style)
        else:
            self._draw.rounded_rectangle(corners, (18 if box.kind == "data" else 3) * FINE, **style)
        if box.picture is not None:
            x += 0.5 * self._put(box.picture, x - 0.5 * width, y, height)
        self._lettering(box, x, y)

    def arrow(self, path: Sequence[Point]) -> None:
        """Draw an arrow along straight lines through points."""
        tip, before = np.array(path[-1]), np.array(path[-2])
        along = (tip - before) / np.linalg.norm(tip - before)
        across = HEAD * np.array([-along[1], along[0]])
        foot = tip - 2.0 * HEAD * along
        line = [*path[:-1], (float(foot[0]), float(foot[1]))]
        fine = [(x * FINE, y * FINE) for x, y in line]
        self._draw.line(fine, fill=LINE, width=3 * FINE, joint="curve")
        head = [tuple(FINE * p) for p in (tip, foot + across, foot - across)]
        self._draw.polygon(head, fill=LINE)

    def label(self, at: Point, text: str) -> None:
        """Write a word beside an arrow."""
        font = self._font(SMALL * FINE)
        self._draw.text((at[0] * FINE, at[1] * FINE), text, fill=LINE, font=font, anchor="mm")

    def image(self) -> Pixels:
        """(H, W, 3) what was drawn."""
        return np.asarray(self._picture.resize(self._size, self._pillow.Resampling.BOX))

    def _put(self, picture: Pixels, left: float, y: float, height: float) -> float:
        """Lay a picture at a box's left; the width that it takes."""
        high = height - 20.0
        wide = high * picture.shape[1] / picture.shape[0]
        small = self._pillow.fromarray(np.ascontiguousarray(picture[..., :3])).resize(
            (round(wide * FINE), round(high * FINE)), self._pillow.Resampling.LANCZOS
        )
        self._picture.paste(small, (round((left + 14.0) * FINE), round((y - 0.5 * high) * FINE)))
        return wide + 14.0

    def _lettering(self, box: Box, x: float, y: float) -> None:
        rows = [(text, LETTERS, INK) for text in box.text.split("\n")]
        rows += [(box.code, SMALL, CODE)] if box.code else []
        top = y - 0.5 * 1.3 * sum(letters for _, letters, _ in rows)
        for text, letters, color in rows:
            middle = (x * FINE, (top + 0.65 * letters) * FINE)
            font = self._font(letters * FINE)
            self._draw.text(middle, text, fill=color, font=font, anchor="mm")
            top += 1.3 * letters
