"""8-bit pictures to and from PNG and JPEG bytes, by Pillow, imported when first needed."""

from __future__ import annotations

import io
import struct
import warnings
import zlib
from types import ModuleType
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pdeface.errors import FileFormatError, InputError, require

__all__ = [
    "MAX_SIDE",
    "check_pixels",
    "decode",
    "encode_compact",
    "encode_jpeg",
    "encode_png",
    "has_holes",
    "media_type",
]

Pixels = NDArray[np.uint8]

MAX_SIDE = 8192
"""Texels along a side of a texture, at most: what graphics cards take, and no bomb to decode."""

_MAGIC = {b"\x89PNG\r\n\x1a\n": "image/png", b"\xff\xd8\xff": "image/jpeg"}


def check_pixels(image: Any) -> Pixels:
    """The (H, W, 3 or 4) array of bytes that ``image`` is, untouched.

    Raises:
        InputError: another shape or type, no texels, or more than 8192 along a side.
    """
    pixels = np.asarray(image)
    if pixels.dtype != np.uint8 or pixels.ndim != 3 or pixels.shape[2] not in (3, 4):
        raise InputError(
            "a texture must be an array of uint8 with the shape (height, width, 3 or 4), "
            f"got {pixels.dtype} {pixels.shape}; convert it"
        )
    if min(pixels.shape[:2]) == 0 or max(pixels.shape[:2]) > MAX_SIDE:
        raise InputError(
            f"a texture must have 1 to {MAX_SIDE} texels along each side, "
            f"got {pixels.shape[0]} x {pixels.shape[1]}; resize it"
        )
    return pixels


def media_type(data: bytes) -> str:
    """``"image/png"`` or ``"image/jpeg"``, by the first bytes.

    Raises:
        FileFormatError: neither.
    """
    for magic, name in _MAGIC.items():
        if data.startswith(magic):
            return name
    raise FileFormatError("expected a PNG or JPEG picture, got something else; convert it")


def encode_png(pixels: Pixels) -> bytes:
    """PNG bytes, lossless."""
    # Level 1: on photographs higher levels take 4 times as long and save a seventh.
    return _encode(pixels, format="PNG", compress_level=1)


def encode_jpeg(pixels: Pixels) -> bytes:
    """JPEG bytes of the colours (alpha is dropped), quality 95 without chroma subsampling."""
    return _encode(pixels[..., :3], format="JPEG", quality=95, subsampling=0)


def encode_compact(pixels: Pixels) -> bytes:
    """The smaller of JPEG and PNG for a viewer; always PNG where a texel is not opaque."""
    middle = len(pixels) // 2
    band = pixels[max(middle - 32, 0) : middle + 32]  # a taste is enough to tell, and 30x faster
    if has_holes(pixels) or len(encode_png(band)) <= len(encode_jpeg(band)):
        return encode_png(pixels)
    return encode_jpeg(pixels)


def encode_plain(pixels: Pixels) -> bytes:
    """PNG bytes of (H, W, 3 or 4) texels, lossless, without Pillow: for textures that the library
    makes itself, whose files the core must be able to write.

    Rows are stored as differences from the one above (filter 2 of the PNG specification).
    """
    height, width, channels = pixels.shape
    rows = np.ascontiguousarray(pixels).reshape(height, -1)
    above = np.concatenate([np.zeros_like(rows[:1]), rows[:-1]])
    filtered = np.full((height, 1 + rows.shape[1]), 2, np.uint8)
    filtered[:, 1:] = rows - above
    header = struct.pack(">IIBBBBB", width, height, 8, 2 if channels == 3 else 6, 0, 0, 0)
    chunks = ((b"IHDR", header), (b"IDAT", zlib.compress(filtered.tobytes(), 9)), (b"IEND", b""))
    body = b"".join(
        struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))
        for name, data in chunks
    )
    return b"\x89PNG\r\n\x1a\n" + body


def has_holes(pixels: Pixels) -> bool:
    """Whether any texel is not opaque."""
    return pixels.shape[2] == 4 and bool((pixels[..., 3] < 255).any())


def decode(data: bytes) -> Pixels:
    """The (H, W, 3 or 4) texels, read-only, of a PNG or JPEG; as stored, turned by no EXIF.

    Raises:
        FileFormatError: damaged, not PNG or JPEG, or not 8 bits a channel.
        MissingExtraError: Pillow is not installed.
    """
    media_type(data)
    image_module = _pillow()
    try:
        with warnings.catch_warnings():
            # The size is checked below; Pillow's warning would be a second opinion.
            warnings.simplefilter("ignore", image_module.DecompressionBombWarning)
            image = image_module.open(io.BytesIO(data), formats=("PNG", "JPEG"))
        size, mode = image.size, image.mode
        if max(size) <= MAX_SIDE and not mode.startswith(("I", "F")):
            if mode not in ("RGB", "RGBA"):
                image = image.convert("RGBA" if image.has_transparency_data else "RGB")
            pixels = np.array(image, dtype=np.uint8)
            pixels.setflags(write=False)
            return pixels
    except Exception as error:  # Pillow's decoders raise nearly anything on damaged files.
        raise FileFormatError(
            f"the picture cannot be read ({error}); it is damaged, save it again"
        ) from error
    raise FileFormatError(
        f"a texture must have 8 bits a channel and at most {MAX_SIDE} texels along a side, "
        f"got mode {mode}, {size[1]} x {size[0]}; convert it"
    )


def _encode(pixels: Pixels, **options: Any) -> bytes:
    stream = io.BytesIO()
    _pillow().fromarray(np.ascontiguousarray(pixels)).save(stream, **options)
    return stream.getvalue()


def _pillow() -> ModuleType:
    return require("PIL.Image", "texture", "to read and write pictures")
