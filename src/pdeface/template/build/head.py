"""Read the head mesh that the template is measured on (ICT-FaceKit)."""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from pdeface.errors import InputError

__all__ = ["Head", "load_head"]

FloatArray = NDArray[np.float64]
Face = tuple[int, ...]

CENTIMETRE = 0.01


@dataclass(frozen=True)
class Head:
    """A head mesh with named parts and landmarks.

    Attributes:
        vertices: (V, 3) metres, +Y up, +Z forward, +X the subject's left.
        parts: polygons by material name.
        landmarks: (68,) vertex of each Multi-PIE landmark.
    """

    vertices: FloatArray
    parts: dict[str, list[Face]]
    landmarks: NDArray[np.int64]

    def landmark(self, index: int) -> FloatArray:
        """(3,) position of a Multi-PIE landmark, counted from 0."""
        return np.asarray(self.vertices[self.landmarks[index]])


def load_head(folder: Path) -> Head:
    """Read ``generic_neutral_mesh.obj`` (centimetres) and ``vertex_indices.json``.

    Raises:
        InputError: a file is missing.
    """
    mesh, indices = folder / "generic_neutral_mesh.obj", folder / "vertex_indices.json"
    for path in (mesh, indices):
        if not path.is_file():
            raise InputError(
                f"the template is measured on ICT-FaceKit's neutral head; {path.name} is not in "
                f"{folder}; give the folder that holds it"
            )
    vertices: list[list[float]] = []
    parts: dict[str, list[Face]] = {}
    part: list[Face] = []
    for line in mesh.read_text().splitlines():
        words = line.split()
        if not words:
            continue
        if words[0] == "v":
            vertices.append([float(word) for word in words[1:4]])
        elif words[0] == "usemtl":
            part = parts.setdefault(words[1], [])
        elif words[0] == "f":
            part.append(tuple(int(word.split("/")[0]) - 1 for word in words[1:]))
    landmarks = json.loads(indices.read_text())["idx_to_landmark_verts"]
    return Head(np.array(vertices) * CENTIMETRE, parts, np.array(landmarks))
