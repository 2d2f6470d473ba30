"""Panels of a figure: small pictures on white, in rows, with the paper's letters."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from pdeface.pictures.camera import Camera, View, frame
from pdeface.pictures.canvas import picture_of
from pdeface.pictures.ground import over
from pdeface.pictures.light import RIGS
from pdeface.pictures.skin import skin
from pdeface.pictures.solid import Solid, merge
from pdeface.pictures.tubes import tube
from pdeface.uvmesh import FaceMesh

__all__ = ["PANEL", "Figure", "Pixels", "draw_solids", "loops", "panel_camera", "shell"]

FloatArray = NDArray[np.float64]
Pixels = NDArray[np.uint8]

PANEL: Final = (720, 800)
"""Width and height of a panel, pixels."""

WHITE: Final = np.ones(3)


@dataclass(frozen=True, eq=False)
class Figure:
    """A figure of the paper, redrawn.

    Attributes:
        number: the figure's number in the paper.
        caption: what it shows, in one line.
        image: (H, W, 3).
        agrees: where this project's figure and the paper's agree, point by point.
        differs: where they differ, and why.
    """

    number: int
    caption: str
    image: Pixels
    agrees: Sequence[str]
    differs: Sequence[str]

    @property
    def file_name(self) -> str:
        """The picture's name in the folder."""
        return f"figure-{self.number}.png"


def draw_solids(solids: Sequence[Solid], camera: Camera, size: tuple[int, int] = PANEL) -> Pixels:
    """Solids on white paper."""
    return over(picture_of(solids, camera, size), WHITE)


def panel_camera(points: FloatArray, view: View, size: tuple[int, int] = PANEL) -> Camera:
    """The camera of a panel that shows ``points``."""
    return frame(points, view, size[0] / size[1])


def loops(paths: FloatArray, width: float, colors: FloatArray, camera: Camera) -> Solid:
    """Closed lines ``width`` pixels wide in a panel.

    Args:
        paths: (L, P, 3) metres.
        colors: (L, 3) sRGB, 0 to 1.
    """
    radius = 0.5 * width * camera.pixel_size(PANEL[1])
    return merge([tube(p, radius, c, closed=True) for p, c in zip(paths, colors, strict=True)])


def shell(mesh: FaceMesh, albedo: tuple[float, float, float], camera: Camera) -> list[Solid]:
    """A lit surface, inside and outside."""
    return skin(mesh, albedo, camera, RIGS["studio"])
