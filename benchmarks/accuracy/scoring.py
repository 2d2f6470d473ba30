"""Distance from a scan to a face, as the NoW challenge measures it, and by region as REALY does.

The face is scaled, turned and moved by seven landmarks (the corners of the eyes and of the mouth
and the base of the nose), then turned and moved, no longer scaled, until the scan's points are as
near to its surface as may be. What counts is how far each point of the scan is from the surface.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.spatial import cKDTree

import pdeface

DENSE, SPACING = (217, 325), 1e-3
ROUNDS, FAR = 12, 0.02
HELD = 1e-4
"""How much a step of the alignment is held back, so that a flat region does not slide away."""

SEVEN = (36, 39, 42, 45, 33, 48, 54)
"""The seven landmarks among the 68 of Multi-PIE, counted from 0."""

REGIONS = {
    "nose": ((0.26, 0.56), (0.0, 0.36)),
    "mouth": ((0.58, 0.80), (0.0, 0.62)),
    "forehead": ((0.0, 0.12), (0.0, 1.0)),
    "cheeks": ((0.40, 0.80), (0.66, 1.15)),
}
"""Ranges of u and of the distance from the midline in v, radians."""

EXTENT = 1.2
"""The part of a scan that counts reaches so far from the midline in v, radians."""


@dataclass(frozen=True, eq=False)
class Scan:
    """What is known of a head.

    Attributes:
        points: (n, 3) points spread evenly over the neutral face, metres.
        uv: (n, 2) about where on the face they are.
        seven: (7, 3) the landmarks.
        seven_uv: (7, 2) where on the face these are.
    """

    points: np.ndarray
    uv: np.ndarray
    seven: np.ndarray
    seven_uv: np.ndarray

    def within(self, name: str) -> np.ndarray:
        """(n,) which points lie in a region."""
        (top, bottom), (near, far) = REGIONS[name]
        u, away = self.uv[:, 0], np.abs(self.uv[:, 1] - np.pi / 2)
        return (top <= u) & (u <= bottom) & (near <= away) & (away <= far)


class Score:
    """Distances of a scan's points from a face, metres.

    Args:
        face: any.
        scan: the truth.
        scaled: whether the seven landmarks scale the face, or only turn and move it.

    Attributes:
        all: (n,) after the rigid alignment on all points.
        regions: the same for each region alone, aligned on its own points.
    """

    def __init__(self, face: pdeface.Face, scan: Scan, scaled: bool = True) -> None:
        mesh = face.mesh(*DENSE, openings="none")
        marks = face.surface()(*scan.seven_uv.T)
        scale, turn, shift = similarity(marks, scan.seven, scaled)
        self._vertices = scale * mesh.vertices @ turn.T + shift
        self._normals = mesh.normals @ turn.T
        self._tree = cKDTree(self._vertices)
        points = self._aligned(scan.points)
        self.all = self._distances(points)[0]
        self.regions = {}
        for name in REGIONS:
            part = self._aligned(points[scan.within(name)])
            self.regions[name] = self._distances(part)[0]
        del self._vertices, self._normals, self._tree  # a hundred scores would fill the memory

    def _aligned(self, points: np.ndarray) -> np.ndarray:
        """The points turned and moved onto the surface, by point-to-plane steps."""
        for _ in range(ROUNDS):
            distance, nearest = self._distances(points)
            use = distance < FAR
            near, normal = self._vertices[nearest[use]], self._normals[nearest[use]]
            middle = points.mean(axis=0)
            slopes = np.hstack([np.cross(points[use] - middle, normal), normal])
            off = np.einsum("ni,ni->n", near - points[use], normal)
            held = HELD * use.sum() * np.array([1e-2, 1e-2, 1e-2, 1e2, 1e2, 1e2])
            step = np.linalg.solve(slopes.T @ slopes + np.diag(held), slopes.T @ off)
            points = (points - middle) @ rotation(step[:3]).T + middle + step[3:]
        return points

    def _distances(self, points: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """(n,) distances from the surface, and the vertices that are nearest."""
        _, nearest = self._tree.query(points)
        away = points - self._vertices[nearest]
        along = np.einsum("ni,ni->n", away, self._normals[nearest])
        across = np.linalg.norm(away - along[:, None] * self._normals[nearest], axis=1)
        return np.hypot(along, np.maximum(across - SPACING, 0.0)), nearest


def similarity(
    points: np.ndarray, onto: np.ndarray, scaled: bool = True
) -> tuple[float, np.ndarray, np.ndarray]:
    """Scale, rotation and shift that bring points nearest to their partners."""
    middle, target = points.mean(axis=0), onto.mean(axis=0)
    left, sizes, right = np.linalg.svd((onto - target).T @ (points - middle))
    flip = np.array([1.0, 1.0, np.sign(np.linalg.det(left @ right))])
    turn = left * flip @ right
    scale = float((sizes * flip).sum() / ((points - middle) ** 2).sum()) if scaled else 1.0
    return scale, turn, target - scale * turn @ middle


def rotation(turn: np.ndarray) -> np.ndarray:
    """(3, 3) rotation about a short vector by its length, radians."""
    x, y, z = turn
    cross = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    left, _, right = np.linalg.svd(np.eye(3) + cross + 0.5 * cross @ cross)
    return left @ right
