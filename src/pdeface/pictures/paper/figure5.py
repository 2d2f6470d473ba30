"""Fig. 5: the nodes of the warp mesh on the portrait."""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray

from pdeface.pictures.lettering import write
from pdeface.pictures.paper.overlay import Color, Overlay, mesh_lines
from pdeface.pictures.paper.panels import Figure, Pixels
from pdeface.texture import POINT_NAMES, UVTexture

__all__ = ["figure5", "window_around"]

FloatArray = NDArray[np.float64]

SIZE: Final = (1000, 1000)
LIST_WIDTH: Final = 520
BLACK: Final[Color] = (15, 18, 24)
WHITE: Final[Color] = (255, 255, 255)
LINE: Final[Color] = (255, 214, 10)


def figure5(steps: UVTexture) -> Figure:
    """Draw the figure.

    Args:
        steps: the portrait and its meshes, from :func:`pdeface.texture.uv_texture`.
    """
    nodes = steps.source_mesh
    overlay = Overlay(steps.photo, window_around(nodes, steps.photo), SIZE)
    overlay.lines(mesh_lines(nodes), LINE, 1.6)
    overlay.dots(nodes, BLACK, 13.0, rim=WHITE)
    for number, point in enumerate(nodes[1:-1, 1:-1].reshape(-1, 2), start=1):
        overlay.text(point, str(number), 26.0, BLACK, WHITE)
    image = np.concatenate([overlay.image(), _list_of_names()], axis=1)
    return Figure(
        5,
        "Topology of the warp mesh: 49 nodes, of which the 25 numbered ones are the key feature "
        "points.",
        image,
        agrees=[
            "A 7 by 7 mesh: 25 feature points in five rows of five, named and numbered as in the "
            "paper, and 24 nodes around them.",
            "Points 22, 23 and 24 on the chin lie below the mouth's 17, 18 and 19, to within "
            f"{_out_of_line(steps):.0f} % of the distance between the eyes.",
            "The 24 continue the rows and columns of the feature points outwards.",
            "Left and right are the subject's: the right eyebrow is on the left of the photo.",
        ],
        differs=[
            "The 24 outer nodes lie around the face instead of on the border of the photo, where "
            "they would spread hair and background over the sides of the face.",
            "The portrait is the one bundled with this project; the paper's was not published.",
        ],
    )


def _out_of_line(steps: UVTexture) -> float:
    """How far points 22 to 24 are from straight below 17 to 19: per cent of the eyes' distance.

    Straight below means square to the line through the eyes.
    """
    points = steps.points.array
    across = points[1, 3] - points[1, 1]
    offset = (points[4, 1:4] - points[3, 1:4]) @ across / (across @ across)
    return 100.0 * float(np.abs(offset).max())


def window_around(points: FloatArray, photo: Pixels, margin: float = 0.05) -> list[float]:
    """(left, top, right, bottom) of the photo's square around the points, pixels.

    It is as large as the points and a margin need; what it has outside the photo stays white.
    """
    flat = points.reshape(-1, 2)
    low, high = flat.min(axis=0), flat.max(axis=0)
    half = (0.5 + margin) * float((high - low).max())
    middle = 0.5 * (low + high)
    size = np.array([photo.shape[1], photo.shape[0]])
    # Move the square into the photo as far as it fits.
    middle = np.where(2.0 * half <= size, np.clip(middle, half, size - half), middle)
    return [*(middle - half), *(middle + half)]


def _list_of_names() -> Pixels:
    """The numbers and what they mean, beside the portrait."""
    names = [name.replace("_", " ") for row in POINT_NAMES for name in row]
    step = SIZE[1] / (len(names) + 1)
    sheet = np.full((SIZE[1], LIST_WIDTH, 3), 255, np.uint8)
    rows = [(n * step, n, text) for n, text in enumerate(names, start=1)]
    sheet = write(sheet, [(80.0, y, str(n)) for y, n, _ in rows], 25.0, anchor="rm")
    return write(sheet, [(100.0, y, text) for y, _, text in rows], 25.0, anchor="lm")
