"""Photos of every kind are read; what is no photo is refused in one line."""

from __future__ import annotations

import io
import struct
import zlib

import numpy as np
import pytest
from numpy.typing import NDArray
from PIL import Image, ImageCms

from pdeface.errors import FileFormatError, InputError
from pdeface.texture import photos as room
from pdeface.texture import read_photo, write_image

COLOURS = np.array(
    [[[255, 0, 0], [0, 255, 0]], [[0, 0, 255], [204, 102, 51]], [[0, 0, 0], [255, 255, 255]]],
    np.uint8,
)


def encoded(image: Image.Image, kind: str = "PNG", **options: object) -> bytes:
    stream = io.BytesIO()
    image.save(stream, kind, **options)
    return stream.getvalue()


def png_of_16_bits(pixels: NDArray, colour_type: int) -> bytes:
    """A PNG by hand: Pillow writes no 16-bit colours."""

    def chunk(name: bytes, data: bytes) -> bytes:
        return (
            struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))
        )

    height, width = pixels.shape[:2]
    rows = b"".join(b"\0" + row.astype(">u2").tobytes() for row in pixels)
    header = struct.pack(">IIBBBBB", width, height, 16, colour_type, 0, 0, 0)
    parts = chunk(b"IHDR", header), chunk(b"IDAT", zlib.compress(rows)), chunk(b"IEND", b"")
    return b"\x89PNG\r\n\x1a\n" + b"".join(parts)


@pytest.mark.parametrize("mode", ["RGB", "P", "RGBX", "CMYK", "YCbCr", "HSV"])
def test_colours(mode):
    image = Image.fromarray(COLOURS).convert(mode)
    kind = "PNG" if mode in ("RGB", "P") else "TIFF"
    if mode == "HSV":
        image, kind = image.convert("RGB"), "BMP"
    photo = read_photo(encoded(image, kind))
    assert photo.dtype == np.uint8
    assert photo.shape == (3, 2, 3)
    assert np.abs(photo.astype(int) - COLOURS).max() <= 3


@pytest.mark.parametrize("mode", ["1", "L"])
def test_greys_become_rgb(mode):
    image = Image.fromarray(np.array([[0, 255], [255, 0]], np.uint8)).convert(mode)
    photo = read_photo(encoded(image))
    np.testing.assert_array_equal(photo, np.repeat([[[0], [255]], [[255], [0]]], 3, axis=2))


@pytest.mark.parametrize("mode", ["RGBA", "LA", "PA"])
def test_transparency_is_kept(mode):
    rgba = np.dstack([np.full((2, 2, 3), 90), [[0, 255], [128, 7]]]).astype(np.uint8)
    image = Image.fromarray(rgba).convert(mode)
    photo = read_photo(encoded(image, "TIFF" if mode == "PA" else "PNG"))
    assert photo.shape == (2, 2, 4)
    np.testing.assert_array_equal(photo[..., 3], rgba[..., 3])


def test_a_transparent_palette_entry_is_transparent():
    image = Image.fromarray(np.array([[0, 1]], np.uint8), mode="P")
    image.putpalette([10, 20, 30, 40, 50, 60])
    photo = read_photo(encoded(image, transparency=1))
    np.testing.assert_array_equal(photo, [[[10, 20, 30, 255], [40, 50, 60, 0]]])


@pytest.mark.parametrize(("colour_type", "channels"), [(0, 1), (2, 3), (4, 2), (6, 4)])
def test_16_bits_are_scaled_not_cut_off(colour_type, channels):
    values = np.linspace(0, 65535, 40).astype(np.uint16).reshape(4, 10, 1)
    photo = read_photo(png_of_16_bits(np.repeat(values, channels, axis=2), colour_type))
    assert photo.shape == (4, 10, 4 if channels in (2, 4) else 3)
    assert photo[0, 0, 0] == 0
    assert photo[-1, -1, 0] == 255
    exact = np.repeat(values / 257.0, photo.shape[2], axis=2)
    # Pillow reads 16-bit colours by their upper byte, which is within one level.
    assert np.abs(photo - exact).max() <= (0.5 if channels == 1 else 1.0)


def test_16_bit_tiff_and_floats():
    ramp = np.linspace(0, 65535, 12).astype(np.uint16).reshape(3, 4)
    photo = read_photo(encoded(Image.fromarray(ramp), "TIFF"))
    np.testing.assert_array_equal(photo[..., 0], np.rint(ramp / 257.0))
    floats = np.linspace(0, 1, 12, dtype=np.float32).reshape(3, 4)
    photo = read_photo(encoded(Image.fromarray(floats), "TIFF"))
    np.testing.assert_array_equal(photo[..., 1], np.rint(floats * 255))


@pytest.mark.parametrize("orientation", range(1, 9))
def test_a_photo_is_turned_as_its_exif_says(orientation):
    """The camera stored the picture some way round; seen upright it is always the same."""
    undo = {
        1: lambda p: p,
        2: lambda p: p[:, ::-1],
        3: lambda p: p[::-1, ::-1],
        4: lambda p: p[::-1],
        5: lambda p: p.transpose(1, 0, 2),
        6: np.rot90,
        7: lambda p: p[::-1, ::-1].transpose(1, 0, 2),
        8: lambda p: np.rot90(p, -1),
    }
    stored = Image.fromarray(np.ascontiguousarray(undo[orientation](COLOURS)))
    exif = Image.Exif()
    exif[0x0112] = orientation
    np.testing.assert_array_equal(read_photo(encoded(stored, exif=exif)), COLOURS)


def test_broken_exif_is_no_reason_to_refuse():
    data = encoded(Image.fromarray(COLOURS), "JPEG", quality=100, subsampling=0)
    broken = data[:2] + b"\xff\xe1\x00\x0cExif\0\0\xff\xff\xff\xff" + data[2:]
    assert read_photo(broken).shape == (3, 2, 3)


def test_colours_of_a_profile_become_srgb():
    """A profile with the primaries in another order must change the colours; sRGB must not."""
    srgb = ImageCms.ImageCmsProfile(ImageCms.createProfile("sRGB")).tobytes()
    same = read_photo(encoded(Image.fromarray(COLOURS), icc_profile=srgb))
    np.testing.assert_array_equal(same, COLOURS)
    swapped = srgb.replace(b"rXYZ", b"TEMP").replace(b"bXYZ", b"rXYZ").replace(b"TEMP", b"bXYZ")
    swapped = swapped.replace(b"sRGB", b"test").replace(b"s\0R\0G\0B", b"t\0e\0s\0t")
    other = read_photo(encoded(Image.fromarray(COLOURS), icc_profile=swapped))
    assert np.abs(other.astype(int) - COLOURS[..., ::-1]).max() <= 3
    broken = read_photo(encoded(Image.fromarray(COLOURS), icc_profile=b"nonsense"))
    np.testing.assert_array_equal(broken, COLOURS)


@pytest.mark.parametrize("kind", ["PNG", "JPEG", "TIFF", "WEBP", "BMP", "GIF", "PPM", "JPEG2000"])
def test_common_formats_from_a_file(tmp_path, kind):
    path = tmp_path / "photo.bin"
    path.write_bytes(encoded(Image.fromarray(COLOURS), kind))
    assert read_photo(path).shape[:2] == (3, 2)


def test_of_an_animation_the_first_picture_is_read():
    first = Image.fromarray(COLOURS)
    data = encoded(first, "PNG", save_all=True, append_images=[Image.new("RGB", (2, 3))])
    np.testing.assert_array_equal(read_photo(data), COLOURS)


@pytest.mark.parametrize("kind", ["PNG", "JPEG", "TIFF", "WEBP"])
@pytest.mark.parametrize("part", [0.3, 0.6, 0.9])
def test_a_truncated_file_is_refused(kind, part):
    noise = np.random.default_rng(0).integers(0, 256, (64, 64, 3), np.uint8)
    data = encoded(Image.fromarray(noise), kind)
    with pytest.raises(FileFormatError, match="the photo"):
        read_photo(data[: int(len(data) * part)])


@pytest.mark.parametrize("data", [b"", b"hello", b"\x89PNG\r\n\x1a\n", b"%PDF-1.4", bytes(1000)])
def test_other_files_are_refused(tmp_path, data):
    path = tmp_path / "photo.jpg"
    path.write_bytes(data)
    with pytest.raises(FileFormatError, match=r"photo\.jpg") as error:
        read_photo(path)
    assert "\n" not in str(error.value)


def test_postscript_is_not_run():
    data = b"%!PS-Adobe-3.0 EPSF-3.0\n%%BoundingBox: 0 0 10 10\n%%EndComments\nshowpage\n"
    with pytest.raises(FileFormatError, match="must be a photo, got the format EPS"):
        read_photo(data)


@pytest.mark.parametrize("name", ["absent.jpg", ".", "a\0b.jpg"])
def test_a_file_that_cannot_be_opened(tmp_path, name):
    with pytest.raises(InputError, match="cannot read the photo"):
        read_photo(f"{tmp_path}/{name}")


def test_more_pixels_than_allowed_are_refused_before_they_are_decoded():
    before = Image.MAX_IMAGE_PIXELS
    header = struct.pack(">IIBBBBB", 30_000, 30_000, 8, 2, 0, 0, 0)
    chunk = b"IHDR" + header
    data = b"\x89PNG\r\n\x1a\n" + struct.pack(">I", 13) + chunk
    data += struct.pack(">I", zlib.crc32(chunk)) + struct.pack(">I", 10) + b"IDAT"
    with pytest.raises(InputError, match="at most 250 million pixels, got 30000 x 30000"):
        read_photo(data)
    assert before == Image.MAX_IMAGE_PIXELS


def test_what_pillow_would_call_a_bomb_is_read_if_we_allow_it(monkeypatch):
    monkeypatch.setattr(Image, "MAX_IMAGE_PIXELS", 2)
    np.testing.assert_array_equal(read_photo(encoded(Image.fromarray(COLOURS))), COLOURS)
    monkeypatch.setattr(room, "MAX_PIXELS", 5)
    with pytest.raises(InputError, match="got 2 x 3"):
        read_photo(encoded(Image.fromarray(COLOURS)))


@pytest.mark.parametrize("suffix", [".png", ".PNG"])
@pytest.mark.parametrize("channels", [3, 4])
def test_a_png_is_written_exactly(tmp_path, suffix, channels):
    image = np.random.default_rng(1).integers(0, 256, (5, 7, channels), np.uint8)
    write_image(image, tmp_path / f"x{suffix}")
    np.testing.assert_array_equal(read_photo(tmp_path / f"x{suffix}"), image)


def test_a_jpeg_is_written_nearly(tmp_path):
    image = np.full((9, 9, 3), (200, 120, 90), np.uint8)
    write_image(image, tmp_path / "x.jpg")
    assert np.abs(read_photo(tmp_path / "x.jpg").astype(int) - image).max() <= 3


def test_what_cannot_be_written(tmp_path):
    with pytest.raises(InputError, match=r"ending in \.png or \.jpg"):
        write_image(COLOURS, tmp_path / "x.gif")
    with pytest.raises(InputError, match="uint8"):
        write_image(COLOURS / 2, tmp_path / "x.png")
    assert not list(tmp_path.iterdir())
