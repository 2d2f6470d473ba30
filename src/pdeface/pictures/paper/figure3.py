"""Fig. 3: the face on two uv meshes; and, dense, with the paper's join and the smooth one."""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray

from pdeface.face import Face
from pdeface.pde import Join
from pdeface.pictures.paper.panels import PANEL, Figure
from pdeface.pictures.picture import render
from pdeface.pictures.sheet import contact_sheet

__all__ = ["creases", "figure3"]

FloatArray = NDArray[np.float64]

DENSE: Final = (541, 321)


def figure3(face: Face) -> Figure:
    """Draw the figure."""
    meshes = ((28, 41), (37, 41))
    joins: tuple[Join, ...] = ("patchwise", "smooth")
    upper = [
        render(face, style="uvmesh", mesh=mesh, join="patchwise", size=PANEL, background="white")
        for mesh in meshes
    ]
    lower = [
        render(
            face,
            style="shaded",
            openings="none",
            mesh=DENSE,
            join=join,
            light="raking",
            size=PANEL,
            background="white",
        )
        for join in joins
    ]
    rough, fair = (creases(face, join) for join in joins)
    captions = [
        ["(a) A 28 by 41 uv mesh", "(b) A 37 by 41 uv mesh"],
        [
            f"(c) {DENSE[0]} by {DENSE[1]}, the paper's join",
            f"(d) {DENSE[0]} by {DENSE[1]}, smooth",
        ],
    ]
    return Figure(
        3,
        "PDE face: (a) using a 28 by 41 uv mesh; (b) using a 37 by 41 uv mesh; (c), (d) on a "
        "dense mesh under raking light, with the patchwise and the smooth join.",
        contact_sheet([upper, lower], captions),
        agrees=[
            "One uv mesh serves the whole face, 0 <= u <= 1 and 0 <= v <= pi, each of the nine "
            "patches taking one ninth of u; any resolution comes from the same curves.",
            "On 28 by 41 nodes every row lies on a boundary curve, three rows of cells a patch; "
            "37 by 41 has four rows of cells a patch and shows what is between the curves.",
            "Neighbouring patches share a curve, so the surface has no gap.",
        ],
        differs=[
            "(c) The paper calls the merge of its patches seamless. They share a curve but no "
            "tangent: on a dense mesh the patchwise surface has creases at curves 3, 6, ..., 24, "
            f"where its normal turns by {np.median(rough):.1f} degrees in the median and by "
            f"{np.quantile(rough, 0.9):.0f} or more at one place in ten (most at the lids and "
            "lips, where curves lie close together). A 28 by 41 mesh hides them, since all its "
            "rows lie on curves.",
            "(d) is new: the smooth join solves equation (1) between every two curves and asks "
            "for continuous first and second derivatives across them; its normal turns by "
            f"{max(fair.max(), 1e-9):.0e} degrees at most.",
            "Inside a patch the exponents are those of u over the whole face, (a/9) n t for t "
            "from 0 to 1 across the patch; with a n t the surface would ripple between curves.",
        ],
    )


def creases(face: Face, join: Join) -> FloatArray:
    """Angles, degrees, by which the normal turns across the curves 3, 6, ... of the face.

    Places where the surface has no normal are left out, such as the mouth's corners, where two
    curves touch.
    """
    surface = face.surface(join)
    last = face.curves.shape[0] - 1
    u = np.arange(3, last, 3)[:, None] / last
    v = np.linspace(0.0, np.pi, 181)[None, :]
    before, after = surface.normal(u, v, side="before"), surface.normal(u, v, side="after")
    cosine = np.sum(before * after, axis=-1)
    angle = np.degrees(np.arctan2(np.linalg.norm(np.cross(before, after), axis=-1), cosine))
    known = np.any(before != 0.0, axis=-1) & np.any(after != 0.0, axis=-1)
    return np.asarray(angle[known])
