"""Cut the face out of the closed head by three planes: in front of the ears, under the hairline
and under the jaw."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import scipy.sparse as sp
from numpy.typing import NDArray

from pdeface.template.build.surface import LinkedMesh

__all__ = ["BOTTOM", "MIRROR_Z", "SIDE", "TOP", "cut_face"]

FloatArray = NDArray[np.float64]
Plane = Callable[[FloatArray], FloatArray]

MIRROR_Z = 0.021
"""Plane of reflection, metres: just in front of the tragus, so that no curve meets an ear."""


def SIDE(points: FloatArray) -> FloatArray:
    """Distance in front of the plane of reflection."""
    return points[:, 2] - MIRROR_Z


def TOP(points: FloatArray) -> FloatArray:
    """Height below a plane that falls towards the temples, as a hairline does."""
    return 0.106 - 0.22 * (0.09 - points[:, 2]) - points[:, 1]


def BOTTOM(points: FloatArray) -> FloatArray:
    """Height above a plane that rises along the jaw towards the ears."""
    return points[:, 1] + 0.092 - 0.48 * (0.10 - points[:, 2])


def cut_face(mesh: LinkedMesh) -> LinkedMesh:
    """The part of the closed head that the boundary curves describe."""
    for plane in (SIDE, TOP, BOTTOM):
        mesh = _cut(mesh, plane(mesh.vertices)).compacted().largest_part()
    return mesh


def _cut(mesh: LinkedMesh, height: FloatArray) -> LinkedMesh:
    """Keep what lies at or above height 0, with new vertices where an edge crosses it."""
    keep = height >= 0.0
    corners = keep[mesh.triangles].sum(axis=1)
    crossing: dict[tuple[int, int], int] = {}
    polygons = []
    for triangle in mesh.triangles[(corners == 1) | (corners == 2)].tolist():
        polygon = []
        for a, b in zip(triangle, triangle[1:] + triangle[:1], strict=True):
            if keep[a]:
                polygon.append(a)
            if keep[a] != keep[b]:
                edge = (min(a, b), max(a, b))
                polygon.append(crossing.setdefault(edge, len(height) + len(crossing)))
        polygons += [(polygon[0], polygon[k], polygon[k + 1]) for k in range(1, len(polygon) - 1)]
    ends = np.array(list(crossing))
    share = height[ends[:, 0]] / (height[ends[:, 0]] - height[ends[:, 1]])
    between = sp.csr_matrix(
        (
            np.concatenate([1.0 - share, share]),
            (np.tile(np.arange(len(ends)), 2), ends.T.ravel()),
        ),
        shape=(len(ends), len(height)),
    )
    return replace(
        mesh,
        vertices=np.concatenate([mesh.vertices, between @ mesh.vertices]),
        triangles=np.concatenate([mesh.triangles[corners == 3], polygons]),
        links=sp.vstack([mesh.links, between @ mesh.links]).tocsr(),
        plugged=np.concatenate([mesh.plugged, np.zeros(len(ends), bool)]),
    )
