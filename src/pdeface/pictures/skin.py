"""A face's surface as solids: its outside, and its inside in a darker, matte tone."""

from __future__ import annotations

from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from pdeface.pictures.camera import Camera
from pdeface.pictures.light import Rig, light_up
from pdeface.pictures.solid import Solid
from pdeface.uvmesh import FaceMesh

__all__ = ["skin"]

FloatArray = NDArray[np.float64]

INSIDE: Final = np.array([0.165, 0.160, 0.155])
"""Linear reflectance of the inside of the mask."""


def skin(
    mesh: FaceMesh,
    albedo: Any,
    camera: Camera,
    rig: Rig,
    texture: NDArray[np.uint8] | None = None,
) -> list[Solid]:
    """The lit outside and inside of the surface.

    Args:
        albedo: (3,) or (V, 3) linear reflectance of the outside.
        texture: (H, W, 3) image that multiplies the light, or None.
    """
    albedo = np.asarray(albedo, dtype=np.float64)
    outside = light_up(mesh.vertices, mesh.normals, albedo, camera, rig)
    inside = light_up(mesh.vertices, -mesh.normals, INSIDE, camera, _matte(rig))
    texcoords = None if texture is None else mesh.texcoords
    towards = _towards(mesh, camera)
    return [
        Solid(mesh.vertices, mesh.triangles[towards], outside, texcoords, texture),
        Solid(mesh.vertices, mesh.triangles[~towards][:, ::-1], inside),
    ]


def _towards(mesh: FaceMesh, camera: Camera) -> NDArray[np.bool_]:
    """(T,) whether the camera sees the outside of each triangle, unless something hides it."""
    a, b, c = (mesh.vertices[mesh.triangles[:, k]] for k in range(3))
    facing = np.einsum("ti,ti->t", np.cross(b - a, c - a), camera.position - a)
    return np.asarray(facing > 0.0)


def _matte(rig: Rig) -> Rig:
    return Rig(rig.lamps, rig.sky, rig.ground)
