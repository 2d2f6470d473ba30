"""Round lines and dots as triangles, so that they are hidden and lit as everything else is."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from pdeface.pictures.camera import Camera
from pdeface.pictures.solid import Solid

__all__ = ["balls", "tube"]

FloatArray = NDArray[np.float64]
SIDES = 6


def tube(path: FloatArray, radius: float, color: FloatArray, closed: bool = False) -> Solid:
    """A tube of ``radius`` along a path.

    Args:
        path: (P, 3) metres, P >= 2.
        color: (3,) or (P, 3) sRGB, 0 to 1.
        closed: join the last point to the first.
    """
    path = np.asarray(path, dtype=np.float64)
    count = len(path)
    side, other = _cross_axes(_tangents(path, closed))
    angle = np.arange(SIDES) * (2.0 * np.pi / SIDES)
    spokes = np.cos(angle)[:, None] * side[:, None] + np.sin(angle)[:, None] * other[:, None]
    vertices = (path[:, None] + radius * spokes).reshape(-1, 3)
    colors = np.repeat(np.broadcast_to(color, (count, 3)), SIDES, axis=0)
    return Solid(vertices, _ring_triangles(count, closed), colors)


def _tangents(path: FloatArray, closed: bool) -> FloatArray:
    """Unit tangents by central differences."""
    if closed:
        steps = np.roll(path, -1, axis=0) - np.roll(path, 1, axis=0)
    else:
        steps = np.gradient(path, axis=0)
    length = np.linalg.norm(steps, axis=1, keepdims=True)
    return np.asarray(steps / np.maximum(length, 1e-300))


def _cross_axes(tangents: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Two axes across each tangent, carried along the path so that the tube does not twist."""
    side = np.empty_like(tangents)
    last = np.eye(3)[np.argmin(np.abs(tangents[0]))]
    for k, tangent in enumerate(tangents):
        last = last - (last @ tangent) * tangent
        last = last / max(float(np.linalg.norm(last)), 1e-12)
        side[k] = last
    return side, np.cross(tangents, side)


def _ring_triangles(count: int, closed: bool) -> NDArray[np.int32]:
    """Triangles between neighbouring rings, anticlockwise from outside."""
    ring = np.arange(count if closed else count - 1)[:, None]
    after = (ring + 1) % count
    k = np.arange(SIDES)[None, :]
    a, b = ring * SIDES + k, ring * SIDES + (k + 1) % SIDES
    c, d = after * SIDES + (k + 1) % SIDES, after * SIDES + k
    quads = np.stack([a, b, c, d], axis=-1).reshape(-1, 4)
    return np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]]).astype(np.int32)


def balls(
    centres: FloatArray, radius: float, color: FloatArray, camera: Camera, rings: int = 3
) -> Solid:
    """Half balls that face the camera, a radius in front of their points.

    There a surface through the points cuts none of a ball off, even where it is seen edge on.

    Args:
        centres: (B, 3) metres.
        color: (3,) or (B, 3) sRGB, 0 to 1.
    """
    unit, triangles = _dome(rings, sides=12)
    axes = np.stack([camera.right, camera.up, camera.backward])
    shape = radius * (unit @ axes + camera.backward)
    centres = np.asarray(centres, dtype=np.float64).reshape(-1, 3)
    vertices = (centres[:, None] + shape).reshape(-1, 3)
    starts = (np.arange(len(centres)) * len(unit))[:, None, None]
    colors = np.repeat(np.broadcast_to(color, (len(centres), 3)), len(unit), axis=0)
    return Solid(vertices, (triangles + starts).reshape(-1, 3).astype(np.int32), colors)


def _dome(rings: int, sides: int) -> tuple[FloatArray, NDArray[np.int64]]:
    """Unit half ball around +Z: its pole, then rings of ``sides`` points down to the rim."""
    polar = np.linspace(0.0, np.pi / 2.0, rings + 1)[1:]
    around = np.arange(sides) * (2.0 * np.pi / sides)
    p, q = np.meshgrid(polar, around, indexing="ij")
    points = np.stack([np.sin(p) * np.cos(q), np.sin(p) * np.sin(q), np.cos(p)], axis=-1)
    unit = np.concatenate([[[0.0, 0.0, 1.0]], points.reshape(-1, 3)])
    k = np.arange(sides)
    after = (k + 1) % sides
    faces = [np.stack([0 * k, 1 + k, 1 + after], axis=1)]
    for ring in range(rings - 1):
        inner, outer = 1 + ring * sides, 1 + (ring + 1) * sides
        faces.append(np.stack([inner + k, outer + k, outer + after], axis=1))
        faces.append(np.stack([inner + k, outer + after, inner + after], axis=1))
    return unit, np.concatenate(faces)
