"""Fig. 2: the data points of the boundary curves from three sides."""

from __future__ import annotations

from typing import Final

import numpy as np

from pdeface.face import Face
from pdeface.pictures.camera import View
from pdeface.pictures.paper.panels import PANEL, Figure, Pixels, draw_solids, panel_camera
from pdeface.pictures.sheet import contact_sheet
from pdeface.pictures.tubes import balls

__all__ = ["figure2"]

VIEWS: Final[tuple[tuple[str, View], ...]] = (
    ("(a) Frontal view", "front"),
    ("(b) Profile", "profile"),
    ("(c) 45-degree rotational view", "45"),
)
FRONT: Final = np.array([0.10, 0.14, 0.22])
BACK: Final = np.array([0.70, 0.74, 0.80])
DOT: Final = 5.0
"""Width of a point, pixels."""


def figure2(face: Face) -> Figure:
    """Draw the figure."""
    count, each = face.curves.shape
    panels = [_panel(face, view) for _, view in VIEWS]
    return Figure(
        2,
        f"Discrete representation of the {count} boundary curves of the PDE face: (a) frontal "
        "view; (b) profile; (c) 45-degree rotational view.",
        contact_sheet([panels], [[text for text, _ in VIEWS]]),
        agrees=[
            f"{count} closed curves of {each} points each.",
            f"The first {each // 2} points of a curve are the face (dark), the other "
            f"{each // 2} their reflection in a plane (pale), which makes the curve periodic.",
            "Eyes open and mouth closed; the first curves are the forehead, the last the chin.",
        ],
        differs=[
            "The paper's curves come from a scan of a person that was not published; these "
            "were fitted to the neutral head of ICT-FaceKit (see NOTICE).",
            "Points lie at v = (j + 1/2) 2 pi / M, so that the reflection is exact and no point "
            "is its own mirror image; the paper does not say where its points lie.",
            "The paper samples the scan; here the curves are fitted to many more samples by "
            "least squares, which avoids ripples between the points.",
        ],
    )


def _panel(face: Face, view: View) -> Pixels:
    camera = panel_camera(face.curves.points, view)
    radius = 0.5 * DOT * camera.pixel_size(PANEL[1])
    half = face.curves.shape[1] // 2
    front = balls(face.curves.points[:, :half], radius, FRONT, camera)
    back = balls(face.curves.points[:, half:], radius, BACK, camera)
    return draw_solids([front, back], camera)
