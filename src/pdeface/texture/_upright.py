"""Photos that were taken on their side, or of a head held very askew, set upright."""

from __future__ import annotations

import math
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pdeface.texture.points import FeaturePoints
from pdeface.texture.warp import Engine, warp

__all__ = ["MOST_TILT", "set_upright"]

MOST_TILT = math.radians(5.0)
"""Up to here the warp undoes the tilt itself, and the photo is resampled once, not twice."""


def set_upright(
    photo: NDArray[Any], points: FeaturePoints, engine: Engine = "auto"
) -> tuple[NDArray[Any], FeaturePoints]:
    """The photo and its points, turned so that the eyes are level to within ``MOST_TILT``.

    Quarter turns move pixels unchanged; what remains above ``MOST_TILT`` is resampled.
    """
    quarters = round(points.tilt / (0.5 * math.pi)) % 4
    for _ in range(quarters):
        height, width = photo.shape[:2]
        photo = np.rot90(photo)
        points = points.moved(partial(_quarter, width=width), (height, width))
    if abs(points.tilt) > MOST_TILT:
        photo, points = _turn(photo, points, engine)
    return photo, points


def _turn(
    photo: NDArray[Any], points: FeaturePoints, engine: Engine
) -> tuple[NDArray[Any], FeaturePoints]:
    """Resample the photo with its eyes level, in a frame that holds all of it."""
    height, width = photo.shape[:2]
    cos, sin = math.cos(points.tilt), math.sin(points.tilt)
    new_width = math.ceil(width * cos + height * abs(sin))
    new_height = math.ceil(height * cos + width * abs(sin))
    turn = np.array([[cos, -sin], [sin, cos]])
    old_middle, new_middle = np.array([width, height]) / 2.0, np.array([new_width, new_height]) / 2
    x, y = np.meshgrid([0.0, new_width], [0.0, new_height])
    frame = np.stack([x, y], axis=-1)
    mesh = (frame - new_middle) @ turn.T + old_middle
    turned = warp(photo, mesh, frame, (new_height, new_width), engine=engine)
    size = new_width, new_height
    return turned, points.moved(lambda p: (p - old_middle) @ turn + new_middle, size)


def _quarter(positions: NDArray[np.float64], width: int) -> NDArray[np.float64]:
    """Positions in an image of that width, turned anticlockwise with it by a quarter."""
    return np.stack([positions[:, 1], width - positions[:, 0]], axis=-1)
