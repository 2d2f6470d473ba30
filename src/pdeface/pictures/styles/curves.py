"""Style ``curves``: the boundary curves through their data points, all that the shape is."""

from __future__ import annotations

from dataclasses import replace
from typing import Final

import numpy as np
from numpy.typing import NDArray

from pdeface.face import Face
from pdeface.pictures.camera import Camera
from pdeface.pictures.light import rig_named
from pdeface.pictures.options import Options
from pdeface.pictures.skin import skin
from pdeface.pictures.solid import Solid, merge
from pdeface.pictures.tubes import balls, tube

__all__ = ["curves"]

FloatArray = NDArray[np.float64]

PORCELAIN: Final = (0.90, 0.905, 0.92)
CURVE: Final = np.array([0.11, 0.27, 0.46])
FAINT: Final = np.array([0.80, 0.83, 0.87])
POINT: Final = np.array([0.86, 0.33, 0.18])
LINE_WIDTH: Final = 2.2
POINT_WIDTH: Final = 6.0
"""Widths in a picture 1000 pixels high, for 28 curves; denser ones are drawn finer."""

SAMPLES: Final = 161
"""Points of a line from ear to ear."""


def curves(face: Face, camera: Camera, options: Options) -> list[Solid]:
    """The curves of the face on a pale surface that hides what lies behind it.

    With ``options.loops`` the closed curves, back halves included, and nothing else: what is
    farther off is fainter.
    """
    return _loops(face, camera) if options.loops else _front(face, camera, options)


def _front(face: Face, camera: Camera, options: Options) -> list[Solid]:
    # Curves cross the openings: the surface that they lie on is closed.
    closed = replace(options, openings="none").sample(face)
    ground = skin(closed, PORCELAIN, camera, rig_named(options.light or "gallery"))
    line, dot = _radii(face, camera)
    count = face.curves.shape[0]
    paths = face.mesh(count, SAMPLES, openings="none").vertices.reshape(count, -1, 3)
    lines = merge([tube(path, line, CURVE) for path in paths])
    return [*ground, lines, balls(face.moved_curves.half, dot, POINT, camera)]


def _loops(face: Face, camera: Camera) -> list[Solid]:
    line, dot = _radii(face, camera)
    count = face.curves.shape[0]
    paths = face.mesh(count, 2 * SAMPLES, extent="loop").vertices.reshape(count, -1, 3)
    points = face.moved_curves.points.reshape(-1, 3)
    lines = [tube(p, line, _faded(p, camera, points, CURVE), closed=True) for p in paths]
    return [merge(lines), balls(points, dot, _faded(points, camera, points, POINT), camera)]


def _radii(face: Face, camera: Camera) -> tuple[float, float]:
    """Radii of lines and dots, metres."""
    pixel = camera.pixel_size(1000)
    thin = min(1.0, (28.0 / face.curves.shape[0]) ** 0.5)
    return 0.5 * LINE_WIDTH * thin * pixel, 0.5 * POINT_WIDTH * thin * pixel


def _faded(points: FloatArray, camera: Camera, among: FloatArray, color: FloatArray) -> FloatArray:
    """(P, 3) colours, paler the farther from the camera compared with all points."""
    far = -((among - camera.position) @ camera.backward)
    depth = -((points - camera.position) @ camera.backward)
    share = np.clip((depth - far.min()) / max(float(np.ptp(far)), 1e-12), 0.0, 1.0)[:, None]
    return (1.0 - share) * color + share * FAINT
