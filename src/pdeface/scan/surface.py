"""A scan as a value: points, the triangles between them if there are any, and their colours."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

__all__ = ["Scan", "unit"]

FloatArray = NDArray[np.float64]
IndexArray = NDArray[np.int64]

_NEIGHBOURS = 12
"""Neighbours by which a point of a cloud is given a normal and a reach."""


@dataclass(frozen=True, eq=False)
class Scan:
    """A head or face as a scanner saw it.

    Attributes:
        vertices: (V, 3) in the scan's own frame and unit.
        triangles: (T, 3) indices; none for a cloud of points.
        colors: (V, 3) uint8, or None.
        texcoords: (V, 2) top-left origin, or None.
        image: (H, W, 3) uint8 texture for them, or None.
        given_normals: (V, 3) normals that came with a cloud, or None.
    """

    vertices: FloatArray
    triangles: IndexArray
    colors: NDArray[np.uint8] | None = None
    texcoords: FloatArray | None = None
    image: NDArray[np.uint8] | None = None
    given_normals: FloatArray | None = None

    @property
    def is_cloud(self) -> bool:
        """Whether there are points alone."""
        return len(self.triangles) == 0

    @property
    def has_colors(self) -> bool:
        """Whether a colour is known at every vertex."""
        return self.colors is not None or self.image is not None

    @cached_property
    def normals(self) -> FloatArray:
        """(V, 3) unit normals; outwards if the triangles say so, of a cloud either way."""
        if self.given_normals is not None:
            return unit(self.given_normals)
        return _of_cloud(self.vertices, self._tree) if self.is_cloud else self._of_triangles()

    @property
    def _found_normals(self) -> FloatArray | None:
        """Normals that were given or worked out before."""
        return self.__dict__.get("normals", self.given_normals)

    @cached_property
    def _tree(self) -> Any:
        from scipy.spatial import cKDTree

        return cKDTree(self.vertices, balanced_tree=False, compact_nodes=False)

    @cached_property
    def spacing(self) -> float:
        """Median distance between neighbouring vertices."""
        if self.is_cloud:
            some = self.vertices[:: max(1, len(self.vertices) // 5000)]
            return float(np.median(self._tree.query(some, 2)[0][:, 1]))
        corners = self.triangles[:: max(1, len(self.triangles) // 20000)]
        edges = self.vertices[corners] - self.vertices[np.roll(corners, 1, axis=1)]
        return float(np.median(np.linalg.norm(edges, axis=-1)))

    def _of_triangles(self) -> FloatArray:
        """Normals weighed by area; vertices at one place, as at the seams of a texture, share."""
        a, b, c = (self.vertices[self.triangles[:, k]] for k in range(3))
        normals = np.cross(b - a, c - a)
        # Vertices at one place, as at the seams of a texture, are one.
        place = same_places(self.vertices) if self.texcoords is not None else None
        corners = (self.triangles if place is None else place[self.triangles]).ravel()
        count = len(self.vertices)
        sums = [np.bincount(corners, np.repeat(n, 3), count) for n in normals.T]
        total = unit(np.stack(sums, axis=1).astype(np.float64))
        return total if place is None else np.asarray(total[place])

    def moved(self, rotation: FloatArray, scale: float, shift: FloatArray) -> Scan:
        """The scan at ``scale * vertices @ rotation.T + shift``."""
        given = self._found_normals
        turned = None if given is None else given @ rotation.T
        vertices = scale * self.vertices @ rotation.T + shift
        return replace(self, vertices=vertices, given_normals=turned)

    def part(self, kept: NDArray[np.bool_], corners: int = 3) -> Scan:
        """Only these vertices, and the triangles with so many corners among them, whole."""
        whole = np.zeros(0, bool)
        if len(self.triangles):
            whole = sum(kept[corner].astype(np.int8) for corner in self.triangles.T) >= corners
            kept = kept.copy()
            kept[self.triangles[whole]] = True
        index = np.cumsum(kept) - 1

        def own(values: NDArray | None) -> NDArray | None:  # type: ignore[type-arg]
            return None if values is None else values[kept]

        return Scan(
            self.vertices[kept],
            index[self.triangles[whole]],
            own(self.colors),
            own(self.texcoords),
            self.image,
            # What was worked out on the whole stays right at the edge of the part; for a large
            # cloud it would take long.
            own(self._found_normals if self.is_cloud else self.normals),
        )

    def inside_out(self) -> Scan:
        """The same surface seen from its other side."""
        return replace(self, triangles=self.triangles[:, ::-1], given_normals=-self.normals)


def unit(vectors: FloatArray) -> FloatArray:
    """Vectors of length one; those of length zero stay as they are."""
    length = np.linalg.norm(vectors, axis=-1, keepdims=True)
    return np.asarray(vectors / np.where(length > 0.0, length, 1.0))


def same_places(vertices: FloatArray) -> IndexArray:
    """(V,) for each vertex the first one at the same place."""
    rows = np.ascontiguousarray(vertices).view(np.dtype((np.void, 24))).ravel()
    _, first, inverse = np.unique(rows, return_index=True, return_inverse=True)
    return np.asarray(first[inverse])


def _of_cloud(points: FloatArray, tree: Any) -> FloatArray:
    """Normals of planes through the neighbours of each point (either way round)."""
    normals = np.empty_like(points)
    count = min(_NEIGHBOURS, len(points))
    for start in range(0, len(points), 100_000):
        some = slice(start, start + 100_000)
        near = points[tree.query(points[some], count, workers=-1)[1].reshape(-1, count)]
        away = near - near.mean(axis=1, keepdims=True)
        normals[some] = flattest(away.swapaxes(1, 2) @ away)
    return normals


def flattest(spreads: FloatArray) -> FloatArray:
    """(n, 3) unit eigenvectors of the smallest eigenvalue of (n, 3, 3) symmetric matrices.

    In closed form, by the cosines of a third of an angle (Smith 1961), many times faster than a
    solver called n times: the eigenvector is the largest of the columns of the adjugate.
    """
    mean = np.trace(spreads, axis1=1, axis2=2) / 3.0
    off = spreads - mean[:, None, None] * np.eye(3)
    size = np.sqrt((off**2).sum(axis=(1, 2)) / 6.0)
    size = np.where(size > 0.0, size, 1.0)
    angle = np.arccos((0.5 * np.linalg.det(off / size[:, None, None])).clip(-1.0, 1.0)) / 3.0
    smallest = 2.0 * np.cos(angle + 2.0 * np.pi / 3.0)
    a, b, c = (off / size[:, None, None] - smallest[:, None, None] * np.eye(3)).swapaxes(0, 1)
    crosses = np.stack([np.cross(a, b), np.cross(b, c), np.cross(c, a)], axis=1)
    best = (crosses**2).sum(axis=2).argmax(axis=1)
    return unit(crosses[np.arange(len(crosses)), best])
