"""The uv mesh as a camera sees it: the face's own proportions, from the front.

The rows and columns of the uv mesh are not evenly spaced on the face: rows crowd at the lids and
lips, columns at the midline, and towards the ears the face turns away. A straight grid, as the
paper lays over its photo, can be right at the feature points alone. The grid here is the neutral
face's uv mesh seen from the front, which is right between them as well.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from pdeface.pde import PDESurface

__all__ = ["Front", "neutral_front", "straight_front"]

FloatArray = NDArray[np.float64]

Front = Callable[[FloatArray, FloatArray], FloatArray]
"""(..., 2) positions (x to the image right, y down, in any unit) of points (u, v) of the face."""


def neutral_front(u: FloatArray, v: FloatArray) -> FloatArray:
    """The neutral face, seen from the front; metres."""
    points = _neutral_surface()(u, v)
    return np.stack([points[..., 0], -points[..., 1]], axis=-1)


def straight_front(u: FloatArray, v: FloatArray) -> FloatArray:
    """A flat face with evenly spaced rows and columns: the paper's straight grid."""
    return np.stack(np.broadcast_arrays(v / np.pi, u), axis=-1)


@lru_cache(maxsize=1)
def _neutral_surface() -> PDESurface:
    from pdeface import template

    return PDESurface(template.neutral_curves("28x46").points)
