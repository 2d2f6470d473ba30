"""Heads to photograph together with what is known of them."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from scipy.spatial import cKDTree

from benchmarks.accuracy.scoring import EXTENT, SEVEN, Scan
from pdeface.photo.build.heads import Head, HeadSpace

POINTS = 6000
BESIDE, BEFORE = 1e-3, 5e-3


@dataclass(frozen=True, eq=False)
class Subject:
    """A head that is known.

    Attributes:
        name: for tables.
        scan: of the neutral head.
        head: as it is photographed, with whatever expression.
    """

    name: str
    scan: Scan
    head: Head


class Spread:
    """Points spread evenly over the face of a head, at the same places of others with its mesh."""

    def __init__(self, head: Head, marks: np.ndarray) -> None:
        """The points are those on a head's face, and ``marks`` its vertices at the landmarks."""
        uv = head.texcoords[:, ::-1] * (1.0, np.pi)
        away = np.abs(uv[:, 1] - np.pi / 2)
        face = (uv[:, 0] > 0.0) & (uv[:, 0] < 0.93) & (uv[:, 1] > 0.0) & (away < EXTENT)
        triangles = head.skin[face[head.skin].all(axis=1)]
        a, b, c = (head.vertices[triangles[:, k]] for k in range(3))
        area = np.linalg.norm(np.cross(b - a, c - a), axis=1)
        rng = np.random.default_rng(0)
        chosen = rng.choice(len(triangles), POINTS, p=area / area.sum())
        self._corners = triangles[chosen]
        self._weights = rng.dirichlet(np.ones(3), POINTS)
        seen = in_sight(self._between(head.vertices), lattice(head.vertices, head.skin))
        self._corners, self._weights = self._corners[seen], self._weights[seen]
        self._uv = self._between(uv)
        self._marks, self._marks_uv = marks, uv[marks]

    def scan(self, vertices: np.ndarray) -> Scan:
        """The scan of a head with these vertices."""
        return Scan(self._between(vertices), self._uv, vertices[self._marks], self._marks_uv)

    def _between(self, values: np.ndarray) -> np.ndarray:
        return np.einsum("nk,nkx->nx", self._weights, values[self._corners])


def lattice(vertices: np.ndarray, triangles: np.ndarray, parts: int = 4) -> np.ndarray:
    """(n, 3) points on triangles whose sides are cut into so many parts."""
    steps = np.array([(i, j, parts - i - j) for i in range(parts + 1)
                      for j in range(parts + 1 - i)]) / parts  # fmt: skip
    return np.einsum("pk,tkx->tpx", steps, vertices[triangles]).reshape(-1, 3)


def in_sight(points: np.ndarray, surface: np.ndarray) -> np.ndarray:
    """(n,) whether no point of the surface lies before a point: not in a nostril or the mouth."""
    beside = cKDTree(surface[:, :2]).query_ball_point(points[:, :2], BESIDE)
    heights = [surface[near, 2].max(initial=-np.inf) for near in beside]
    return np.asarray(heights) < points[:, 2] + BEFORE


class Randoms:
    """ICT-FaceKit's random people."""

    def __init__(self, folder: Path) -> None:
        self.space = HeadSpace(folder)
        self._spread = Spread(self.space.neutral, self.space.landmarks[list(SEVEN)])

    def subject(self, identity: np.ndarray, expression: np.ndarray, name: str) -> Subject:
        """A person with an expression."""
        scan = self._spread.scan(self.space.head(identity).vertices)
        return Subject(name, scan, self.space.head(identity, expression))
