"""Fig. 4: the flowchart, from the boundary curves and the photo to the textured face."""

from __future__ import annotations

from typing import Final

import numpy as np

from pdeface.face import Face
from pdeface.pictures.paper.diagram import Box, Chart, Point
from pdeface.pictures.paper.figure5 import window_around
from pdeface.pictures.paper.overlay import Overlay, mesh_lines
from pdeface.pictures.paper.panels import Figure, Pixels
from pdeface.pictures.picture import render
from pdeface.texture import UVTexture

__all__ = ["ARROWS", "boxes", "figure4"]

SIZE: Final = (1700, 1490)
LEFT, MIDDLE, RIGHT = 330.0, 850.0, 1370.0
ROWS: Final = (130.0, 355.0, 555.0, 730.0, 915.0, 1160.0, 1410.0)
WIDE: Final = (540.0, 200.0)
NARROW: Final = (290.0, 116.0)
SMALL: Final = (200, 230)

ARROWS: Final[tuple[tuple[str, str, str, str], ...]] = (
    ("curves", "bottom", "wanted", "top"),
    ("wanted", "right", "controls", "bottom"),
    ("controls", "left", "curves", "right"),
    ("wanted", "bottom", "solve", "top"),
    ("solve", "bottom", "sample", "top"),
    ("uvmesh", "bottom", "sample", "right"),
    ("uvmesh", "right", "grid", "left"),
    ("sample", "bottom", "mesh", "top"),
    ("photo", "bottom", "grid", "top"),
    ("grid", "bottom", "meshes", "top"),
    ("meshes", "bottom", "warp", "top"),
    ("warp", "bottom", "texture", "top"),
    ("mesh", "bottom", "face", "left"),
    ("texture", "bottom", "face", "right"),
    ("face", "bottom", "file", "top"),
    ("face", "bottom", "picture", "top"),
)
"""From a box's side to another's."""


def figure4(face: Face, steps: UVTexture) -> Figure:
    """Draw the figure.

    Args:
        face: the neutral face.
        steps: the portrait's five steps, from :func:`pdeface.texture.uv_texture`.
    """
    chart = Chart(SIZE)
    placed = boxes(face, steps)
    for start, out, end, into in ARROWS:
        chart.arrow(_path(placed[start].side(out), placed[end].side(into), out, into))
    for box in placed.values():
        chart.box(box)
    chart.label((LEFT + 250.0, ROWS[1] - 18.0), "no")
    chart.label((LEFT + 28.0, ROWS[1] + 98.0), "yes")
    return Figure(
        4,
        "Flowchart of the PDE face: boundary curves and the photo above, the textured face "
        "below; under each step the code that does it.",
        chart.image(),
        agrees=[
            "Boundary curves, adjusted if another face is wanted, are the boundary conditions of "
            "the PDE, and its solution is the face.",
            "The texture map is fitted to the uv mesh of the PDE face, not to the shape in space: "
            "the two columns meet only in the uv mesh and in the textured face.",
            "The five steps of the uv-mesh texture mapping (section 3.2) stand in their order.",
        ],
        differs=[
            "The paper's chart names the ideas; here every box also names the function or type "
            "of this package behind it, and the pictures are what these return.",
            "The curves are adjusted by named controls: shape, identity and expression.",
            "What follows the textured face, a file for other programs or a picture, is new.",
        ],
    )


def boxes(face: Face, steps: UVTexture) -> dict[str, Box]:
    """The boxes by name."""
    textured = face.with_texture(steps.image)
    count, each = face.curves.shape
    white = {"size": SMALL, "background": "white"}
    curves = render(face, style="curves", **white)  # type: ignore[arg-type]
    clay = render(face, style="uvmesh", openings="none", **white)  # type: ignore[arg-type]
    worn = render(textured, openings="none", **white)  # type: ignore[arg-type]
    r = ROWS
    return {
        "curves": Box(
            f"{count} boundary curves\nof {each} points",
            "template.neutral_curves",
            (LEFT, r[0]),
            WIDE,
            "data",
            curves,
        ),
        "wanted": Box("The face\nthat is wanted?", "", (LEFT, r[1]), (400.0, 160.0), "choice"),
        "controls": Box("Move the curves", "Face.set", (MIDDLE, r[0]), NARROW),
        "solve": Box(
            "Solve the PDE between the\ncurves: equation (1)", "pde.PDESurface", (LEFT, r[2])
        ),
        "sample": Box("Positions and normals\non the uv mesh", "pde.GridEvaluator", (LEFT, r[3])),
        "mesh": Box("Face mesh", "uvmesh.FaceMesh", (LEFT, r[4]), WIDE, "data", clay),
        "uvmesh": Box("uv mesh", "uvmesh.UVMesh", (MIDDLE, r[2]), NARROW, "data"),
        "photo": Box(
            "Photo and its\n25 feature points",
            "texture.FeaturePoints",
            (RIGHT, r[0]),
            WIDE,
            "data",
            _photo(steps),
        ),
        "grid": Box("1. Scale the uv grid\nto eyes and mouth", "UVTexture.grid", (RIGHT, r[1])),
        "meshes": Box(
            "2. and 3. Warp meshes\nof photo and uv mesh",
            "UVTexture.source_mesh",
            (RIGHT, r[2]),
        ),
        "warp": Box("4. Two-pass mesh warp", "texture.warp", (RIGHT, r[3])),
        "texture": Box(
            "5. Texture map\nover (v, u)",
            "UVTexture.image",
            (RIGHT, r[4]),
            WIDE,
            "data",
            steps.image,
        ),
        "face": Box("Textured PDE face", "Face.with_texture", (MIDDLE, r[5]), WIDE, "data", worn),
        "file": Box("File for other programs", "export", (MIDDLE - 260.0, r[6])),
        "picture": Box("Picture", "render", (MIDDLE + 260.0, r[6])),
    }


def _path(start: Point, end: Point, out: str, into: str) -> list[Point]:
    """Straight; round one corner; or, between sides that face each other, round two."""
    level = ("left", "right")
    if start[0] == end[0] or start[1] == end[1]:
        return [start, end]
    if out in level and into in level:
        middle = 0.5 * (start[0] + end[0])
        return [start, (middle, start[1]), (middle, end[1]), end]
    if out not in level and into not in level:
        middle = 0.5 * (start[1] + end[1])
        return [start, (start[0], middle), (end[0], middle), end]
    corner = (end[0], start[1]) if out in level else (start[0], end[1])
    return [start, corner, end]


def _photo(steps: UVTexture) -> Pixels:
    """The photo around the face, with the source mesh."""
    nodes = steps.source_mesh
    overlay = Overlay(steps.photo, window_around(nodes, steps.photo), (360, 360))
    overlay.lines(mesh_lines(nodes), (255, 214, 10), 2.0)
    overlay.dots(np.asarray(nodes), (15, 18, 24), 9.0, rim=(255, 255, 255))
    return overlay.image()
