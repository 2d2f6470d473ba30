"""Views of a photo in which a face is looked for, and what of their finds is one face."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from pdeface.photo.found import PhotoFace

__all__ = ["View", "around", "distinct", "tries"]

Pixels = NDArray[np.uint8]

_LARGEST = 1024
"""Pixels along a view's longer side, at most: the detector itself looks at 256, and shrinks what is
larger without a filter."""

_SMALLEST = 64
"""Pixels along the shorter side of a part, at least."""

_GREY = 128
_MARGIN = 0.5


class View(NamedTuple):
    """Pixels to look at, and where they lie in the photo.

    Attributes:
        pixels: (h, w, 3).
        corner: (x, y) in the photo of the view's top-left corner, pixels of the photo.
        size: (width, height) of the view, pixels of the photo.
    """

    pixels: Pixels
    corner: tuple[float, float]
    size: tuple[float, float]

    def to_photo(self, fractions: NDArray[np.float64]) -> NDArray[np.float64]:
        """(n, 3) x, y and depth in pixels of the photo, from fractions of the view."""
        scaled = fractions * (*self.size, self.size[0])
        return np.asarray(scaled + (*self.corner, 0.0))

    @property
    def mirrored(self) -> View:
        """Its mirror image, in the same place of the photo."""
        return self._replace(pixels=self.pixels[:, ::-1])

    @property
    def middle(self) -> float:
        """x of its middle in the photo, pixels."""
        return self.corner[0] + 0.5 * self.size[0]

    def enlarged(self, x: float, y: float) -> View:
        """The view of a smaller copy of the photo, as one of the photo."""
        corner, size = (
            (self.corner[0] * x, self.corner[1] * y),
            (self.size[0] * x, self.size[1] * y),
        )
        return View(self.pixels, corner, size)


def tries(photo: Pixels) -> Iterator[list[View]]:
    """Lists of views, the likeliest first.

    The whole and its halves, for smaller faces beside a large one; then the whole with a margin,
    for a face that fills it; then quarters.

    Args:
        photo: (H, W, 3 or 4).
    """
    small = _shrunk(photo)  # once, not in every view
    height, width = small.shape[:2]
    ratio = photo.shape[1] / width, photo.shape[0] / height
    margin = round(_MARGIN * max(height, width))

    def in_photo(views: Iterable[View]) -> list[View]:
        return [view.enlarged(*ratio) for view in views]

    yield in_photo([_view(small, 0, 0, width, height), *_parts(small, 2)])
    yield in_photo([_view(small, -margin, -margin, width + margin, height + margin)])
    yield in_photo(_parts(small, 4))


def around(face: PhotoFace, photo: Pixels) -> View:
    """The part of the photo that is twice as large as a face, with it in the middle."""
    low, high = face.landmarks[:, :2].min(axis=0), face.landmarks[:, :2].max(axis=0)
    reach = float((high - low).max())
    left, top = np.floor(0.5 * (low + high) - reach).astype(int).tolist()
    side = max(int(2.0 * reach), 1)
    return _view(photo, left, top, left + side, top + side)


def distinct(faces: Sequence[PhotoFace]) -> list[PhotoFace]:
    """The faces, the largest first, without those whose middle lies in the box of a larger."""
    kept: list[PhotoFace] = []
    for face in sorted(faces, key=lambda face: -face.size):
        middle = face.landmarks[:, :2].mean(axis=0)
        boxes = [(f.landmarks[:, :2].min(axis=0), f.landmarks[:, :2].max(axis=0)) for f in kept]
        if not any((low < middle).all() and (middle < high).all() for low, high in boxes):
            kept.append(face)
    return kept


def _parts(photo: Pixels, count: int) -> Iterator[View]:
    """Parts of 1 / count of each side, every other one shifted by half of that."""
    height, width = photo.shape[:2]
    if min(height, width) < _SMALLEST * count:
        return
    part_height, part_width = height // count, width // count
    for row in range(2 * count - 1):
        for column in range(2 * count - 1):
            x, y = column * part_width // 2, row * part_height // 2
            yield _view(photo, x, y, x + part_width, y + part_height)


def _view(photo: Pixels, left: int, top: int, right: int, bottom: int) -> View:
    """The part of the photo in that box, grey where it has none, not larger than need be."""
    height, width = photo.shape[:2]
    part = _opaque(photo[max(top, 0) : min(bottom, height), max(left, 0) : min(right, width)])
    outside = (max(-top, 0), max(bottom - height, 0)), (max(-left, 0), max(right - width, 0))
    part = np.pad(part, (*outside, (0, 0)), constant_values=_GREY)
    return View(_shrunk(part), (left, top), (right - left, bottom - top))


def _opaque(pixels: Pixels) -> Pixels:
    """(h, w, 3) colours, over grey where they are transparent."""
    if pixels.shape[2] == 3:
        return pixels
    alpha = pixels[..., 3:].astype(np.float32) / 255.0
    return np.rint(pixels[..., :3] * alpha + _GREY * (1.0 - alpha)).astype(np.uint8)


def _shrunk(pixels: Pixels) -> Pixels:
    longest = max(pixels.shape[:2])
    if longest <= _LARGEST:
        return pixels
    from PIL import Image

    size = [max(1, round(side * _LARGEST / longest)) for side in (pixels.shape[1], pixels.shape[0])]
    way = Image.Resampling.BOX
    resized = Image.fromarray(pixels).resize((size[0], size[1]), way, reducing_gap=1.0)
    return np.asarray(resized)
