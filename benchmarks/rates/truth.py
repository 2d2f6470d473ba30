"""The front of a scan, and how far an approximation is from it, both ways.

Nothing is judged by its rim: what is compared is the front less some millimetres, so that the cut
edge of a coarse mesh costs it nothing.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import igl
import numpy as np

from pdeface.pde import GridEvaluator
from pdeface.scan import ScanFit
from pdeface.scan.measures import FRONT
from pdeface.scan.nearest import Target
from pdeface.scan.surface import Scan, unit

SAMPLES = 30_000
ROWS, COLUMNS = 271, 241
RIM_V, RIM_U = 0.08, 0.03
ON_EDGE = 1e-6
NEAR, BRIDGE, ALIKE = 5.0e-3, 0.5e-3, 0.5
"""Metres, and cosine of an angle, beyond which a place is none of the face's outside."""


class Mesh(NamedTuple):
    """(V, 3) vertices, (T, 3) triangles and (V, 3) normals; (V, 2) u and v where they are known."""

    vertices: np.ndarray
    triangles: np.ndarray
    normals: np.ndarray
    uv: np.ndarray | None = None


class Errors(NamedTuple):
    """Two-way root mean square distance, mm, and the median angle between normals, degrees."""

    rms: float
    normal: float


@dataclass(frozen=True)
class Truth:
    """The front of a scan.

    Attributes:
        mesh: all of it, which a mesh codec is given.
        inner: (T,) triangles that are compared.
        points, normals: samples on these, evenly over their area.
        open: (T, 3) whether the side opposite to a corner is an edge of the mesh.
        tree: of the mesh.
    """

    mesh: Mesh
    inner: np.ndarray
    points: np.ndarray
    normals: np.ndarray
    open: np.ndarray
    tree: igl.AABB

    def errors(self, other: Mesh) -> Errors:
        """How far another surface is from this one."""
        squared, triangle, feet = nearest(other, tree(other), self.points)
        facing = normals_at(other, triangle, feet)
        angle = np.degrees(np.arccos((facing * self.normals).sum(axis=1).clip(-1.0, 1.0)))
        places, _ = sampled(other, np.ones(len(other.triangles), bool))
        back, triangle, feet = nearest(self.mesh, self.tree, places)
        within = self.inner[triangle] & ~self.beside(triangle, feet)
        both = 0.5 * (squared.mean() + back[within].mean())
        return Errors(1e3 * float(np.sqrt(both)), float(np.median(angle)))

    def beside(self, triangle: np.ndarray, feet: np.ndarray) -> np.ndarray:
        """Whether nearest places are on edges of the mesh: nearest to what lies beyond them."""
        return ((shares(self.mesh, triangle, feet) < ON_EDGE) & self.open[triangle]).any(axis=1)


def front_of(fit: ScanFit) -> Truth:
    """The front of a fitted scan; ``fit`` says where on it the face's (u, v) lie."""
    scan = fit.scan
    grid = surface_of(fit)
    assert grid.uv is not None
    found = Target(Scan(grid.vertices, grid.triangles)).nearest(scan.vertices)
    uv = np.einsum("nc,nci->ni", found.weights, grid.uv[found.corners])
    alike = (found.normals * scan.normals).sum(axis=1)
    kept = (found.away < NEAR) & ((found.away < BRIDGE) | (alike > ALIKE))
    kept &= (uv[:, 1] > FRONT[0]) & (uv[:, 1] < FRONT[1]) & (uv[:, 0] > 0.0) & (uv[:, 0] < 1.0)
    triangles = scan.triangles[kept[scan.triangles].all(axis=1)]
    used, triangles = np.unique(triangles, return_inverse=True)
    mesh = Mesh(scan.vertices[used], triangles.reshape(-1, 3), scan.normals[used], uv[used])
    corner = uv[used][mesh.triangles]
    inner = (np.abs(corner[..., 1] - 0.5 * np.pi) < 0.5 * np.pi - FRONT[0] - RIM_V).all(axis=1)
    inner &= (np.abs(corner[..., 0] - 0.5) < 0.5 - RIM_U).all(axis=1)
    return Truth(mesh, inner, *sampled(mesh, inner), edges(mesh.triangles), tree(mesh))


def surface_of(fit: ScanFit) -> Mesh:
    """The smooth surface of a fit as a dense mesh, its normals exact."""
    curves = fit.face.curves
    u, v = np.linspace(0.0, 1.0, ROWS), np.linspace(0.0, np.pi, COLUMNS)
    points, normals = GridEvaluator(curves.shape, u, v).positions_and_normals(curves.points)
    return gridded(points, normals, u, v)


def gridded(points: np.ndarray, normals: np.ndarray, u: np.ndarray, v: np.ndarray) -> Mesh:
    """A (U, V, 3) grid as a mesh, facing forwards."""
    index = np.arange(points.shape[0] * points.shape[1]).reshape(points.shape[:2])
    a, b, c, d = index[:-1, :-1], index[1:, :-1], index[1:, 1:], index[:-1, 1:]
    triangles = np.concatenate([np.stack([a, b, c], -1), np.stack([a, c, d], -1)]).reshape(-1, 3)
    uv = np.stack(np.meshgrid(u, v, indexing="ij"), axis=-1).reshape(-1, 2)
    return Mesh(
        np.array(points, np.float64).reshape(-1, 3),
        triangles,
        np.array(normals, np.float64).reshape(-1, 3),
        uv,
    )


def tree(mesh: Mesh) -> igl.AABB:
    made = igl.AABB()
    made.init(mesh.vertices, mesh.triangles)
    return made


def nearest(mesh: Mesh, known: igl.AABB, points: np.ndarray) -> tuple[np.ndarray, ...]:
    """Squared distances, triangles and places nearest to points."""
    return known.squared_distance(mesh.vertices, mesh.triangles, points)


def normals_at(mesh: Mesh, triangle: np.ndarray, feet: np.ndarray) -> np.ndarray:
    """Interpolated normals at places in triangles."""
    share = shares(mesh, triangle, feet).clip(0.0, 1.0)
    return unit(np.einsum("nc,nci->ni", share, mesh.normals[mesh.triangles[triangle]]))


def shares(mesh: Mesh, triangle: np.ndarray, feet: np.ndarray) -> np.ndarray:
    """(n, 3) barycentric coordinates of places in triangles."""
    a, b, c = (mesh.vertices[mesh.triangles[triangle, k]] for k in range(3))
    whole = np.cross(b - a, c - a)
    area = (whole**2).sum(axis=1).clip(1e-300)
    first = (np.cross(b - feet, c - feet) * whole).sum(axis=1) / area
    second = (np.cross(c - feet, a - feet) * whole).sum(axis=1) / area
    return np.stack([first, second, 1.0 - first - second], axis=1)


def edges(triangles: np.ndarray) -> np.ndarray:
    """(T, 3) whether the side opposite to each corner belongs to one triangle alone."""
    sides = np.sort(np.stack([triangles[:, [1, 2]], triangles[:, [2, 0]], triangles[:, [0, 1]]], 1))
    _, which, count = np.unique(
        sides.reshape(-1, 2), axis=0, return_inverse=True, return_counts=True
    )
    return count[which].reshape(-1, 3) == 1


def sampled(mesh: Mesh, chosen: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Places spread evenly over some triangles, always the same, and the normals there."""
    triangles = np.flatnonzero(chosen)
    a, b, c = (mesh.vertices[mesh.triangles[triangles, k]] for k in range(3))
    area = np.linalg.norm(np.cross(b - a, c - a), axis=1)
    random = np.random.default_rng(0)
    ends = np.cumsum(area) / area.sum()
    which = np.searchsorted(ends, (np.arange(SAMPLES) + 0.5) / SAMPLES).clip(0, len(ends) - 1)
    r, s = np.sqrt(random.random(SAMPLES)), random.random(SAMPLES)
    share = np.stack([1.0 - r, r * (1.0 - s), r * s], axis=1)
    corners = mesh.triangles[triangles[which]]
    points = np.einsum("nc,nci->ni", share, mesh.vertices[corners])
    return points, unit(np.einsum("nc,nci->ni", share, mesh.normals[corners]))
