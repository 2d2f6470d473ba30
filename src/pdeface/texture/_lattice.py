"""Steps 4 and 5 in one: where in the photo each node of a regular lattice over (u, v) lies.

The paper warps the photo first and reads the uv mesh's nodes off the result. Here the two maps are
joined, so that the photo is resampled once: the two-pass warp takes a node's place on the grid to
its place in the photo.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from pdeface import template
from pdeface.texture import _meshes, _spline
from pdeface.texture._grid import ScaledGrid
from pdeface.texture._point_checks import POINT_NAMES
from pdeface.texture._smooth import step

__all__ = ["lattice_names", "outline", "photo_lattice"]

FloatArray = NDArray[np.float64]

ROWS, COLUMNS = 55, 41

_NODE_NAMES = [
    [
        ("" if row in range(1, 6) and column in range(1, 6) else "the node beyond ")
        + POINT_NAMES[min(max(row, 1), 5) - 1][min(max(column, 1), 5) - 1]
        for column in range(7)
    ]
    for row in range(7)
]


def outline(uv: FloatArray, u: FloatArray, v: FloatArray) -> tuple[FloatArray, ...]:
    """The face's outline in the photo, as the outer feature points draw it.

    Args:
        uv: (5, 5, 2) the feature points.
        u: (n,) increasing.
        v: (m,) increasing.

    Returns:
        (n,) v of its right and of its left side at ``u``, and (m,) u of the chin at ``v``; beyond
        their last points the lines go on straight.
    """
    right, left = (_hold(uv[:, side, 0], uv[:, side, 1], u) for side in (0, -1))
    return right, left, _hold(uv[-1, :, 1], uv[-1, :, 0], v)


def photo_lattice(
    source: FloatArray,
    target: FloatArray,
    uv: FloatArray,
    grid: ScaledGrid,
    opening: tuple[float, float] = (0.0, 0.0),
) -> tuple[FloatArray, FloatArray]:
    """A lattice over the uv mesh, and its places in the photo.

    Inside the outline, and up to the top of the forehead, a node lies where the warp takes it
    from. Beyond the outline the face turns away and the photo does not show it: the lattice goes
    on straight there, to the borders of the warp meshes.

    Args:
        source: (7, 7, 2) source mesh, level coordinates.
        target: (7, 7, 2) target mesh, level coordinates.
        uv: (5, 5, 2) the feature points on the face.
        grid: of step 1.
        opening: how far the mouth is open above and below its centre, pixels.

    Returns:
        (55, 41, 2) pixel positions in the photo, and (55, 41, 2) values (u, v).
    """
    u, v = np.linspace(0.0, 1.0, ROWS), np.linspace(0.0, np.pi, COLUMNS)
    right, left, chin = outline(uv, u, v)
    inside_v = np.clip(v[None, :], right[:, None], left[:, None])
    inside_u = np.minimum(u[:, None], chin[None, :])
    level = grid.level(inside_u, inside_v)
    places = _meshes.map_points(source, target, level.reshape(-1, 2), _NODE_NAMES)
    places = places.reshape(level.shape)
    places[..., 1] += _lips_apart(places[..., 0], u, source[4, 2:5:2, 0], uv, opening)
    # How far the meshes reach beyond the outline, on average: pixels per radian and per unit of u.
    reach_right = (source[1:-1, 1, 0] - source[1:-1, 0, 0]).mean() / uv[:, 0, 1].mean()
    reach_left = (source[1:-1, -1, 0] - source[1:-1, -2, 0]).mean() / (np.pi - uv[:, -1, 1].mean())
    reach_down = (source[-1, 1:-1, 1] - source[-2, 1:-1, 1]).mean() / (1.0 - uv[-1, :, 0].mean())
    places[..., 0] -= reach_right * np.maximum(inside_v - v, 0.0)
    places[..., 0] += reach_left * np.maximum(v - inside_v, 0.0)
    places[..., 1] += reach_down * (u[:, None] - inside_u)
    lattice = np.stack(np.broadcast_arrays(u[:, None], v[None, :]), axis=-1)
    return grid.to_photo(places), lattice


def lattice_names(uv: FloatArray) -> list[list[str]]:
    """What errors call the nodes of the lattice: by the feature point that is nearest."""
    u, v = np.linspace(0.0, 1.0, ROWS), np.linspace(0.0, np.pi, COLUMNS)
    away = np.hypot(
        u[:, None, None] - uv[..., 0].ravel(), (v[:, None] - uv[..., 1].ravel()) / np.pi
    )
    names = [f"the place by {name}" for row in POINT_NAMES for name in row]
    return [[names[k] for k in row] for row in away.argmin(axis=-1)]


def _lips_apart(
    x: FloatArray, u: FloatArray, corners: FloatArray, uv: FloatArray, opening: tuple[float, float]
) -> FloatArray:
    """Steps by which the rows of the lips part, so that what shows between them is left out.

    The face's mouth is closed: its two rows of the seam read the photo at the edges of the lips,
    and teeth end up in the gap between the rows. The opening is taken for an ellipse between the
    corners; the step fades out towards nose tip and chin.
    """
    upper, lower = template.row_u("mouth_seam_upper"), template.row_u("mouth_seam_lower")
    across = (2.0 * x - corners.sum()) / (corners[1] - corners[0])
    ellipse = np.sqrt(np.clip(1.0 - across**2, 0.0, None))
    above = step(0.0, 1.0, (u - uv[2, 2, 0]) / (upper - uv[2, 2, 0])) * (u <= upper + 1e-9)
    below = step(0.0, 1.0, (uv[4, 2, 0] - u) / (uv[4, 2, 0] - lower)) * (u >= lower - 1e-9)
    return ellipse * (opening[1] * below - opening[0] * above)[:, None]


def _hold(knots: FloatArray, values: FloatArray, at: FloatArray) -> FloatArray:
    """A curve through points, level beyond its ends."""
    curve = _spline.coefficients(knots, values)
    return _spline.evaluate(knots, curve, np.clip(at, knots[0], knots[-1]))
