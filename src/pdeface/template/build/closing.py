"""Close the eyes, the lips and the nostrils of the head, so that it has a surface everywhere.

The openings are closed where they are seen: at the lid margins, at the line where the lips touch,
and just inside the rims of the nostrils. What closes them follows the skin around it, not what
lies behind, so that a strip between two lids closes when they do.
"""

from __future__ import annotations

from dataclasses import dataclass

import igl
import numpy as np
import scipy.sparse as sp
import scipy.sparse.linalg as spla
from numpy.typing import NDArray
from scipy.interpolate import LinearNDInterpolator
from scipy.spatial import Delaunay

from pdeface.template.build.head import Head
from pdeface.template.build.surface import LinkedMesh
from pdeface.template.build.topology import grow, holes, peel, split_loop, triangulate

__all__ = ["ClosedHead", "close_head"]

FloatArray = NDArray[np.float64]
IndexArray = NDArray[np.int64]

# Rings of faces between the edge of the mesh, behind the lids or lips, and the line that is seen.
LID_RINGS, LIP_RINGS, NOSTRIL_RINGS = 2, 8, 6
LONGEST_HOLE = 150
# Innermost vertices of the two nostrils.
NOSTRILS = (4888, 5346)
EYE_SPACING = 0.0012


@dataclass(frozen=True)
class ClosedHead:
    """The closed head and the lines along which it was closed.

    Attributes:
        mesh: the closed surface.
        lids: for each side, the upper and lower lid margin, (n, 3) points right to left.
        lips: the upper and lower line of contact, (n, 3) points right to left.
    """

    mesh: LinkedMesh
    lids: dict[str, tuple[FloatArray, FloatArray]]
    lips: tuple[FloatArray, FloatArray]


def close_head(head: Head) -> ClosedHead:
    """Close the openings of the head's face."""
    faces, loops = _openings(head)
    vertices, triangles = [head.vertices], [triangulate(faces)]
    links = [sp.identity(len(head.vertices), format="csr")]
    lids: dict[str, tuple[FloatArray, FloatArray]] = {}
    count = len(head.vertices)
    for side in ("right", "left"):
        loop = loops[side]
        inner, new_triangles, weights = _close_eye(head, loop, side)
        own = np.concatenate([loop, count + np.arange(len(inner))])
        vertices.append(inner)
        triangles.append(own[new_triangles])
        links.append(weights)
        count += len(inner)
        upper, lower = split_loop(loop, head.vertices)
        lids[side] = head.vertices[upper], head.vertices[lower]
    upper, lower = split_loop(loops["mouth"], head.vertices)
    triangles.append(_zip(upper, lower, head.vertices))
    mesh = LinkedMesh(
        np.concatenate(vertices),
        np.concatenate(triangles),
        sp.vstack(links).tocsr(),
        np.zeros(count, bool),
    )
    lips = head.vertices[upper], head.vertices[lower]
    return ClosedHead(_plug_nostrils(mesh, head).compacted(), lids, lips)


def _openings(head: Head) -> tuple[list[tuple[int, ...]], dict[str, list[int]]]:
    """The face without what lies behind its lids and lips, and the loops that remain."""
    faces = list(head.parts["M_Face"])
    loops = {}
    for hole in [h for h in holes(faces) if len(h) < LONGEST_HOLE]:
        x = head.vertices[hole, 0].mean()
        name = "mouth" if abs(x) < 0.005 else "left" if x > 0 else "right"
        rings = LIP_RINGS if name == "mouth" else LID_RINGS
        faces, loops[name] = peel(faces, hole, rings, head.vertices)
    return faces, loops


def _close_eye(
    head: Head, loop: list[int], side: str
) -> tuple[FloatArray, IndexArray, sp.csr_matrix]:
    """Vertices on the front of the eyeball, triangles between them and the lids, and weights
    of the lids' vertices in their displacement."""
    rim = head.vertices[loop]
    low, high = rim[:, :2].min(axis=0), rim[:, :2].max(axis=0)
    steps = [np.arange(a, b, EYE_SPACING) for a, b in zip(low, high, strict=True)]
    points = np.stack(np.meshgrid(*steps), axis=-1).reshape(-1, 2)
    clear = np.linalg.norm(points[:, None] - rim[None, :, :2], axis=2).min(axis=1) > 0.0009
    points = points[clear & _inside(points, rim[:, :2])]
    depth = _eyeball_depth(head, side, points)
    points, depth = points[np.isfinite(depth)], depth[np.isfinite(depth)]
    plane = np.concatenate([rim[:, :2], points])
    triangles = Delaunay(plane).simplices.astype(np.int64)
    triangles = triangles[_inside(plane[triangles].mean(axis=1), rim[:, :2])]
    a, b, c = (plane[triangles[:, k]] for k in range(3))
    backward = (b - a)[:, 0] * (c - a)[:, 1] < (b - a)[:, 1] * (c - a)[:, 0]
    triangles[backward] = triangles[backward, ::-1]
    flat = np.column_stack([plane, np.zeros(len(plane))])
    laplacian = igl.cotmatrix(flat, triangles).tocsr()
    n = len(loop)
    harmonic = spla.spsolve(laplacian[n:, n:].tocsc(), -laplacian[n:, :n].toarray())
    weights = sp.lil_matrix((len(points), len(head.vertices)))
    weights[:, loop] = harmonic
    return np.column_stack([points, depth]), triangles, weights.tocsr()


def _eyeball_depth(head: Head, side: str, points: FloatArray) -> FloatArray:
    """z of the front of the eyeball at each (x, y)."""
    depth = np.full(len(points), -np.inf)
    for part in ("M_Sclera", "M_Iris"):
        used = np.unique(np.concatenate(head.parts[part + side.capitalize()]))
        ball = head.vertices[used]
        front = ball[ball[:, 2] > ball[:, 2].mean()]
        depth = np.fmax(depth, LinearNDInterpolator(front[:, :2], front[:, 2])(points))
    return depth


def _inside(points: FloatArray, polygon: FloatArray) -> NDArray[np.bool_]:
    """Whether each (x, y) lies inside a polygon, by counting crossings."""
    x, y = points[:, 0, None], points[:, 1, None]
    x0, y0 = polygon.T
    x1, y1 = np.roll(polygon, -1, axis=0).T
    with np.errstate(divide="ignore", invalid="ignore"):
        crosses = ((y0 > y) != (y1 > y)) & (x < x0 + (y - y0) * (x1 - x0) / (y1 - y0))
    return crosses.sum(axis=1) % 2 == 1


def _zip(upper: list[int], lower: list[int], vertices: FloatArray) -> IndexArray:
    """Triangles between two lines that share their ends."""
    i = j = 0
    triangles = []
    while i < len(upper) - 1 or j < len(lower) - 1:
        ahead = j == len(lower) - 1 or (
            i < len(upper) - 1 and vertices[upper[i + 1], 0] <= vertices[lower[j + 1], 0]
        )
        triangles.append((upper[i], lower[j], upper[i + 1] if ahead else lower[j + 1]))
        i, j = (i + 1, j) if ahead else (i, j + 1)
    return np.array([t for t in triangles if len(set(t)) == 3])


def _plug_nostrils(mesh: LinkedMesh, head: Head) -> LinkedMesh:
    """Replace the inside of the nostrils by the smoothest membrane that continues their rims."""
    inside = sorted(set().union(*(grow(head.parts["M_Face"], n, NOSTRIL_RINGS) for n in NOSTRILS)))
    edges = np.concatenate([mesh.triangles[:, pair] for pair in ([0, 1], [1, 2], [2, 0])])
    count = len(mesh.vertices)
    near = sp.coo_matrix((np.ones(len(edges)), edges.T), shape=(count, count)).tocsr()
    near = ((near + near.T) > 0).astype(float)
    laplacian = sp.diags(np.asarray(near.sum(axis=1)).ravel()) - near
    bending = (laplacian @ laplacian).tocsr()[inside]
    rim = np.setdiff1d(np.unique(bending.indices), inside)
    weights = spla.splu(bending[:, inside].tocsc()).solve(-bending[:, rim].toarray())
    vertices, links = mesh.vertices.copy(), mesh.links.tolil()
    vertices[inside] = weights @ vertices[rim]
    links[inside] = sp.csr_matrix(weights) @ mesh.links[rim]
    plugged = mesh.plugged.copy()
    plugged[inside] = True
    return LinkedMesh(vertices, mesh.triangles, links.tocsr(), plugged)
