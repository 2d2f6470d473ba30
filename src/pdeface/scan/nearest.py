"""The places of a scan nearest to given ones, and those nearest in place and direction together."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from pdeface.scan.surface import Scan, unit

__all__ = ["Nearest", "Target", "flat"]

FloatArray = NDArray[np.float64]
IndexArray = NDArray[np.int64]

_FINEST = 2.0e-3
"""Metres between the places by which triangles are looked up: larger triangles have several."""

_MOST_PARTS = 12
_CANDIDATES = 4


class Nearest(NamedTuple):
    """Places on a scan.

    Attributes:
        points, normals: (n, 3), on flat triangles, and interpolated.
        corners, weights: (n, 3) vertices and barycentric coordinates.
        away: (n,) distance from what was asked for, metres.
    """

    points: FloatArray
    normals: FloatArray
    corners: IndexArray
    weights: FloatArray
    away: FloatArray

    def bent(self, scan: Scan, share: float) -> FloatArray:
        """(n, 3) the places, those on triangles bent towards their vertices' tangent planes.

        Boubekeur and Alexa, Phong Tessellation, 2008; share 1/2 is exact on a circle.
        """
        if scan.is_cloud or share == 0.0:
            return self.points
        corners, normals = scan.vertices[self.corners], scan.normals[self.corners]
        above = np.einsum("nci,nci->nc", self.points[:, None] - corners, normals)
        return self.points - share * np.einsum("nc,nc,nci->ni", self.weights, above, normals)


class Target:
    """A scan in which nearest places are looked for, metres.

    Args:
        scan: outwards, in the frame of the template.
        breadth: what a right angle between normals counts as, divided by 1.4; metres. 0 looks at
            places alone.
    """

    def __init__(self, scan: Scan, breadth: float = 0.0) -> None:
        from scipy.spatial import cKDTree

        self.scan, self.breadth = scan, breadth
        if scan.is_cloud:
            self._owner = np.arange(len(scan.vertices))
            places, normals = scan.vertices, scan.normals
        else:
            self._owner, weights = _parts(scan)
            corners = scan.triangles[self._owner]
            places = np.einsum("pc,pci->pi", weights, scan.vertices[corners])
            normals = unit(np.einsum("pc,pci->pi", weights, scan.normals[corners]))
        keys = np.concatenate([places, breadth * normals], axis=1) if breadth else places
        self._tree = cKDTree(keys, balanced_tree=False, compact_nodes=False)

    def nearest(self, points: FloatArray, normals: FloatArray | None = None) -> Nearest:
        """The place nearest to each of (n, 3) points; of like normal if there is a breadth."""
        count = min(_CANDIDATES, len(self._owner))
        keys = points
        if self.breadth:
            assert normals is not None
            keys = np.concatenate([points, self.breadth * normals], axis=1)
        _, found = self._tree.query(keys, count, workers=-1)
        found = self._owner[found.reshape(len(points), count)]
        if self.scan.is_cloud:
            return self._in_cloud(points, found)
        corners = self.scan.triangles[found]
        feet, weights = _feet(points, self.scan.vertices[corners])
        facing = unit(np.einsum("nkc,nkci->nki", weights, self.scan.normals[corners]))
        cost = ((feet - points[:, None]) ** 2).sum(axis=2)
        if self.breadth:
            assert normals is not None
            cost = cost + self.breadth**2 * ((facing - normals[:, None]) ** 2).sum(axis=2)
        best = cost.argmin(axis=1)
        row = np.arange(len(points))
        foot = feet[row, best]
        away = np.linalg.norm(foot - points, axis=1)
        return Nearest(foot, facing[row, best], corners[row, best], weights[row, best], away)

    def _in_cloud(self, points: FloatArray, found: IndexArray) -> Nearest:
        """The foot on the plane through the neighbours of each point."""
        near, facing = self.scan.vertices[found], self.scan.normals[found]
        share = 1.0 / (((near - points[:, None]) ** 2).sum(axis=2) + (0.5 * self.scan.spacing) ** 2)
        share /= share.sum(axis=1, keepdims=True)
        middle = np.einsum("nk,nki->ni", share, near)
        normal = unit(np.einsum("nk,nki->ni", share, facing))
        off = points - middle
        slide = off - (off * normal).sum(axis=1, keepdims=True) * normal
        length = np.linalg.norm(slide, axis=1, keepdims=True)
        reach = np.maximum(self.scan.spacing, 1e-9)
        foot = middle + slide * np.minimum(1.0, reach / np.maximum(length, 1e-12))
        away = np.linalg.norm(foot - points, axis=1)
        return Nearest(foot, normal, found[:, :3], share[:, :3], away)


def flat(grid: NDArray[np.floating]) -> FloatArray:
    """(n, 3) of a grid of places."""
    return np.ascontiguousarray(grid, dtype=np.float64).reshape(-1, 3)


def _parts(scan: Scan) -> tuple[IndexArray, FloatArray]:
    """(P,) triangles, the large ones several times, and (P, 3) places in them."""
    corner = scan.vertices[scan.triangles]
    sides = [((corner[:, k] - corner[:, k - 1]) ** 2).sum(axis=1) for k in range(3)]
    longest = np.sqrt(np.maximum(np.maximum(sides[0], sides[1]), sides[2]))
    times = np.ceil(longest / max(_FINEST, scan.spacing)).clip(1, _MOST_PARTS).astype(np.int64)
    owners, weights = [], []
    for n in np.unique(times).tolist():
        own = np.flatnonzero(times == n)
        inside = _middles(n)
        owners.append(np.repeat(own, len(inside)))
        weights.append(np.tile(inside, (len(own), 1)))
    return np.concatenate(owners), np.concatenate(weights)


def _middles(n: int) -> FloatArray:
    """(n^2, 3) middles of the parts of a triangle whose sides are cut into n."""
    upright = [(i + 1 / 3, j + 1 / 3) for i in range(n) for j in range(n - i)]
    turned = [(i + 2 / 3, j + 2 / 3) for i in range(n) for j in range(n - i - 1)]
    b, c = np.array(upright + turned).T / n
    return np.stack([1.0 - b - c, b, c], axis=1)


def _feet(points: FloatArray, corners: FloatArray) -> tuple[FloatArray, FloatArray]:
    """The nearest place of triangles.

    Args:
        points: (n, 3).
        corners: (n, k, 3, 3).

    Returns:
        (n, k, 3) places and (n, k, 3) barycentric coordinates.
    """
    a = corners[..., 0, :]
    ab, ac = corners[..., 1, :] - a, corners[..., 2, :] - a
    ap = points[:, None] - a
    bb, bc, cc = ((x * y).sum(axis=-1) for x, y in ((ab, ab), (ab, ac), (ac, ac)))
    pb, pc = (ap * ab).sum(axis=-1), (ap * ac).sum(axis=-1)
    area = np.maximum(bb * cc - bc * bc, 1e-300)
    b, c = (cc * pb - bc * pc) / area, (bb * pc - bc * pb) / area
    outside = (b < 0.0) | (c < 0.0) | (b + c > 1.0)
    # Outside, the nearest place is on one of the edges: AB, AC or BC.
    on_b = (pb / np.maximum(bb, 1e-300)).clip(0.0, 1.0)
    on_c = (pc / np.maximum(cc, 1e-300)).clip(0.0, 1.0)
    side = bb - 2.0 * bc + cc
    on_bc = ((pc - pb + bb - bc) / np.maximum(side, 1e-300)).clip(0.0, 1.0)
    zero = np.zeros_like(b)
    edges = np.stack([np.stack([on_b, zero], -1), np.stack([zero, on_c], -1),
                      np.stack([1.0 - on_bc, on_bc], -1)])  # fmt: skip
    x, y = edges[..., 0], edges[..., 1]
    cost = x * x * bb + 2.0 * x * y * bc + y * y * cc - 2.0 * (x * pb + y * pc)
    best = cost.argmin(axis=0)
    chosen = np.take_along_axis(edges, best[None, ..., None], axis=0)[0]
    b, c = np.where(outside, chosen[..., 0], b), np.where(outside, chosen[..., 1], c)
    return a + b[..., None] * ab + c[..., None] * ac, np.stack([1.0 - b - c, b, c], axis=-1)
