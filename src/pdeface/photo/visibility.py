"""How well a photo shows each place of a face: turned to the camera, and with nothing before it."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from pdeface.texture._smooth import blur, step

__all__ = ["trust"]

FloatArray = NDArray[np.floating[Any]]

_GRAZING, _FACING = 0.25, 0.60
"""Cosines of the angle to the line of sight below which a place is not trusted, and above which
it is."""

_SOFT = 4.0
"""Nodes over which the facing is averaged: an edge of a nostril is not an edge of the face."""

_CELL = 0.002
"""Metres along a side of a cell of the depth buffer."""

_BEHIND = 0.006
"""Metres that a place may lie behind what is nearest in its cell: cells are not small."""


def trust(points: FloatArray, normals: FloatArray, distance: float) -> FloatArray:
    """(R, C) how far each node of a face can be trusted to be what the camera sees, 0 to 1.

    Args:
        points: (R, C, 3) in the camera's axes (z towards it), metres from the face's origin.
        normals: (R, C, 3) unit normals.
        distance: of the camera from the origin.
    """
    sight = np.array([0.0, 0.0, distance]) - points
    sight = sight / np.linalg.norm(sight, axis=-1, keepdims=True)
    facing = blur((normals * sight).sum(axis=-1), _SOFT)
    return np.asarray(step(_GRAZING, _FACING, facing) * _unhidden(points, distance))


def _unhidden(points: FloatArray, distance: float) -> FloatArray:
    """(R, C) 1 where nothing of the face is in front, by a buffer of the nearest depths."""
    near = distance / (distance - points[..., 2])
    across = points[..., :2] * near[..., None]
    cell = np.floor((across - across.min(axis=(0, 1))) / _CELL).astype(np.intp)
    width, height = cell.max(axis=(0, 1)) + 1
    nearest = np.full((height, width), -np.inf)
    np.maximum.at(nearest, (cell[..., 1], cell[..., 0]), points[..., 2])
    behind = nearest[cell[..., 1], cell[..., 0]] - points[..., 2]
    return step(0.4, 0.9, blur((behind < _BEHIND).astype(np.float32), 1.5))
