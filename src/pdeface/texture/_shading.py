"""The light on a face: low-order spherical harmonics of the normal.

Skin reflects nearly as a matt surface does, and of any distant light such a surface shows no more
than the first nine harmonics (Basri and Jacobs 2003; Ramamoorthi and Hanrahan 2001).
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

__all__ = ["harmonics", "shading"]

FloatArray = NDArray[np.floating[Any]]

_GAMMA = 2.2
_LEAST, _MOST = 0.35, 2.2
"""How dark and how light a place may be taken to be lit, of the middle: estimates are not exact."""

_STIFFNESS = 0.01
_ROUNDS = 4


def harmonics(normals: FloatArray) -> FloatArray:
    """(..., 9) spherical harmonics up to order two of (..., 3) unit vectors, without factors."""
    x, y, z = np.moveaxis(normals, -1, 0)
    one = np.ones_like(x)
    return np.stack([one, x, y, z, x * y, y * z, x * z, x * x - y * y, 3.0 * z * z - 1.0], axis=-1)


def shading(colours: FloatArray, normals: FloatArray, weights: FloatArray) -> FloatArray:
    """(H, W) logarithm of how much lighter than the middle each texel is lit, as pixels show it.

    Args:
        colours: (H, W, 3) 0 to 255, sRGB.
        normals: (H, W, 3) unit normals in the camera's axes.
        weights: (H, W) 0 where a texel does not show lit skin.
    """
    light = (np.maximum(colours, 1.0) / 255.0) @ np.array([0.2126, 0.7152, 0.0722])
    linear = light**_GAMMA
    basis = harmonics(normals).astype(np.float64)
    rows, target, weight = basis.reshape(-1, 9), linear.ravel(), weights.ravel().astype(np.float64)
    if weight.sum() < 64.0:
        return np.zeros(weights.shape, np.float32)
    robust = np.ones_like(weight)
    for _ in range(_ROUNDS):
        share = weight * robust
        normal = (rows * share[:, None]).T @ rows
        stiff = _STIFFNESS * np.trace(normal) / 9.0 * np.diag([0.0, *[1.0] * 8])
        fitted = rows @ np.linalg.solve(normal + stiff, (rows * share[:, None]).T @ target)
        off = np.abs(target - fitted)
        spread = 1.5 * float(np.average(off, weights=weight)) + 1e-9
        robust = 1.0 / (1.0 + (off / spread) ** 2)
    middle = float(np.average(fitted, weights=weight))
    lit = np.clip(fitted / max(middle, 1e-6), _LEAST, _MOST)
    return np.asarray((np.log(lit) / _GAMMA).reshape(weights.shape), dtype=np.float32)
