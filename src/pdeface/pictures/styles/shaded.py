"""Style ``shaded``: the bare form in neutral clay."""

from __future__ import annotations

from typing import Final

from pdeface.face import Face
from pdeface.pictures.camera import Camera
from pdeface.pictures.inside import inside
from pdeface.pictures.light import rig_named
from pdeface.pictures.options import Options
from pdeface.pictures.skin import skin
from pdeface.pictures.solid import Solid

__all__ = ["CLAY", "shaded"]

CLAY: Final = (0.76, 0.665, 0.585)
"""Linear reflectance of the clay."""


def shaded(face: Face, camera: Camera, options: Options) -> list[Solid]:
    """The surface in clay under studio light, or under raking light to judge its fairness."""
    rig = rig_named(options.light or "studio")
    face_itself = skin(options.sample(face), CLAY, camera, rig)
    return [
        *face_itself,
        *(inside(face, camera, rig, albedo=CLAY, head=options.head) if options.is_cut else []),
    ]
