"""The focal length in a photo's EXIF."""

from __future__ import annotations

from pathlib import Path

import pytest

pytest.importorskip("PIL", reason="needs the extra 'texture'")

from PIL import Image

from pdeface.errors import InputError
from pdeface.photo import focal_length


def photo(path: Path, tags: dict[int, object]) -> Path:
    exif = Image.Exif()
    exif.get_ifd(0x8769).update(tags)
    Image.new("RGB", (30, 40)).save(path, exif=exif)
    return path


@pytest.mark.parametrize(
    ("tags", "expected"),
    [
        ({0xA405: 28, 0x920A: 4.2}, 28.0),
        ({}, None),
        ({0xA405: 0}, None),
        ({0xA405: 60000}, None),
        # 4,000 x 3,000 pixels at 2,540 to the centimetre: a sensor of 19.7 mm across its corners.
        ({0x920A: 10.0, 0xA002: 4000, 0xA003: 3000, 0xA20E: 2540.0, 0xA210: 3}, 21.98),
        ({0x920A: 10.0, 0xA002: 4000, 0xA003: 3000}, None),
    ],
)
def test_a_focal_length_is_read_if_it_is_stated(tags, expected, tmp_path) -> None:
    found = focal_length(photo(tmp_path / "photo.jpg", tags))
    assert found == (None if expected is None else pytest.approx(expected, rel=1e-3))


def test_what_is_no_photo_is_refused(tmp_path) -> None:
    text = tmp_path / "photo.jpg"
    text.write_text("no photo")
    with pytest.raises(InputError, match="JPEG or PNG"):
        focal_length(text)
