"""How far a surface lies from the head that it was measured on, and whether it folds."""

from __future__ import annotations

from typing import Any, NamedTuple

import igl
import numpy as np
from numpy.typing import NDArray

from pdeface.pde import GridEvaluator
from pdeface.template.build.chart import barycentric
from pdeface.template.build.surface import LinkedMesh

__all__ = ["Accuracy", "folded_cells", "measure"]

FloatArray = NDArray[np.float64]

FRONT = (np.pi / 6, 5 * np.pi / 6)


class Accuracy(NamedTuple):
    """Distance of samples of the surface to the scan (mm) and angle of their normals (degrees).

    Attributes:
        rms, median, p95: distance over the front of the face.
        normal: median angle between the normals of surface and scan, there.
        folds: folded cells of the whole mesh.
    """

    rms: float
    median: float
    p95: float
    normal: float
    folds: int


def measure(points: FloatArray, scan: LinkedMesh, mesh: tuple[int, int] = (541, 321)) -> Accuracy:
    """Compare the smooth surface through curves with the scan.

    The front of the face is pi/6 <= v <= 5 pi/6. The nostrils count, though the scan is plugged
    there. The scan's normals are those of its vertices, interpolated.
    """
    u, v = np.linspace(0.0, 1.0, mesh[0]), np.linspace(0.0, np.pi, mesh[1])
    surface, normals = GridEvaluator(points.shape[:2], u, v).positions_and_normals(points)
    front = (v > FRONT[0]) & (v < FRONT[1])
    samples, directions = surface[:, front].reshape(-1, 3), normals[:, front].reshape(-1, 3)
    squared, triangle, closest = igl.point_mesh_squared_distance(
        np.ascontiguousarray(samples), scan.vertices, scan.triangles
    )
    corners = scan.triangles[triangle]
    weights = barycentric(closest, scan.vertices, corners)
    expected = np.einsum("qc,qcx->qx", weights, scan.normals()[corners])
    expected /= np.linalg.norm(expected, axis=1, keepdims=True)
    angle = np.degrees(np.arccos(np.clip((expected * directions).sum(axis=1), -1.0, 1.0)))
    distance = np.sqrt(squared) * 1e3
    return Accuracy(
        float(np.sqrt(np.mean(distance**2))),
        float(np.median(distance)),
        float(np.percentile(distance, 95)),
        float(np.median(angle)),
        folded_cells(surface),
    )


def folded_cells(grid: NDArray[np.floating[Any]]) -> int:
    """Cells of a (U, V, 3) grid whose two triangles face opposite ways."""
    a, b, c, d = grid[:-1, :-1], grid[1:, :-1], grid[1:, 1:], grid[:-1, 1:]
    first, second = np.cross(b - a, c - a), np.cross(c - a, d - a)
    return int(((first * second).sum(axis=-1) < 0.0).sum())
