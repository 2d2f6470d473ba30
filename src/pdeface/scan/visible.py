"""The part of a scan that is the face's outside: what can be seen from in front of it."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from pdeface.scan.raster import look
from pdeface.scan.surface import Scan

__all__ = ["outside"]

FloatArray = NDArray[np.float64]

_VIEWS = ((0, 0), (35, 0), (-35, 0), (70, 0), (-70, 0), (0, 35), (0, -35), (95, 0), (-95, 0))
"""Azimuth and elevation, degrees."""

_PIXELS = 320
_REACH = np.array([0.125, 0.15, 0.13])
_MIDDLE = np.array([0.0, 0.005, 0.06])
_BEHIND = 0.8e-3
"""Metres that a vertex may lie behind what is seen at its place."""

_FACING = 0.05


def outside(scan: Scan) -> Scan:
    """What of a scan may be skin: near the face, seen from outside, and facing outwards.

    Mouths, eye sockets and teeth behind the lips are left out. A scan that is inside out is turned,
    and the normals of a cloud made to face whoever sees them.

    Args:
        scan: in the frame of the template, metres.
    """
    near = (np.abs(scan.vertices - _MIDDLE) < _REACH).all(axis=1)
    scan = scan.part(near)
    views = [_view(scan, *np.radians(view)) for view in _VIEWS]
    if not scan.is_cloud:
        seen, facing, _ = views[0]
        if seen.any() and np.median(facing[seen]) < 0.0:
            scan = scan.inside_out()
            views = [(seen, -facing, axis) for seen, facing, axis in views]
        kept = np.any([seen & (facing > _FACING) for seen, facing, _ in views], axis=0)
        # Rims of lids and lips have triangles with a corner out of sight.
        return scan.part(kept, corners=2)
    sides = np.array([np.where(seen, facing, 0.0) for seen, facing, _ in views])
    clearest = np.abs(sides).argmax(axis=0)
    sign = np.sign(sides[clearest, np.arange(len(scan.vertices))])
    turned = Scan(
        scan.vertices, scan.triangles, scan.colors, given_normals=scan.normals * sign[:, None]
    )
    return turned.part(sign != 0.0)


def _view(
    scan: Scan, azimuth: float, elevation: float
) -> tuple[NDArray[np.bool_], FloatArray, FloatArray]:
    """Which vertices are seen from there, how far they face it, and the direction."""
    c, s, e, h = np.cos(azimuth), np.sin(azimuth), np.cos(elevation), np.sin(elevation)
    forward, right = np.array([s * e, h, c * e]), np.array([c, 0.0, -s])
    axes = np.stack([right, np.cross(forward, right), forward])
    seen = look(scan, axes, _MIDDLE, 2.2 * _REACH.max(), (_PIXELS, _PIXELS))
    x, y = (np.floor(seen.pixels[:, k] - 0.5).astype(np.int64) for k in (0, 1))
    x, y = x.clip(0, _PIXELS - 2), y.clip(0, _PIXELS - 2)
    front = np.min([seen.depth[y + j, x + i] for j in (0, 1) for i in (0, 1)], axis=0)
    return seen.pixels[:, 2] > front - _BEHIND, scan.normals @ forward, forward
