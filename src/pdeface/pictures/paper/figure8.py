"""Fig. 8: the boundary curves with every shape slider at an end, in profile."""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray

from pdeface.controls.shape import SHAPE_CONTROLS, displacement
from pdeface.curves import BoundaryCurves
from pdeface.face import Face
from pdeface.pictures.camera import Camera
from pdeface.pictures.options import Options
from pdeface.pictures.paper.panels import PANEL, Figure, Pixels, draw_solids, panel_camera
from pdeface.pictures.sheet import contact_sheet
from pdeface.pictures.styles import STYLES
from pdeface.uvmesh import FaceMesh

__all__ = ["extremes", "figure8", "folded_cells", "moved_by"]

FloatArray = NDArray[np.float64]

NAMES: Final = tuple(SHAPE_CONTROLS)
MESHES: Final = ((28, 41), (541, 321))
"""On which folded cells are counted."""


def figure8(face: Face) -> Figure:
    """Draw the figure."""
    weights = extremes(face.curves)
    opposite = {name: -weight for name, weight in weights.items()}
    faces = [face, face.with_weights(weights), face.with_weights(opposite)]
    camera = panel_camera(
        np.concatenate([f.mesh(openings="none").vertices for f in faces]), "profile"
    )
    # In (c) it is the same: the curves are linear in the sliders, whose ends are opposite.
    moved = 1000.0 * moved_by(faces[1])
    folds = sum(folded_cells(f.mesh(*mesh, openings="none")) for f in faces[1:] for mesh in MESHES)
    meshes = " and ".join(f"{rows} by {columns}" for rows, columns in MESHES)
    return Figure(
        8,
        "Lateral view of exaggerated boundary curves: (a) neutral; (b) every shape slider at "
        "one end; (c) every one at the other; (d), (e), (f) the surfaces of these curves.",
        contact_sheet(
            [[_panel(f, style, camera) for f in faces] for style in ("curves", "shaded")],
            [
                ["(a) Neutral curves", "(b) All sliders at an end", "(c) All at the other"],
                ["(d) Surface of (a)", "(e) Surface of (b)", "(f) Surface of (c)"],
            ],
        ),
        agrees=[
            "Sliders move the boundary curves, grouped by the bones of the skull, and the surface "
            "follows: nothing but the curves is changed.",
            "The face is as exaggerated as the sliders can make it, seen from the side: (b) takes "
            "of each slider the end that, with all others, changes the profile most (beyond its "
            "size and proportions), and (c) the opposite ends.",
            "Forehead, nose and chin are changed most plainly: the points move by "
            f"{np.sqrt(np.mean(moved**2)):.0f} mm (RMS), by {moved.max():.0f} mm at most.",
            f"Exaggerated, not broken: of the cells of the uv meshes {meshes}, {folds} are folded.",
            "'Right eye raise' stays where it is, as in the paper: expressions are no shape "
            "sliders here.",
        ],
        differs=[
            f"{len(weights)} sliders for the whole face, where the paper had made those of "
            "forehead, nose and chin; one of them, `asymmetry`, does not show in profile.",
            "The paper shows a window of its program with sliders in it; here are the curves "
            "alone, on a pale surface that hides those of the other side.",
            "The paper shows one exaggerated face; here both ends are shown, with their surfaces.",
            "The ends of the sliders are chosen, so that any of their combinations may be tried "
            "(docs/shape-controls.md counts folded cells); the paper's are not told.",
        ],
    )


def extremes(curves: BoundaryCurves) -> dict[str, float]:
    """The end of every shape slider that together change the profile most.

    The change is the sum of squared displacements of the front points in the plane x = 0, less
    what an affine map of that plane does: a face that is only larger, or longer, is not
    exaggerated. It is a quadratic form of the sliders; one after another changes ends, from all
    at the upper one, until none adds to it by that.
    """
    front = curves.half[..., 1:].reshape(-1, 2)
    affine = np.linalg.qr(np.column_stack([np.ones(len(front)), front]))[0]
    moved = [displacement(name, curves.shape)[:, : curves.shape[1] // 2, 1:] for name in NAMES]
    rest = [d - affine @ (affine.T @ d) for d in (m.reshape(-1, 2) for m in moved)]
    form = np.stack([d.ravel() for d in rest]) @ np.stack([d.ravel() for d in rest]).T
    upper = np.ones(len(NAMES), dtype=bool)
    gain = np.ones(1)
    while gain.max() > 1e-12:
        ends = np.where(upper, 1.0, -1.0)
        gain = -4.0 * ends * (form @ ends - np.diag(form) * ends)
        if gain.max() > 1e-12:
            upper[gain.argmax()] ^= True
    controls = [SHAPE_CONTROLS[name] for name in NAMES]
    return {c.name: c.high if up else c.low for c, up in zip(controls, upper, strict=True)}


def moved_by(face: Face) -> FloatArray:
    """(K, M / 2) metres by which the controls move the points of the face."""
    half = face.curves.shape[1] // 2
    moved = face.moved_curves.points[:, :half] - face.curves.points[:, :half]
    return np.asarray(np.linalg.norm(moved, axis=-1))


def folded_cells(mesh: FaceMesh) -> int:
    """Cells whose two triangles face opposite ways."""
    a, b, c, d = (mesh.vertices[corner] for corner in mesh.quads.T)
    first, second = np.cross(b - a, c - a), np.cross(c - a, d - a)
    return int(((first * second).sum(axis=-1) < 0.0).sum())


def _panel(face: Face, style: str, camera: Camera) -> Pixels:
    return draw_solids(
        STYLES[style](face, camera, Options(height=PANEL[1], openings="none")), camera
    )
