"""Fig. 9: the face as a mesh, and wearing the portrait's texture; its right eye blinks."""

from __future__ import annotations

from typing import Final

import numpy as np

from pdeface.face import Face
from pdeface.pictures.paper.panels import PANEL, Figure, Pixels
from pdeface.pictures.picture import render
from pdeface.pictures.sheet import contact_sheet
from pdeface.texture import UVTexture

__all__ = ["BLINK", "figure9", "moved_by_side"]

BLINK: Final = {"eyeBlinkRight": 1.0}


def figure9(face: Face, steps: UVTexture) -> Figure:
    """Draw the figure.

    Args:
        face: the neutral face.
        steps: the portrait's five steps, from :func:`pdeface.texture.uv_texture`.
    """
    textured = face.with_texture(steps.image)
    blinking = textured.with_weights(BLINK)
    right, left = moved_by_side(textured, blinking)
    panels = [
        [_panel(face, style="uvmesh"), _panel(textured)],
        [_panel(textured, view="profile"), _panel(blinking)],
    ]
    captions = [
        ["(a) PDE face model", "(b) Frontal view, textured"],
        ["(c) Profile, textured", "(d) The right eye blinking"],
    ]
    return Figure(
        9,
        "Generated PDE faces: (a) the face mesh, 28 by 41; (b) frontal view of the textured "
        "face; (c) its profile; (d) the textured face with the right eye blinking.",
        contact_sheet(panels, captions),
        agrees=[
            "The texture is that of Fig. 6, pinned to the uv mesh: (b), (c) and (d) wear the same "
            "one, whatever the shape does.",
            "(d) The blink moves boundary curves and nothing else.",
            f"(d) Only the subject's right eye (on the left of the picture) blinks: its side of "
            f"the face moves by up to {right:.1f} mm, the other by {left:.2f} mm at most.",
        ],
        differs=[
            "The paper textures the exaggerated face of its Fig. 8 and resets it for the blink; "
            "all four panels here are the neutral face, so that the texture can be judged.",
            "(b), (c), (d) are drawn on a mesh too fine to see; the paper's has 28 by 41 nodes.",
            "(d) The blink is ARKit's `eyeBlinkRight` at 1, closed, measured on the expressions "
            "of ICT-FaceKit; the paper's slider 'Right eye raise' stands at a place of its own.",
            "(d) The texture has no picture of the closed lid: what covers the eye is the narrow "
            "strip at the lid's margin, mostly lashes, pulled over it.",
            "The photo brings its own light and the mesh no hair, ears or neck; the shape is not "
            "that of the person in the photo.",
        ],
    )


def moved_by_side(before: Face, after: Face) -> tuple[float, float]:
    """Millimetres by which the subject's right and left half of the face move at most."""
    still, moved = (
        f.mesh(109, 161, openings="none").vertices.reshape(109, 161, 3) for f in (before, after)
    )
    distance = 1000.0 * np.linalg.norm(moved - still, axis=-1)
    middle = distance.shape[1] // 2
    return float(distance[:, :middle].max()), float(distance[:, middle + 1 :].max())


def _panel(face: Face, view: str = "front", style: str = "textured") -> Pixels:
    return render(face, view=view, style=style, size=PANEL, background="white", openings="none")
