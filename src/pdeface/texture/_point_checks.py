"""Names of the 25 feature points, and what can be wrong with their positions."""

from __future__ import annotations

import difflib
import math
from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pdeface.errors import InputError
from pdeface.template import FEATURE_POINTS

__all__ = [
    "NAMES",
    "OPTIONAL_NAMES",
    "POINT_NAMES",
    "check_inside",
    "check_lips",
    "check_names",
    "check_order",
    "check_position",
    "check_sides",
    "check_size",
]

FloatArray = NDArray[np.float64]

POINT_NAMES = tuple(FEATURE_POINTS[row : row + 5] for row in range(0, 25, 5))
"""Five rows of five, from the forehead to the chin and from the subject's right to left."""

NAMES = FEATURE_POINTS

OPTIONAL_NAMES = ("upper_lip", "lower_lip")
"""For an open mouth: the middle of the upper lip's lower edge, and of the lower lip's upper edge.

Not in the paper, whose photo has a closed mouth."""


def check_names(given: Mapping[str, object]) -> None:
    """Refuse missing and unknown names."""
    known = (*NAMES, *OPTIONAL_NAMES)
    for name in given:
        if name not in known:
            close = difflib.get_close_matches(str(name), known, n=1)
            hint = f"did you mean {close[0]}?" if close else f"the names are {', '.join(known)}"
            raise InputError(f"{name!r} is not one of the 25 feature points; {hint}")
    missing = [name for name in NAMES if name not in given]
    if missing:
        others = f" (and {len(missing) - 1} more)" if len(missing) > 1 else ""
        raise InputError(
            f"all 25 feature points are needed, {missing[0]}{others} is missing; place it"
        )
    lips = [name for name in OPTIONAL_NAMES if name in given]
    if len(lips) == 1:
        raise InputError(
            f"{' and '.join(OPTIONAL_NAMES)} go together, got only {lips[0]}; place or remove both"
        )


def check_position(name: str, position: Any) -> tuple[float, float]:
    """A position as two floats."""
    try:
        x, y = (float(number) for number in position)
    except (TypeError, ValueError, OverflowError):
        x = y = math.nan
    if isinstance(position, str) or not (math.isfinite(x) and math.isfinite(y)):
        raise InputError(f"{name} must be two finite numbers [x, y], got {position!r}; replace it")
    return x, y


def check_size(size: Any) -> tuple[int, int]:
    """(width, height) as two whole numbers of pixels."""
    try:
        width, height = (int(side) for side in size)
    except (TypeError, ValueError, OverflowError):
        width = height = 0
    if width < 1 or height < 1:
        raise InputError(f"image_size must be (width, height) in pixels, got {size!r}")
    return width, height


def check_inside(
    positions: Mapping[str, tuple[float, float]], image_shape: tuple[int, ...]
) -> None:
    """Refuse points outside a photo of (height, width, ...)."""
    height, width = image_shape[:2]
    for name, (x, y) in positions.items():
        if not (0.0 <= x <= width and 0.0 <= y <= height):
            raise InputError(
                f"{name} at ({x:g}, {y:g}) lies outside the photo of {width} x {height} "
                "pixels; move it inside"
            )


def check_sides(points: FloatArray) -> None:
    """Refuse a swap of left and right: of the two eyes, or of all points."""
    across = points[:, 3:].mean(axis=(0, 1)) - points[:, :2].mean(axis=(0, 1))
    down = points[4].mean(axis=0) - points[0].mean(axis=0)
    if across[0] * down[1] - across[1] * down[0] < 0.0:
        raise InputError(
            "left and right are swapped: right_eye_middle must be the subject's right eye, which "
            "is on the left-hand side of a photo; swap every left and right, or mirror the photo"
        )
    eyes = points[1, 3] - points[1, 1]
    if eyes @ across < 0.5 * np.linalg.norm(eyes) * np.linalg.norm(across):
        raise InputError(
            "the line from right_eye_middle to left_eye_middle does not run the way of the other "
            "points, from the subject's right to left; move or swap the two"
        )


def check_order(upright: FloatArray) -> None:
    """Refuse neighbours in crossing order, by the coordinates of :meth:`FeaturePoints.upright`."""
    for axis, side in enumerate(["to the image right of", "below"]):
        bad = np.argwhere(np.diff(upright[..., axis], axis=1 - axis) <= 0.0)
        if len(bad):
            row, column = bad[0]
            following = (row, column + 1) if axis == 0 else (row + 1, column)
            raise InputError(
                f"feature points in crossing order: {POINT_NAMES[following[0]][following[1]]} "
                f"must lie {side} {POINT_NAMES[row][column]} (with the eyes level); "
                "move one of them, or swap them"
            )


def check_lips(upper: float, centre: float, lower: float) -> None:
    """Refuse an open mouth whose centre is not between the lips, by their heights downwards."""
    if not upper <= centre <= lower:
        raise InputError(
            "mouth_centre must lie between upper_lip and lower_lip (with the eyes level), below "
            "the one and above the other; move it, or remove both where the mouth is closed"
        )
