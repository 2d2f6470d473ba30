"""Photos that the page sends: their pixels, and the lens that took them."""

from __future__ import annotations

import io
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
from numpy.typing import NDArray

from pdeface.errors import InputError, require

__all__ = ["MOST_PIXELS", "lens_of", "pixels_of"]

MOST_PIXELS = 50_000_000


def pixels_of(data: bytes) -> NDArray[np.uint8]:
    """(H, W, 3) the texels of a photo, turned as its EXIF says.

    Raises:
        InputError: damaged, or too many pixels.
    """
    image_module = require("PIL.Image", "texture", "to read photos")
    turned = require("PIL.ImageOps", "texture", "to read photos").exif_transpose
    try:
        image = image_module.open(io.BytesIO(data), formats=("PNG", "JPEG"))
        if image.width * image.height > MOST_PIXELS:
            raise InputError(
                f"a photo may have {MOST_PIXELS // 10**6} megapixels here, got {image.width} x "
                f"{image.height}; make it smaller"
            )
        return np.array(turned(image).convert("RGB"), dtype=np.uint8)
    except InputError:
        raise
    except Exception as error:  # Pillow's decoders raise nearly anything on damaged files.
        raise InputError(
            f"the photo cannot be read ({error}); it is damaged, save it again"
        ) from error


def lens_of(data: bytes) -> float | None:
    """The focal length that a photo's EXIF states, as :func:`pdeface.photo.focal_length`."""
    from pdeface.photo import focal_length

    with TemporaryDirectory(prefix="pdeface-") as folder:
        path = Path(folder) / "photo"
        path.write_bytes(data)
        return focal_length(path)
