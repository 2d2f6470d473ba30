from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from pdeface.errors import InputError
from pdeface.face import Face
from pdeface.pictures import contact_sheet, demo_sheet


def plain(width: int, height: int, value: int) -> np.ndarray:
    return np.full((height, width, 3), value, np.uint8)


def test_pictures_lie_in_rows_and_columns() -> None:
    sheet = contact_sheet([[plain(30, 40, 10), plain(50, 40, 20)], [plain(30, 20, 30)]], gap=5)
    assert sheet.shape == (5 + 40 + 5 + 20 + 5, 5 + 30 + 5 + 50 + 5, 3)
    assert np.all(sheet[5:45, 5:35] == 10)
    assert np.all(sheet[5:45, 40:90] == 20)
    assert np.all(sheet[50:70, 5:35] == 30)
    assert np.all(sheet[:5] == 255)
    assert np.all(sheet[50:70, 40:] == 255)


def test_small_pictures_stand_in_the_middle() -> None:
    sheet = contact_sheet([[plain(30, 30, 10), plain(10, 10, 20)], [plain(20, 30, 40)]], gap=0)
    assert np.all(sheet[10:20, 30:40] == 20)
    assert np.all(sheet[30:60, 5:25] == 40)


def test_captions_are_written_below_their_pictures() -> None:
    pictures = [[plain(200, 100, 10), plain(200, 100, 20)]]
    bare = contact_sheet(pictures, gap=4)
    sheet = contact_sheet(pictures, [["left", ""]], gap=4, letters=20)
    assert sheet.shape[0] > bare.shape[0]
    below = sheet[4 + 100 : -4]
    assert below[:, 4:204].min() < 120
    assert below[:, 208:].min() == 255


@pytest.mark.parametrize(
    ("rows", "captions"),
    [([], None), ([[]], None), ([[plain(2, 2, 0)]], [["a", "b"]]), ([[plain(2, 2, 0)]], [])],
)
def test_what_makes_no_sheet_is_refused(rows: list[list[np.ndarray]], captions: object) -> None:
    with pytest.raises(InputError, match="contact sheet"):
        contact_sheet(rows, captions)  # type: ignore[arg-type]


def test_the_demo_shows_three_sides_twice(painted: Face, tmp_path: Path) -> None:
    told: list[str] = []
    sheet = demo_sheet(painted, tmp_path / "demo.png", size=(80, 100), progress=told.append)
    assert len(told) == 6
    assert sum("textured" in line for line in told) == 3
    assert sheet.shape[0] > 200
    assert sheet.shape[1] > 240
    np.testing.assert_array_equal(np.asarray(Image.open(tmp_path / "demo.png")), sheet)


def test_the_demo_of_a_face_without_texture_is_shaded(head: Face) -> None:
    told: list[str] = []
    demo_sheet(head, size=(40, 50), progress=told.append)
    assert sum("shaded" in line for line in told) == 3
