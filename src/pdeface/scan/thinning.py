"""Scans with fewer vertices, for pictures that would not show the rest."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from pdeface.scan.surface import Scan

__all__ = ["thinned"]


def thinned(scan: Scan, cell: float) -> Scan:
    """One vertex for all that lie in each cube of a side of ``cell``, in the middle of them.

    Its colour, texture coordinates and normal are those of the first.
    Triangles that end up with two corners at one place are left out.
    """
    low = scan.vertices.min(axis=0)
    places = np.floor((scan.vertices - low) / cell).astype(np.int64)
    size = places.max(axis=0) + 1
    if np.prod(size.astype(np.float64)) > 2.0**62:
        return scan
    keys = (places[:, 0] * size[1] + places[:, 1]) * size[2] + places[:, 2]
    _, first, of = np.unique(keys, return_index=True, return_inverse=True)
    triangles = of[scan.triangles]
    a, b, c = triangles.T
    triangles = triangles[(a != b) & (b != c) & (c != a)]

    def own(values: NDArray | None) -> NDArray | None:  # type: ignore[type-arg]
        return None if values is None else values[first]

    colors, texcoords, normals = own(scan.colors), own(scan.texcoords), own(scan.given_normals)
    sums = [np.bincount(of, places) for places in scan.vertices.T]
    vertices = np.stack(sums, axis=1) / np.bincount(of)[:, None]
    return Scan(vertices, triangles, colors, texcoords, scan.image, normals)
