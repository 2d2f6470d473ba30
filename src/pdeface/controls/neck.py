"""The neck: where a head turns, and by how much. The one movement of a face that bends no curve.

Angles are yaw, pitch and roll, radians, about the axes of docs/conventions.md: yaw about +Y (to the
subject's left), pitch about +X (down), roll about +Z (to the right shoulder).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

__all__ = ["PIVOT", "rotations"]

PIVOT = (0.0, -0.09, 0.0)
"""Where the head turns, metres: in the neck, below and behind the face."""


def rotations(angles: NDArray[np.float64]) -> NDArray[np.float64]:
    """(..., 3, 3) matrices ``R = R_y(yaw) R_x(pitch) R_z(roll)`` of (..., 3) angles."""
    (sy, sx, sz), (cy, cx, cz) = (np.moveaxis(f(angles), -1, 0) for f in (np.sin, np.cos))
    rows = (
        (cy * cz + sy * sx * sz, sy * sx * cz - cy * sz, sy * cx),
        (cx * sz, cx * cz, -sx),
        (cy * sx * sz - sy * cz, sy * sz + cy * sx * cz, cy * cx),
    )
    return np.stack([np.stack(row, axis=-1) for row in rows], axis=-2)
