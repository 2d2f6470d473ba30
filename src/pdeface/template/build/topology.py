"""Holes of a polygon mesh, and the rings of vertices around them."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Sequence

import numpy as np
from numpy.typing import NDArray

__all__ = ["grow", "holes", "peel", "split_loop", "triangulate"]

FloatArray = NDArray[np.float64]
IndexArray = NDArray[np.int64]
Face = tuple[int, ...]


def triangulate(faces: Iterable[Face]) -> IndexArray:
    """(T, 3) triangles of convex polygons."""
    return np.array([(f[0], f[k], f[k + 1]) for f in faces for k in range(1, len(f) - 1)])


def holes(faces: Sequence[Face]) -> list[list[int]]:
    """Boundary loops, each in order."""
    directed = {(a, b) for f in faces for a, b in zip(f, (*f[1:], f[0]), strict=True)}
    follower = {b: a for a, b in directed if (b, a) not in directed}
    loops = []
    while follower:
        start, vertex = follower.popitem()
        loop = [start]
        while vertex != start:
            loop.append(vertex)
            vertex = follower.pop(vertex)
        loops.append(loop)
    return loops


def peel(
    faces: list[Face], loop: list[int], rings: int, vertices: FloatArray
) -> tuple[list[Face], list[int]]:
    """Widen a hole by so many rings of faces; returns the faces left and the new loop."""
    centre = vertices[loop].mean(axis=0)
    for _ in range(rings):
        gone = set(loop)
        faces = [f for f in faces if not gone & set(f)]
        loop = min(
            holes(faces), key=lambda h: float(np.linalg.norm(vertices[h] - centre, axis=1).max())
        )
    return faces, loop


def grow(faces: Iterable[Face], seed: int, rings: int) -> set[int]:
    """Vertices within so many rings of a vertex."""
    neighbours: dict[int, set[int]] = defaultdict(set)
    for face in faces:
        for vertex in face:
            neighbours[vertex].update(face)
    grown = {seed}
    for _ in range(rings):
        grown = set().union(*(neighbours[v] for v in grown))
    return grown


def split_loop(loop: list[int], vertices: FloatArray) -> tuple[list[int], list[int]]:
    """Upper and lower half of an opening's loop, both from the subject's right corner to the
    left one, corners included."""
    x = vertices[loop, 0]
    right = int(np.argmin(x))
    loop = loop[right:] + loop[:right]
    left = int(np.argmax(vertices[loop, 0]))
    one, other = loop[: left + 1], [loop[0], *loop[: left - 1 : -1]]
    if vertices[one, 1].mean() > vertices[other, 1].mean():
        return one, other
    return other, one
