"""PLY, binary: vertices with normals and texture coordinates, triangles or quads.

Written by hand, with numpy alone: trimesh, the library that could, has triangles only, names no
texture and takes longer to import than this takes to run.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from pdeface.face import Face
from pdeface.files import PathLike, atomic_write
from pdeface.formats._companion import write_texture_beside
from pdeface.formats._sample import Sample
from pdeface.formats._shared import GENERATOR

__all__ = ["write_ply"]

_PROPERTIES = ("x", "y", "z", "nx", "ny", "nz", "s", "t")


def write_ply(face: Face, surface: Sample, path: PathLike, *, quads: bool = False) -> None:
    """Write a little-endian PLY, and its texture, if any, beside it.

    Texture coordinates s and t have their origin at the bottom left, as readers of PLY expect.

    Raises:
        InputError: a place that cannot be written.
    """
    vertices = np.concatenate(
        [surface.vertices, surface.normals, surface.texcoords_from_below], axis=1
    )
    cells = [surface.quads, surface.fans] if quads else [surface.triangles]
    header = _header(len(vertices), sum(map(len, cells)), write_texture_beside(path, face))
    body = b"".join([vertices.astype("<f4").tobytes(), *map(_faces, cells)])
    atomic_write(path, header + body)


def _faces(cells: NDArray[np.int32]) -> bytes:
    corners = cells.shape[1]
    faces = np.empty(len(cells), [("count", "u1"), ("indices", "<i4", corners)])
    faces["count"], faces["indices"] = corners, cells
    return faces.tobytes()


def _header(vertices: int, faces: int, texture: str | None) -> bytes:
    lines = ["ply", "format binary_little_endian 1.0", f"comment {GENERATOR}, metres"]
    if texture is not None:
        lines.append(f"comment TextureFile {texture}")
    lines.append(f"element vertex {vertices}")
    lines += [f"property float {name}" for name in _PROPERTIES]
    lines += [f"element face {faces}", "property list uchar int vertex_indices", "end_header", ""]
    return "\n".join(lines).encode()
