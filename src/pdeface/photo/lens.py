"""The focal length that a photo's file states."""

from __future__ import annotations

import math
from typing import Any

from pdeface.errors import InputError, require
from pdeface.files import PathLike

__all__ = ["DIAGONAL", "focal_length"]

_EXIF, _FOCAL, _FOCAL_35 = 0x8769, 0x920A, 0xA405
_WIDTH, _HEIGHT, _PER_UNIT, _UNIT = 0xA002, 0xA003, 0xA20E, 0xA210
_MILLIMETRES = {2: 25.4, 3: 10.0}
"""Of the unit of the sensor's resolution: inches, centimetres."""

DIAGONAL = 43.267
"""Of the frame of 24 x 36 millimetres that focal lengths refer to."""

_SHORTEST, _LONGEST = 8.0, 2000.0


def focal_length(path: PathLike) -> float | None:
    """The focal length as if on a frame of 24 x 36 millimetres, by EXIF; None if it is not stated.

    The tag FocalLengthIn35mmFilm; else FocalLength with the resolution of the sensor and its
    pixels. Values that no lens has are taken as not stated. It is that of the photo as it was
    taken: a photo that was cropped since has a longer one.

    Args:
        path: of the photo.

    Raises:
        InputError: the file cannot be read as an image.
        MissingExtraError: Pillow is not installed.
    """
    image = require("PIL.Image", "photo", "to read a photo's focal length")
    try:
        with image.open(path) as photo:
            tags = photo.getexif().get_ifd(_EXIF)
    except (OSError, ValueError, SyntaxError) as error:
        raise InputError(
            f"expected a photo, got {path}, which is no image; use a JPEG or PNG file"
        ) from error
    stated = _number(tags.get(_FOCAL_35)) or _by_sensor(tags)
    return stated if stated is not None and _SHORTEST <= stated <= _LONGEST else None


def _by_sensor(tags: Any) -> float | None:
    """The focal length by the size of the sensor."""
    focal, density = _number(tags.get(_FOCAL)), _number(tags.get(_PER_UNIT))
    width, height = _number(tags.get(_WIDTH)), _number(tags.get(_HEIGHT))
    unit = _MILLIMETRES.get(tags.get(_UNIT, 2))
    if not (focal and density and width and height and unit):
        return None
    return focal * DIAGONAL / (math.hypot(width, height) / density * unit)


def _number(value: Any) -> float | None:
    """A finite positive number, or None."""
    try:
        number = float(value)
    except (TypeError, ValueError, ZeroDivisionError):
        return None
    return number if math.isfinite(number) and number > 0.0 else None
