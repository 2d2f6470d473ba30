"""The face's own proportions, seen from the front.

The rows and columns of the uv mesh are not evenly spaced on the face (rows crowd at the lids and
lips, columns at the midline), and towards the ears the face turns away from the camera. What lies
between and beyond the feature points is therefore read off the neutral face as the camera sees it,
stretched to the photo's feature points.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pdeface.texture import _spline

__all__ = ["Front", "neutral_front", "refine", "uv_front"]

FloatArray = NDArray[np.float64]

Front = Callable[[FloatArray, FloatArray], FloatArray]
"""(..., 2) positions (x to the image right, y down, any unit) of points (u, v) of the face."""

SLOWEST = 0.2
"""Least speed along a mesh line, as part of the mean: lines neither stop nor turn back."""

_SAMPLES = 257


def neutral_front(u: FloatArray, v: FloatArray) -> FloatArray:
    """The neutral face, seen from the front; metres."""
    from pdeface import template
    from pdeface.pde import PDESurface

    points = PDESurface(template.neutral_curves("28x46").points)(u, v)
    return np.stack([points[..., 0], -points[..., 1]], axis=-1)


def uv_front(u: FloatArray, v: FloatArray) -> FloatArray:
    """A flat face whose rows and columns are evenly spaced: the paper's proportions."""
    return np.stack(np.broadcast_arrays(v / np.pi, u), axis=-1)


def refine(
    source: FloatArray, uv: FloatArray, front: Front, parts: int
) -> tuple[FloatArray, FloatArray]:
    """Divide every cell of both warp meshes into ``parts`` x ``parts``.

    The new nodes lie on the meshes' splines. Along a line, the source follows the distances that
    ``front`` has between the nodes.

    Args:
        source: (R, C, 2) nodes in the photo.
        uv: (R, C, 2) the same nodes as (u, v).
        front: the face seen from the front.
        parts: divisions of a cell's side.

    Returns:
        Source nodes, and their (u, v): ((R - 1) parts + 1, (C - 1) parts + 1, 2) each.
    """
    source, uv = _refine_lines(source, uv, front, parts, 0)
    source, uv = source.transpose(1, 0, 2), uv.transpose(1, 0, 2)
    source, uv = _refine_lines(source, uv, front, parts, 1)
    return source.transpose(1, 0, 2), uv.transpose(1, 0, 2)


def _refine_lines(
    source: FloatArray, uv: FloatArray, front: Front, parts: int, axis: int
) -> tuple[FloatArray, FloatArray]:
    """Divide the lines that run along the first axis, on which ``uv[..., axis]`` increases."""
    count = len(uv)
    steps = np.linspace(0.0, count - 1.0, (count - 1) * parts + 1)
    fine_source, fine_uv = (np.empty((len(steps), uv.shape[1], 2)) for _ in range(2))
    for line in range(uv.shape[1]):
        knots = uv[:, line, axis]
        at = np.interp(steps, np.arange(count), knots)
        fine_uv[:, line, axis] = at
        fine_uv[:, line, 1 - axis] = _curve(knots, uv[:, line, 1 - axis], at)
        seen = _distances(uv[:, line], front, axis)
        for coordinate in range(2):
            values = source[:, line, coordinate]
            fine_source[:, line, coordinate] = _curve(seen(knots), values, seen(at))
    return fine_source, fine_uv


def _distances(line: FloatArray, front: Front, axis: int) -> Callable[[FloatArray], FloatArray]:
    """How far along a line of nodes the face, seen from the front, has come at each parameter."""
    knots = line[:, axis]
    samples = np.linspace(knots[0], knots[-1], _SAMPLES)
    other = _curve(knots, line[:, 1 - axis], samples)
    u, v = (samples, other) if axis == 0 else (other, samples)
    steps = np.diff(front(u, v)[:, 1 - axis])
    steps = np.maximum(steps, SLOWEST * max(steps.mean(), 1e-12))
    distance = np.concatenate([[0.0], np.cumsum(steps)])

    def seen(at: FloatArray) -> FloatArray:
        return _curve(samples, distance, at)

    return seen


def _curve(knots: Any, values: Any, at: FloatArray) -> FloatArray:
    return _spline.evaluate(knots, _spline.coefficients(knots, values), at)
