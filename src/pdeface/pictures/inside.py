"""What is seen through the openings of a face, as solids."""

from __future__ import annotations

from typing import Any

import numpy as np

from pdeface.anatomy import textures
from pdeface.face import Face
from pdeface.parts import FaceParts
from pdeface.pictures.camera import Camera
from pdeface.pictures.light import Rig, light_up
from pdeface.pictures.solid import Solid

__all__ = ["inside"]


def inside(face: Face, camera: Camera, rig: Rig, *, albedo: Any = None) -> list[Solid]:
    """Eyes and mouth; nothing for a face that has no lids.

    Args:
        albedo: (3,) linear reflectance of everything, for clay; None for the parts' textures.
    """
    if not face.has_lids:
        return []
    parts = FaceParts(face)
    return [_solid(parts, name, camera, rig, albedo) for name in parts.parts]


def _solid(parts: FaceParts, name: str, camera: Camera, rig: Rig, albedo: Any) -> Solid:
    part, curves = parts.parts[name], parts.curves(name)
    vertices, normals = part.positions(curves), part.normals(curves)
    white = np.ones(3) if albedo is None else np.asarray(albedo, dtype=np.float64)
    colors = light_up(vertices, normals, white, camera, rig)
    if albedo is not None:
        return Solid(vertices, part.grid.triangles, colors)
    return Solid(vertices, part.grid.triangles, colors, part.grid.texcoords, textures.texture(name))
