"""Pictures to files, whole or not at all."""

from __future__ import annotations

from pathlib import Path
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from pdeface.errors import InputError, require
from pdeface.files import PathLike, atomic_path

__all__ = ["check_suffix", "write_image"]

FORMATS: Final[dict[str, dict[str, Any]]] = {
    ".png": {"format": "PNG", "optimize": False, "compress_level": 6},
    ".jpg": {"format": "JPEG", "quality": 95, "subsampling": 0},
    ".jpeg": {"format": "JPEG", "quality": 95, "subsampling": 0},
    ".webp": {"format": "WEBP", "quality": 92, "method": 4},
}


def check_suffix(path: PathLike, transparent: bool = False) -> str:
    """The suffix of a picture file, in lower case.

    Raises:
        InputError: not a format that is written, or not one that can be transparent.
    """
    suffix = Path(path).suffix.lower()
    if suffix not in FORMATS:
        raise InputError(
            f"a picture is written as {', '.join(FORMATS)}, got {Path(path).name!r}; "
            "end its name in .png"
        )
    if transparent and FORMATS[suffix]["format"] == "JPEG":
        raise InputError(
            f"a transparent picture needs .png or .webp, got {Path(path).name!r}; "
            "end its name in .png"
        )
    return suffix


def write_image(path: PathLike, image: NDArray[np.uint8]) -> None:
    """Write an (H, W, 3 or 4) image; the suffix of ``path`` picks the format."""
    options = FORMATS[check_suffix(path, image.shape[2] == 4)]
    picture = require("PIL.Image", "render", "to write pictures").fromarray(image)
    with atomic_path(path) as temporary:
        picture.save(temporary, **options)
