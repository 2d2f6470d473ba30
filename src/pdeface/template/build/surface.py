"""A triangle mesh whose vertices are linear in the vertices of the head."""

from __future__ import annotations

from dataclasses import dataclass, replace

import igl
import numpy as np
import scipy.sparse as sp
from numpy.typing import NDArray

__all__ = ["LinkedMesh"]

FloatArray = NDArray[np.float64]
IndexArray = NDArray[np.int64]


@dataclass(frozen=True)
class LinkedMesh:
    """Triangles on the head, and how they follow it.

    Attributes:
        vertices: (V, 3) metres.
        triangles: (T, 3).
        links: (V, head vertices) sparse weights: a displacement of the head moves the mesh by
            ``links @ displacement``.
        plugged: (V,) whether a vertex closes a nostril, where the head has a hole.
    """

    vertices: FloatArray
    triangles: IndexArray
    links: sp.csr_matrix
    plugged: NDArray[np.bool_]

    def compacted(self) -> LinkedMesh:
        """Without the vertices that no triangle uses."""
        used, triangles = np.unique(self.triangles, return_inverse=True)
        return LinkedMesh(
            self.vertices[used],
            triangles.reshape(self.triangles.shape),
            self.links[used],
            self.plugged[used],
        )

    def largest_part(self) -> LinkedMesh:
        """The connected part with the most triangles."""
        parts = igl.facet_components(self.triangles)
        labels = np.asarray(parts[1] if isinstance(parts, tuple) else parts).ravel()
        largest = labels == np.bincount(labels).argmax()
        return replace(self, triangles=self.triangles[largest]).compacted()

    def normals(self) -> FloatArray:
        """(V, 3) unit normals."""
        return np.asarray(igl.per_vertex_normals(self.vertices, self.triangles))
