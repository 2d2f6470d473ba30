"""Flatten the cut face onto the unit square by two harmonic functions.

``s`` runs from the subject's right edge (0) to the left (1), ``t`` from the top (0) to the bottom
(1). Each is left free on the other pair of edges, so that lines of equal t meet the plane of
reflection at a right angle, as smooth closed curves must. A conductivity below 1 steepens a
function: more rows or columns fall on eyes, nose and mouth.
"""

from __future__ import annotations

from collections.abc import Sequence

import igl
import numpy as np
import scipy.sparse as sp
import scipy.sparse.linalg as spla
from numpy.typing import NDArray

from pdeface.template.build.cutting import BOTTOM, SIDE, TOP
from pdeface.template.build.surface import LinkedMesh

__all__ = ["Chart"]

FloatArray = NDArray[np.float64]
IndexArray = NDArray[np.int64]
Spot = tuple[float, float, float, float, float]

# Places that attract columns and rows: |x|, y, widths in x and y (metres), strength.
COLUMN_SPOTS: tuple[Spot, ...] = ((0.0, 0.005, 0.02, 0.025, 1.0), (0.031, 0.035, 0.02, 0.012, 0.7))
ROW_SPOTS: tuple[Spot, ...] = (
    (0.0, 0.0, 0.02, 0.02, 0.8),
    (0.031, 0.035, 0.022, 0.012, 0.8),
    (0.0, -0.036, 0.03, 0.012, 0.8),
)
ON_EDGE = 1e-7
# The square is searched at about the proportions of the face.
PROPORTIONS = np.array([0.28, 0.2])


class Chart:
    """The map between the unit square and the face.

    Attributes:
        mesh: the cut face.
        st: (V, 2) coordinates of its vertices.
    """

    def __init__(self, mesh: LinkedMesh) -> None:
        self.mesh = mesh
        self._normals = mesh.normals()
        side, top, bottom = (
            np.flatnonzero(np.abs(edge(mesh.vertices)) < ON_EDGE) for edge in (SIDE, TOP, BOTTOM)
        )
        left = (mesh.vertices[side, 0] > 0).astype(float)
        across = self._harmonic(COLUMN_SPOTS, side, left)
        ends = np.concatenate([np.zeros(len(top)), np.ones(len(bottom))])
        down = self._harmonic(ROW_SPOTS, np.concatenate([top, bottom]), ends)
        self.st = np.stack([across, down], axis=1)
        self._flat = np.column_stack([self.st * PROPORTIONS, np.zeros(len(self.st))])

    def _harmonic(self, spots: Sequence[Spot], fixed: IndexArray, values: FloatArray) -> FloatArray:
        laplacian = self._laplacian(self._conductivity(spots))
        free = np.setdiff1d(np.arange(len(self.mesh.vertices)), fixed)
        result = np.zeros(len(self.mesh.vertices))
        result[fixed] = values
        inner = laplacian[free]
        result[free] = spla.spsolve(inner[:, free].tocsc(), -inner[:, fixed] @ values)
        return result

    def _conductivity(self, spots: Sequence[Spot]) -> FloatArray:
        x, y, _ = self.mesh.vertices[self.mesh.triangles].mean(axis=1).T
        exponent = np.zeros(len(x))
        for at_x, at_y, width, height, strength in spots:
            distance = ((np.abs(x) - at_x) / width) ** 2 + ((y - at_y) / height) ** 2
            exponent -= strength * np.exp(-0.5 * distance)
        return np.exp(exponent)

    def _laplacian(self, conductivity: FloatArray) -> sp.csr_matrix:
        """Cotangent Laplacian with one conductivity per triangle."""
        triangles, vertices = self.mesh.triangles, self.mesh.vertices
        first, second, weights = [], [], []
        for k in range(3):
            i, j, opposite = (triangles[:, (k + step) % 3] for step in (1, 2, 0))
            a, b = vertices[i] - vertices[opposite], vertices[j] - vertices[opposite]
            cotangent = (a * b).sum(axis=1) / np.linalg.norm(np.cross(a, b), axis=1)
            # Slivers left by the cuts would outweigh everything else.
            weight = 0.5 * np.clip(cotangent, -3.0, 8.0) * conductivity
            first += [i, j]
            second += [j, i]
            weights += [weight, weight]
        entries = np.concatenate(weights), (np.concatenate(first), np.concatenate(second))
        near = sp.coo_matrix(entries, shape=(len(vertices), len(vertices))).tocsr()
        return (sp.diags(np.asarray(near.sum(axis=1)).ravel()) - near).tocsr()

    def anchors(self, s: FloatArray, t: FloatArray) -> tuple[IndexArray, FloatArray]:
        """(Q,) triangles and (Q, 3) barycentric coordinates of points of the square."""
        queries = np.stack([s.ravel(), np.clip(t.ravel(), 0.0, 1.0)], axis=1) * PROPORTIONS
        queries = np.column_stack([queries, np.zeros(len(queries))])
        _, triangle, closest = igl.point_mesh_squared_distance(
            queries, self._flat, self.mesh.triangles
        )
        return triangle, barycentric(closest, self._flat, self.mesh.triangles[triangle])

    def points(self, s: FloatArray, t: FloatArray) -> FloatArray:
        """Positions on the face; the shape of s and t, then 3.

        The triangles are bent to meet at their vertices' tangent planes (Boubekeur and Alexa,
        Phong Tessellation, 2008; weight 1/2 is exact on a circle), or dense curves would show the
        facets of the mesh.
        """
        triangle, weights = self.anchors(s, t)
        corners = self.mesh.vertices[self.mesh.triangles[triangle]]
        normals = self._normals[self.mesh.triangles[triangle]]
        flat = np.einsum("qc,qcx->qx", weights, corners)
        above = np.einsum("qcx,qcx->qc", flat[:, None] - corners, normals)
        bent = flat - 0.5 * np.einsum("qc,qc,qcx->qx", weights, above, normals)
        return bent.reshape(*np.shape(t), 3)

    def of(self, points: FloatArray) -> FloatArray:
        """(Q, 2) coordinates (s, t) of the points of the face nearest to given ones."""
        _, triangle, closest = igl.point_mesh_squared_distance(
            np.atleast_2d(points), self.mesh.vertices, self.mesh.triangles
        )
        corners = self.mesh.triangles[triangle]
        weights = barycentric(closest, self.mesh.vertices, corners)
        return np.einsum("qc,qcx->qx", weights, self.st[corners])


def barycentric(points: FloatArray, vertices: FloatArray, corners: IndexArray) -> FloatArray:
    """(Q, 3) barycentric coordinates of points on triangles."""
    a, b, c = (vertices[corners[:, k]] for k in range(3))
    ab, ac, ap = b - a, c - a, points - a
    bb, bc, cc = (ab * ab).sum(1), (ab * ac).sum(1), (ac * ac).sum(1)
    pb, pc = (ap * ab).sum(1), (ap * ac).sum(1)
    area = np.maximum(bb * cc - bc * bc, 1e-300)
    second, third = (cc * pb - bc * pc) / area, (bb * pc - bc * pb) / area
    weights = np.clip(np.stack([1.0 - second - third, second, third], axis=1), 0.0, 1.0)
    return weights / weights.sum(axis=1, keepdims=True)
