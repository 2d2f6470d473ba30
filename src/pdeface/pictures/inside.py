"""What is seen through the openings of a face, as solids."""

from __future__ import annotations

from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from pdeface.anatomy import textures
from pdeface.controls.neck import PIVOT, rotations
from pdeface.face import Face
from pdeface.parts import FaceParts, eye_colours, has_parts
from pdeface.pictures.camera import Camera
from pdeface.pictures.light import Rig, light_up
from pdeface.pictures.solid import Solid

__all__ = ["inside"]

# Of the clay's reflectance. No shadow falls into a mouth here; without this it would glow.
CLAY_SHARE: Final = {"mouth": 0.10, "tongue": 0.22, "teeth": 0.45}


def inside(
    face: Face,
    camera: Camera,
    rig: Rig,
    *,
    albedo: Any = None,
    head: NDArray[np.float64] | None = None,
) -> list[Solid]:
    """Eyes and mouth; nothing for a face that has no lids.

    Args:
        albedo: (3,) linear reflectance of everything, for clay; None for the parts' textures.
        head: (3,) yaw, pitch and roll of the head, radians.
    """
    if not has_parts(face):
        return []
    parts = FaceParts(face)
    turn = np.eye(3) if head is None else rotations(head)
    eyes = eye_colours(face)
    return [_solid(parts, name, camera, rig, albedo, turn, eyes) for name in parts.parts]


def _solid(
    parts: FaceParts,
    name: str,
    camera: Camera,
    rig: Rig,
    albedo: Any,
    turn: NDArray[np.float64],
    eyes: tuple[tuple[int, int, int], tuple[int, int, int]],
) -> Solid:
    part, curves = parts.parts[name], parts.curves(name)
    vertices = (part.positions(curves) - PIVOT) @ turn.T + PIVOT
    normals = part.normals(curves) @ turn.T
    white = np.ones(3) if albedo is None else np.asarray(albedo, dtype=np.float64)
    if albedo is not None:
        white = white * CLAY_SHARE.get(part.material, 1.0)
    colors = light_up(vertices, normals, white, camera, rig)
    if albedo is not None:
        return Solid(vertices, part.grid.triangles, colors)
    return Solid(
        vertices, part.grid.triangles, colors, part.grid.texcoords, textures.texture(name, *eyes)
    )
