"""Where the eyes look, as angles and as the eight ``eyeLook`` weights."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from pdeface.controls.arkit import EYE_RANGE

__all__ = ["EYE_RANGE", "eye_angles", "look_weights"]

FloatArray = NDArray[np.float64]

# Below this weight (a degree and a half) a look sets in gently, so that weights have no corner
# where the eyes pass straight ahead and one of a pair takes over from the other.
_GENTLE = 0.05


def look_weights(yaw: FloatArray, pitch: FloatArray) -> dict[str, FloatArray]:
    """Weights, by ARKit name, of both eyes turned by ``yaw`` and ``pitch`` relative to the head.

    Args:
        yaw: (T,) radians, positive to the subject's left.
        pitch: (T,) radians, positive downwards.
    """
    left, right = _positive(yaw / EYE_RANGE), _positive(-yaw / EYE_RANGE)
    down, up = _positive(pitch / EYE_RANGE), _positive(-pitch / EYE_RANGE)
    return {
        "eyeLookOutLeft": left,
        "eyeLookInRight": left,
        "eyeLookInLeft": right,
        "eyeLookOutRight": right,
        "eyeLookDownLeft": down,
        "eyeLookDownRight": down,
        "eyeLookUpLeft": up,
        "eyeLookUpRight": up,
    }


def eye_angles(weights: dict[str, FloatArray]) -> FloatArray:
    """(T, 3) yaw, pitch and roll of both eyes under the weights of :func:`look_weights`."""
    yaw = weights["eyeLookOutLeft"] - weights["eyeLookInLeft"]
    pitch = weights["eyeLookDownLeft"] - weights["eyeLookUpLeft"]
    return np.stack([yaw, pitch, np.zeros_like(yaw)], axis=-1) * EYE_RANGE


def _positive(values: FloatArray) -> FloatArray:
    """max(0, x) without its corner, at most 1."""
    share = np.clip(values / _GENTLE, 0.0, 1.0)
    gentle = _GENTLE * share**2 * (2.0 - share)
    return np.minimum(np.where(values < _GENTLE, gentle, values), 1.0)
