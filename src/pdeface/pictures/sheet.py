"""Contact sheets: pictures in rows and columns, with captions."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Final

import numpy as np
from numpy.typing import NDArray

from pdeface.errors import InputError
from pdeface.face import Face
from pdeface.files import PathLike
from pdeface.pictures.camera import View
from pdeface.pictures.image_file import check_suffix, write_image
from pdeface.pictures.lettering import write
from pdeface.pictures.picture import render

__all__ = ["contact_sheet", "demo_sheet"]

Pixels = NDArray[np.uint8]
Progress = Callable[[str], None]

PAPER: Final = 255
CAPTION: Final = 0.06
"""Height of a caption's band as a share of the tallest picture."""

DEMO_VIEWS: Final[tuple[View, ...]] = ("front", "three-quarter", "profile")


def contact_sheet(
    rows: Sequence[Sequence[Pixels]],
    captions: Sequence[Sequence[str]] | None = None,
    *,
    gap: int = 12,
    letters: float | None = None,
) -> Pixels:
    """Lay pictures out in rows and columns.

    Args:
        rows: (H, W, 3) images; every column is as wide as its widest picture and every row as
            tall as its tallest, with the others in the middle of their place.
        captions: a line of text under each picture, in the same rows and columns.
        gap: white space between pictures and around them, pixels.
        letters: size of the letters, pixels; None to suit the pictures.

    Returns:
        (H, W, 3) uint8.

    Raises:
        InputError: no pictures, or captions that do not match them.
    """
    _check(rows, captions)
    widths = [max(r[c].shape[1] for r in rows if c < len(r)) for c in range(max(map(len, rows)))]
    heights = [max(image.shape[0] for image in row) for row in rows]
    letters = letters or 0.55 * CAPTION * max(heights)
    band = round(2.2 * letters) if captions else 0
    total = sum(heights) + len(rows) * (gap + band) + gap
    sheet = np.full((total, sum(widths) + gap * (len(widths) + 1), 3), PAPER, np.uint8)
    labels = []
    top = gap
    for r, row in enumerate(rows):
        left = gap
        for c, image in enumerate(row):
            y = top + (heights[r] - image.shape[0]) // 2
            x = left + (widths[c] - image.shape[1]) // 2
            sheet[y : y + image.shape[0], x : x + image.shape[1]] = image[..., :3]
            if captions:
                below = top + heights[r] + 0.5 * band
                labels.append((left + 0.5 * widths[c], below, captions[r][c]))
            left += widths[c] + gap
        top += heights[r] + band + gap
    return write(sheet, labels, letters) if labels else sheet


def _check(rows: Sequence[Sequence[Pixels]], captions: Sequence[Sequence[str]] | None) -> None:
    if not rows or not all(len(row) for row in rows):
        raise InputError("a contact sheet needs a picture in every row, got an empty one; add one")
    counts = [len(row) for row in rows]
    if captions is not None and [len(row) for row in captions] != counts:
        raise InputError(
            f"a contact sheet needs a caption for every picture, {counts} in its rows, "
            f"got {[len(row) for row in captions]}; use '' for none"
        )


def demo_sheet(
    face: Face,
    path: PathLike | None = None,
    *,
    size: tuple[int, int] = (640, 800),
    progress: Progress | None = None,
) -> Pixels:
    """Front, three-quarter and profile, side by side: the face above, its curves below.

    Args:
        face: the face; without a texture its upper row is shaded.
        path: file to write, or None.
        size: (width, height) of each picture, pixels.
        progress: called with a line of text before each picture.

    Returns:
        (H, W, 3) uint8.
    """
    if path is not None:
        check_suffix(path)
    upper = "shaded" if face.texture is None else "textured"
    rows, captions = [], []
    for style in (upper, "curves"):
        row = []
        for view in DEMO_VIEWS:
            if progress:
                progress(f"drawing {style}, {view}")
            row.append(render(face, view=view, style=style, size=size))
        rows.append(row)
        captions.append([f"{style}, {view}" for view in DEMO_VIEWS])
    sheet = contact_sheet(rows, captions)
    if path is not None:
        write_image(path, sheet)
    return sheet
