"""Photos from files: whatever a camera, phone or scanner wrote, as upright 8-bit sRGB."""

from __future__ import annotations

import io
import threading
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from pdeface import files, images
from pdeface.errors import FileFormatError, InputError, require

if TYPE_CHECKING:
    from PIL.Image import Image

__all__ = ["MAX_PIXELS", "read_photo", "write_image"]

Pixels = NDArray[np.uint8]

MAX_PIXELS = 250_000_000
"""Pixels of a photo, at most: more than any phone takes, fewer than what fills the memory."""

# Formats that only hold pictures. Pillow opens others by running programs (PostScript).
_FORMATS = (
    "AVIF",
    "BMP",
    "DIB",
    "GIF",
    "HEIF",
    "JPEG",
    "JPEG2000",
    "MPO",
    "PNG",
    "PPM",
    "TGA",
    "TIFF",
    "WEBP",
)
_WRITERS = {".png": images.encode_png, ".jpg": images.encode_jpeg, ".jpeg": images.encode_jpeg}
_limit_lock = threading.Lock()


def read_photo(source: files.PathLike | bytes) -> Pixels:
    """Read a photo of any common format and kind, turned as its EXIF says.

    Greyscale, palette, CMYK and 16-bit pictures become 8-bit RGB; colours of an embedded profile
    (Display P3 from a phone, say) become sRGB; of an animation the first picture is read.

    Args:
        source: a file's name, or its content.

    Returns:
        (H, W, 3) uint8, or (H, W, 4) where the picture has transparency.

    Raises:
        InputError: the file cannot be opened or has more than 250 million pixels.
        FileFormatError: it is damaged or incomplete, or no picture that can be read.
        MissingExtraError: Pillow is not installed.
    """
    require("PIL.Image", "texture", "to read photos")
    name, data = _content(source)
    try:
        image = _open(data)
        if image.width * image.height <= MAX_PIXELS and image.format in _FORMATS:
            return _decode(image)
    except MemoryError as error:
        raise InputError(f"{name} is too large for the memory; make it smaller") from error
    except Exception as error:  # Pillow's decoders raise nearly anything on damaged files.
        raise FileFormatError(_complaint(name, error)) from error
    if image.format not in _FORMATS:
        raise FileFormatError(
            f"{name} must be a photo, got the format {image.format}; save it as PNG or JPEG"
        )
    raise InputError(
        f"{name} must have at most {MAX_PIXELS // 10**6} million pixels, "
        f"got {image.width} x {image.height}; make it smaller"
    )


def write_image(image: Any, path: files.PathLike) -> None:
    """Write an image as PNG or JPEG, by the suffix of ``path``; all of it or nothing.

    Args:
        image: (H, W, 3 or 4) uint8; JPEG drops the alpha channel.
        path: ending in .png, .jpg or .jpeg.

    Raises:
        InputError: another suffix, shape or type, or the file cannot be written.
    """
    suffix = Path(path).suffix.lower()
    if suffix not in _WRITERS:
        raise InputError(f"expected a name ending in .png or .jpg, got {path}; change the suffix")
    files.atomic_write(path, _WRITERS[suffix](images.check_pixels(image)))


def _content(source: files.PathLike | bytes) -> tuple[str, bytes]:
    if isinstance(source, bytes):
        return "the photo", source
    try:
        return str(source), Path(source).read_bytes()
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or error
        raise InputError(f"cannot read the photo {source}: {reason}; check its name") from error


def _complaint(name: str, error: Exception) -> str:
    from PIL import UnidentifiedImageError

    if isinstance(error, UnidentifiedImageError):
        return f"{name} is no picture that can be read here; save it as PNG or JPEG"
    return f"{name} cannot be read ({error}): it is damaged or incomplete; save or copy it again"


def _open(data: bytes) -> Image:
    from PIL import Image

    with _limit_lifted():
        return Image.open(io.BytesIO(data))


@contextmanager
def _limit_lifted() -> Iterator[None]:
    """Let Pillow open what we allow; its own limit is below a phone's 200 megapixels."""
    from PIL import Image

    with _limit_lock, warnings.catch_warnings():
        warnings.simplefilter("ignore", Image.DecompressionBombWarning)
        before = Image.MAX_IMAGE_PIXELS
        Image.MAX_IMAGE_PIXELS = None
        try:
            yield
        finally:
            Image.MAX_IMAGE_PIXELS = before


def _decode(image: Image) -> Pixels:
    from PIL import ImageOps

    with _limit_lifted():  # some decoders learn of the size, and complain, only now
        image.load()
    image = ImageOps.exif_transpose(image)
    if image.mode.startswith("I") or image.mode == "F":
        grey = _eight_bits(np.asarray(image), image.mode)
        return np.repeat(grey[..., None], 3, axis=2)
    image = _to_srgb(image)
    if image.mode not in ("RGB", "RGBA"):
        image = image.convert("RGBA" if image.has_transparency_data else "RGB")
    return np.array(image, dtype=np.uint8)


def _eight_bits(grey: NDArray[Any], mode: str) -> Pixels:
    """Greyscale of 16 bits, or of floats up to 1 (or else 255), as 8 bits."""
    if mode == "F":
        scale = 255.0 if grey.max() <= 1.0 else 1.0
        return np.nan_to_num(np.clip(np.rint(grey * scale), 0, 255)).astype(np.uint8)
    # 65535 / 257 = 255; half of 257 added rounds to the nearest.
    return ((np.clip(grey, 0, 65535).astype(np.uint32) + 128) // 257).astype(np.uint8)


def _to_srgb(image: Image) -> Image:
    """Convert the colours of an embedded profile; a profile that is broken is ignored."""
    profile = image.info.get("icc_profile")
    if not profile or image.mode not in ("RGB", "RGBA", "CMYK"):
        return image
    try:
        from PIL import ImageCms

        own = ImageCms.ImageCmsProfile(io.BytesIO(profile))
        if "srgb" in ImageCms.getProfileDescription(own).lower():
            return image
        mode = "RGBA" if image.mode == "RGBA" else "RGB"
        srgb = ImageCms.createProfile("sRGB")
        converted = ImageCms.profileToProfile(image, own, srgb, outputMode=mode)
        return image if converted is None else converted
    except Exception:  # a bad profile, or a Pillow without colour management
        return image
