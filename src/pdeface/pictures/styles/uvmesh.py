"""Style ``uvmesh``: the cells of a uv mesh on a white surface."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise
from typing import Final

import numpy as np
from numpy.typing import NDArray

from pdeface.face import Face
from pdeface.pictures.camera import Camera
from pdeface.pictures.light import rig_named
from pdeface.pictures.options import PAPER_MESH, Options
from pdeface.pictures.skin import skin
from pdeface.pictures.solid import Solid, merge
from pdeface.pictures.tubes import tube
from pdeface.uvmesh import FaceMesh

__all__ = ["uvmesh"]

FloatArray = NDArray[np.float64]

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
    return merge([tube(line, radius, INK) for line in _lines(mesh)])


def _lines(mesh: FaceMesh) -> Iterator[FloatArray]:
    """Rows and columns, each in as many pieces as openings leave of it, and slanting edges."""
    index = np.arange(len(mesh.vertices)).reshape(mesh.grid)
    edges = np.concatenate([mesh.quads[:, [k, (k + 1) % 4]] for k in range(4)])
    fans = np.concatenate([mesh.fans[:, [k, (k + 1) % 3]] for k in range(3)])
    drawn = {tuple(edge) for edge in np.sort(np.concatenate([edges, fans])).tolist()}
    for line in (*index.tolist(), *index.T.tolist()):
        start = 0
        for end, pair in enumerate(pairwise(line)):
            if pair in drawn:
                drawn.discard(pair)
                continue
            if end > start:
                yield mesh.vertices[line[start : end + 1]]
            start = end + 1
        if len(line) - 1 > start:
            yield mesh.vertices[line[start:]]
    for pair in sorted(drawn):
        yield mesh.vertices[list(pair)]
