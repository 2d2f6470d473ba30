"""Displacements that fold the face, taken back where they do."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from pdeface.curves import BoundaryCurves, mirror_points
from pdeface.face import Face
from pdeface.template import row_u
from pdeface.uvmesh import FaceMesh

__all__ = ["moved", "unfolded"]

FloatArray = NDArray[np.float64]

_MESH, _UPRIGHT = (109, 163), 0.3
_SHRINK, _REACH, _TRIES = 0.4, 0.017, 16
"""How much of a displacement is taken back at a fold and, in metres, around it; how often."""


def unfolded(face: Face, half: FloatArray) -> FloatArray:
    """(K, M, 3) the displacement of these front halves, less of it where it folds the face."""
    curves, count = face.curves.shape
    half = half.reshape(curves, count // 2, 3)
    points = face.curves.points[:, : count // 2]
    before = face.mesh(*_MESH, openings="none")
    for _ in range(_TRIES):
        after = moved(face, mirror_points(half)).mesh(*_MESH, openings="none")
        folds = _folds(before, after)
        if not len(folds):
            return mirror_points(half)
        away = np.linalg.norm(points[:, :, None] - folds, axis=-1).min(axis=-1)
        half = half * (1.0 - _SHRINK * np.exp(-0.5 * (away / _REACH) ** 2))[..., None]
    return np.zeros_like(face.curves.points)


def moved(face: Face, residual: FloatArray) -> Face:
    """The face through its curves and their displacement."""
    curves = face.curves
    return face.with_curves(BoundaryCurves(curves.points + residual, curves.mirror_z))


def _folds(before: FaceMesh, after: FaceMesh) -> FloatArray:
    """(n, 3) where the surface has turned over, but between the lips, which touch."""
    upright = np.einsum("ni,ni->n", before.normals, after.normals).reshape(_MESH)
    row = np.linspace(0.0, 1.0, _MESH[0])
    lips = (row_u("upper_lip_border") < row) & (row < row_u("lower_lip_border"))
    folded = (upright < _UPRIGHT) & ~lips[:, None]
    return np.asarray(before.vertices.reshape(*_MESH, 3)[folded])
