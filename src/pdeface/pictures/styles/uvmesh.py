"""Style ``uvmesh``: the cells of a uv mesh on a white surface."""

from __future__ import annotations

from typing import Final

import numpy as np

from pdeface.face import Face
from pdeface.pictures.camera import Camera
from pdeface.pictures.light import rig_named
from pdeface.pictures.options import PAPER_MESH, Options
from pdeface.pictures.skin import skin
from pdeface.pictures.solid import Solid, merge
from pdeface.pictures.tubes import tube
from pdeface.uvmesh import FaceMesh

__all__ = ["uvmesh"]

WHITE: Final = (0.93, 0.93, 0.94)
INK: Final = np.array([0.13, 0.19, 0.29])
WIDTH: Final = 1.3
"""Width of a line in a picture 1000 pixels high, pixels."""


def uvmesh(face: Face, camera: Camera, options: Options) -> list[Solid]:
    """The mesh with every edge drawn, hidden where the face hides it."""
    mesh = options.sample(face, otherwise=PAPER_MESH)
    solids = skin(mesh, WHITE, camera, rig_named(options.light or "gallery"))
    return [*solids, _edges(mesh, 0.5 * WIDTH * camera.pixel_size(1000))]


def _edges(mesh: FaceMesh, radius: float) -> Solid:
    grid = mesh.vertices.reshape(*mesh.grid, 3)
    lines = [*grid, *grid.transpose(1, 0, 2)]
    return merge([tube(line, radius, INK) for line in lines])
