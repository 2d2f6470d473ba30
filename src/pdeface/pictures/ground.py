"""What lies behind the face: a soft light gradient, a plain colour, or nothing."""

from __future__ import annotations

from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from pdeface.errors import InputError, require

__all__ = ["STUDIO", "background_image", "over"]

FloatArray = NDArray[np.floating[Any]]

STUDIO: Final = "studio"

CENTRE: Final = np.array([0.975, 0.976, 0.980], np.float32)
EDGE: Final = np.array([0.868, 0.876, 0.892], np.float32)


def background_image(background: Any, size: tuple[int, int]) -> FloatArray:
    """(H, W, 3) sRGB values, 0 to 1.

    Args:
        background: ``"studio"`` for the soft gradient, a colour that Pillow knows by name or as
            ``"#rrggbb"``, or three numbers from 0 to 1.
        size: (width, height).
    """
    width, height = size
    if isinstance(background, str) and background == STUDIO:
        return _studio(width, height)
    return np.broadcast_to(_color(background).astype(np.float32), (height, width, 3))


def _studio(width: int, height: int) -> FloatArray:
    x = (np.arange(width, dtype=np.float32) + 0.5) / width - 0.5
    y = (np.arange(height, dtype=np.float32) + 0.5) / height - 0.44
    share = np.minimum((x[None, :] ** 2 + y[:, None] ** 2) / 0.75**2, 1.0)[..., None]
    return CENTRE + share * (EDGE - CENTRE)


def _color(background: Any) -> FloatArray:
    if isinstance(background, str):
        try:
            named = require("PIL.ImageColor", "render", "to know colours by name")
            return np.array(named.getrgb(background)[:3]) / 255.0
        except ValueError:
            color = np.array([np.nan])
    else:
        color = np.asarray(background, dtype=np.float64)
    if color.shape != (3,) or not np.all((color >= 0.0) & (color <= 1.0)):
        raise InputError(
            "background is 'studio', a colour such as 'white' or '#ffeedd', or three numbers "
            f"from 0 to 1, got {background!r}; try 'white'"
        )
    return color


def over(picture: FloatArray, background: FloatArray) -> NDArray[np.uint8]:
    """(H, W, 3) bytes of a premultiplied picture laid over a background.

    A pattern of half a grey level keeps the gradient from showing steps.
    """
    color = picture[..., :3] + (1.0 - picture[..., 3:]) * background
    i, j = np.ogrid[: color.shape[0], : color.shape[1]]
    pattern = ((i * 2 + j * 3) % 4 / np.float32(4.0) - np.float32(0.375))[..., None]
    color = np.float32(255.0) * color + pattern * (picture[..., 3:] < 1.0)
    return np.clip(np.rint(color), 0, 255).astype(np.uint8)
