"""Fig. 6: the photo and the warped photo, bare, with the uv mesh and with the warp meshes; and the
texture that is cut out of it."""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray

from pdeface.pictures.paper.figure5 import window_around
from pdeface.pictures.paper.overlay import Color, Overlay, mesh_lines
from pdeface.pictures.paper.panels import Figure, Pixels
from pdeface.pictures.sheet import contact_sheet
from pdeface.texture import UVTexture

__all__ = ["figure6", "largest_miss"]

FloatArray = NDArray[np.float64]

SIZE: Final = (640, 640)
WARP: Final[Color] = (255, 214, 10)
NODE: Final[Color] = (15, 18, 24)
WHITE: Final[Color] = (255, 255, 255)
RIM: Final = 0.015
"""White around the texture, so that the nodes on its border are seen whole."""

CAPTIONS: Final = [
    ["(a) Original texture map", "(b) with the uv mesh", "(c) with the source mesh"],
    ["(d) Warped texture map", "(e) with the uv mesh", "(f) with the target mesh"],
    ["Cut to the uv mesh", "with the uv mesh", "with the target mesh"],
]


def figure6(steps: UVTexture) -> Figure:
    """Draw the figure.

    Args:
        steps: the portrait's five steps, from :func:`pdeface.texture.uv_texture`.
    """
    height, width = steps.image.shape[:2]
    around = np.concatenate([steps.grid.nodes().reshape(-1, 2), steps.source_mesh.reshape(-1, 2)])
    window = window_around(around, steps.photo)
    whole = [-RIM * width, -RIM * height, (1 + RIM) * width, (1 + RIM) * height]
    rows = [
        _row(steps.photo, window, steps.grid.nodes(), steps.source_mesh),
        _row(steps.target_image(), window, steps.grid.nodes(), steps.grid_mesh),
        _row(steps.image, whole, steps.uv_nodes(), steps.target_mesh),
    ]
    return Figure(
        6,
        "Mesh-assisted warping of the texture map: (a) the original I_s; (b) I_s with the uv "
        "mesh; (c) I_s with M_s; (d) the warped texture map I_t; (e) I_t with the uv mesh; "
        "(f) I_t with M_t. Below: what of I_t the uv mesh takes, drawn over (v, u).",
        contact_sheet(rows, CAPTIONS),
        agrees=[
            "(b) The 28 by 41 grid is scaled so that both eye centres fall where the face has "
            "them and the mouth corners on their horizontal; the other features miss their "
            f"places, by up to {_miss_before(steps):.0f} % of the distance between the eyes, "
            "which is why a warp is needed.",
            "(f) After the two-pass mesh warp the 25 feature points lie where the uv mesh has "
            "them.",
            "(d) The warped image textures the uv mesh: cut along the grid of (e) its coordinates "
            "are (v, u), and no map from space to image is needed.",
        ],
        differs=[
            "(b) The grid is the neutral face's own uv mesh seen from the front, where the paper's "
            "is straight: rows crowd at lids and lips, and a straight grid would put a photo's "
            "eyes beside them. `uv_texture(..., follow_face=False)` takes the straight one.",
            f"Below: the texture is cut out along the grid, {width} by {height} texels. Lids and "
            "lips are tall in it, because the uv mesh has many rows there.",
            "(c) The outer nodes lie around the face instead of on the photo's border.",
            "Below: the edge fades into the skin's colour: a frontal photo has hair and background "
            "where the sides of the face need skin.",
            "If the head is tilted, the line between the eyes is levelled first; the paper's "
            "subject looks straight ahead.",
        ],
    )


def _row(image: Pixels, window: list[float], uv: FloatArray, mesh: FloatArray) -> list[Pixels]:
    bare = Overlay(image, window, SIZE)
    gridded = Overlay(image, window, SIZE)
    gridded.lines(mesh_lines(uv), WHITE, 1.0)
    warped = Overlay(image, window, SIZE)
    warped.lines(mesh_lines(mesh), WARP, 1.6)
    warped.dots(mesh, NODE, 9.0, rim=WHITE)
    return [panel.image() for panel in (bare, gridded, warped)]


def _miss_before(steps: UVTexture) -> float:
    """See :func:`largest_miss`; in per cent of the distance between the eyes."""
    eyes = steps.points.array[1, [1, 3]]
    return 100.0 * largest_miss(steps) / float(np.linalg.norm(eyes[1] - eyes[0]))


def largest_miss(steps: UVTexture) -> float:
    """The largest distance of a feature point from its place in the scaled grid, pixels."""
    placed = steps.grid(steps.targets[..., 0], steps.targets[..., 1])
    return float(np.linalg.norm(placed - steps.points.array, axis=-1).max())
