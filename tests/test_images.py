"""8-bit pictures to and from PNG and JPEG."""

from __future__ import annotations

import io

import numpy as np
import pytest
from PIL import Image

from pdeface import images
from pdeface.errors import FileFormatError, InputError, MissingExtraError

RNG = np.random.default_rng(5)
NOISE = RNG.integers(0, 256, (40, 30, 4), dtype=np.uint8)


def smooth(height: int, width: int) -> np.ndarray:
    rows, columns = np.mgrid[0:height, 0:width]
    waves = [np.sin(rows / 9 + k) * np.cos(columns / 11 - k) for k in range(3)]
    noise = RNG.normal(0, 2, (height, width, 3))
    return np.clip(128 + 90 * np.stack(waves, -1) + noise, 0, 255).astype(np.uint8)


def as_file(image: Image.Image, kind: str = "PNG") -> bytes:
    stream = io.BytesIO()
    image.save(stream, kind)
    return stream.getvalue()


@pytest.mark.parametrize("channels", [3, 4])
def test_png_is_lossless_and_read_by_pillow(channels: int) -> None:
    pixels = NOISE[..., :channels]
    data = images.encode_png(pixels)
    assert images.media_type(data) == "image/png"
    np.testing.assert_array_equal(images.decode(data), pixels)
    np.testing.assert_array_equal(np.asarray(Image.open(io.BytesIO(data))), pixels)


def test_jpeg_is_close() -> None:
    pixels = smooth(120, 90)
    data = images.encode_jpeg(pixels)
    assert images.media_type(data) == "image/jpeg"
    assert np.abs(images.decode(data).astype(int) - pixels).max() <= 12


def test_compact_picks_the_smaller() -> None:
    photo, flat = smooth(256, 256), np.full((256, 256, 3), 77, np.uint8)
    assert images.media_type(images.encode_compact(photo)) == "image/jpeg"
    assert images.media_type(images.encode_compact(flat)) == "image/png"


def test_compact_keeps_alpha_that_matters() -> None:
    pixels = np.concatenate([smooth(256, 256), np.full((256, 256, 1), 255, np.uint8)], -1)
    assert images.media_type(images.encode_compact(pixels)) == "image/jpeg"
    pixels[7, 9, 3] = 254
    np.testing.assert_array_equal(images.decode(images.encode_compact(pixels)), pixels)


def test_other_kinds_of_png_become_colour() -> None:
    grey = Image.fromarray(NOISE[..., 0])
    np.testing.assert_array_equal(images.decode(as_file(grey)), NOISE[..., [0, 0, 0]])
    palette = Image.fromarray(NOISE[..., :3]).quantize(16)
    np.testing.assert_array_equal(images.decode(as_file(palette)), palette.convert("RGB"))


@pytest.mark.parametrize("picture", [
    Image.fromarray(NOISE[..., 0].astype(np.uint16) * 257),
    Image.new("L", (images.MAX_SIDE + 1, 1)),
    Image.new("1", (15000, 15000)),
], ids=["16 bits", "too wide", "bomb"])  # fmt: skip
def test_unusable_pictures(picture: Image.Image) -> None:
    with pytest.raises(FileFormatError):
        images.decode(as_file(picture))


@pytest.mark.parametrize("data", [b"", b"GIF89a", as_file(Image.new("RGB", (2, 2)), "BMP")])
def test_neither_png_nor_jpeg(data: bytes) -> None:
    with pytest.raises(FileFormatError, match="PNG or JPEG"):
        images.decode(data)


@pytest.mark.parametrize("encode", [images.encode_png, images.encode_jpeg])
def test_a_cut_picture_is_refused(encode) -> None:
    data = encode(NOISE)
    for length in range(0, len(data) - 12, 97):
        with pytest.raises(FileFormatError):
            images.decode(data[:length])


@pytest.mark.parametrize("pixels", [
    NOISE.astype(float), NOISE[..., 0], NOISE[..., :2], NOISE[:0], np.zeros((1, 8193, 3), np.uint8),
])  # fmt: skip
def test_arrays_that_are_no_texture(pixels: np.ndarray) -> None:
    with pytest.raises(InputError, match="texture"):
        images.check_pixels(pixels)


def test_without_pillow(monkeypatch: pytest.MonkeyPatch) -> None:
    data = images.encode_png(NOISE)
    monkeypatch.setitem(__import__("sys").modules, "PIL.Image", None)
    for call, argument in ((images.encode_png, NOISE), (images.decode, data)):
        with pytest.raises(MissingExtraError, match="pip install"):
            call(argument)


@pytest.mark.parametrize("channels", [3, 4])
def test_a_png_without_pillow_is_read_by_pillow(channels: int) -> None:
    pixels = np.random.default_rng(2).integers(0, 256, (7, 5, channels), dtype=np.uint8)
    data = images.encode_plain(pixels)
    np.testing.assert_array_equal(images.decode(data), pixels)
    with Image.open(io.BytesIO(data)) as picture:
        picture.verify()
