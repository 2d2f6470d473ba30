"""Glasses and masks are noticed, noise and darkness are not taken for them."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray
from PIL import Image, ImageDraw

from pdeface.photo import COVERED, PhotoView, covered, fit_shape
from pdeface.photo.bundled import portrait_face
from pdeface.texture import portrait

EYES = (33, 133), (362, 263)
INK = (10, 10, 10)


@pytest.fixture(scope="module")
def view() -> PhotoView:
    found = portrait_face()
    return PhotoView(portrait()[0], found, fit_shape(found))


def glasses(view: PhotoView, fill: tuple[int, int, int] | None) -> NDArray[np.uint8]:
    image = Image.fromarray(view.photo)
    draw = ImageDraw.Draw(image)
    marks = view.found.landmarks[:, :2]
    for corners in EYES:
        x, y = marks[list(corners)].mean(axis=0)
        draw.ellipse((x - 18, y - 13, x + 18, y + 15), outline=INK, width=3, fill=fill)
    draw.line((*marks[133], *marks[362]), fill=INK, width=3)
    return np.asarray(image)


def test_a_free_face_is_not_covered(view) -> None:
    noise = np.random.default_rng(0).normal(0.0, 15.0, view.photo.shape)
    noisy = np.clip(view.photo + noise, 0, 255).astype(np.uint8)
    for photo in (view.photo, noisy, (0.3 * view.photo).astype(np.uint8)):
        assert covered(view._replace(photo=photo)) < 0.5 * COVERED


@pytest.mark.parametrize("fill", [None, INK], ids=["frames", "sunglasses"])
def test_glasses_are_noticed(view, fill) -> None:
    assert covered(view._replace(photo=glasses(view, fill))) > 1.5 * COVERED


def test_a_mask_is_noticed(view) -> None:
    image = Image.fromarray(view.photo)
    ImageDraw.Draw(image).rectangle((80, 130, 180, 190), fill=(60, 110, 190))
    assert covered(view._replace(photo=np.asarray(image))) > 1.5 * COVERED
