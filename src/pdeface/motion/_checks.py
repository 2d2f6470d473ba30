"""What a track is made of, checked: the arrays come back as new float64 arrays, or an error."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pdeface.errors import InputError
from pdeface.motion.names import ARKIT_NAMES, did_you_mean

__all__ = ["angles", "names", "number", "rate", "times", "weights"]

FloatArray = NDArray[np.float64]


def number(value: Any, what: str) -> float:
    """A finite number, or an error that says it should be ``what``."""
    try:
        result = float(value)
    except (TypeError, ValueError):
        result = math.nan
    if isinstance(value, bool | str) or not math.isfinite(result):
        raise InputError(f"expected {what}, got {value!r}; give a finite number")
    return result


def rate(value: Any) -> float:
    """Frames a second."""
    frames = number(value, "a number of frames a second")
    if frames <= 0:
        raise InputError(f"expected more than 0 frames a second, got {frames:g}; try 60")
    return frames


def times(value: Any) -> FloatArray:
    """(T,) seconds, not negative and increasing, T at least 1."""
    array = _array(value, "times")
    if array.ndim != 1 or not len(array):
        raise InputError(
            f"times of a track need shape (samples,), one or more, got {array.shape}; "
            "give the seconds of each sample"
        )
    _all_finite(array[:, np.newaxis], ["times"])
    if array[0] < 0:
        raise InputError(f"times of a track count from 0, got {array[0]:g} first; shift them")
    stuck = np.flatnonzero(np.diff(array) <= 0)
    if len(stuck):
        sample = int(stuck[0]) + 1
        raise InputError(
            f"times of a track must increase, got {array[sample]:g} after {array[sample - 1]:g} "
            f"at sample {sample}; sort the samples and drop repeated ones"
        )
    return array


def names(value: Sequence[str]) -> tuple[str, ...]:
    """Distinct ARKit names."""
    if isinstance(value, str):
        raise InputError(f"expected a sequence of names, got the text {value!r}; put it in a list")
    found = tuple(value)
    for place, name in enumerate(found):
        if name not in ARKIT_NAMES:
            raise InputError(
                f"expected ARKit names, got {name!r}; {did_you_mean(str(name), ARKIT_NAMES)}"
            )
        if name in found[:place]:
            raise InputError(f"expected each name once, got {name} twice; drop one")
    return found


def weights(value: Any, at: FloatArray, of: tuple[str, ...]) -> FloatArray:
    """(T, N) weights within 0..1."""
    array = _array(value, "weights")
    if array.shape != (len(at), len(of)):
        raise InputError(
            f"weights of {len(at)} samples and {len(of)} names need shape "
            f"({len(at)}, {len(of)}), got {array.shape}; give one row per sample"
        )
    _all_finite(array, of)
    wrong = np.argwhere((array < 0) | (array > 1))
    if len(wrong):
        sample, column = wrong[0]
        raise InputError(
            f"weights lie within 0 and 1, got {array[sample, column]:g} for {of[column]} at "
            f"sample {sample}; clamp it"
        )
    return array


def angles(value: Any, at: FloatArray, what: str) -> FloatArray:
    """(T, 3) finite angles; an empty array stands for angles that are 0 throughout."""
    array = _array(value, what)
    if array.shape == (0, 3):
        return np.zeros((len(at), 3))
    if array.shape != (len(at), 3):
        raise InputError(
            f"{what} of {len(at)} samples needs shape ({len(at)}, 3), got {array.shape}; "
            "give yaw, pitch and roll of each sample, radians"
        )
    _all_finite(array, [f"{what} {angle}" for angle in ("yaw", "pitch", "roll")])
    return array


def _array(value: Any, what: str) -> FloatArray:
    try:
        return np.array(value, dtype=np.float64)
    except (TypeError, ValueError) as error:
        reason = " ".join(str(error).split())
        raise InputError(
            f"{what} of a track must be an array of numbers, got {type(value).__name__} "
            f"({reason}); give numbers, as many for every sample"
        ) from error


def _all_finite(array: FloatArray, columns: Sequence[str]) -> None:
    bad = np.argwhere(~np.isfinite(array))
    if len(bad):
        sample, column = bad[0]
        raise InputError(
            f"expected finite numbers, got {array[sample, column]} for {columns[column]} at "
            f"sample {sample}; remove or replace it"
        )
