"""A page that shows what was found in a photo and what was made of it."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pdeface.errors import require
from pdeface.face import Face
from pdeface.photo.alignment import seen
from pdeface.photo.texturing import PhotoView
from pdeface.pictures import contact_sheet, render

__all__ = ["photo_report"]

Pixels = NDArray[np.uint8]

_SIZE = (560, 700)
_FOUND, _FITTED = (64, 224, 112), (255, 196, 64)
_EVERY = (6, 8)
"""Which rows and columns of the fitted uv mesh are drawn."""

_BLINK = {"eyeBlinkLeft": 1.0, "eyeBlinkRight": 1.0}
_SMILE = {"mouthSmileLeft": 0.8, "mouthSmileRight": 0.8, "cheekSquintLeft": 0.4}
_SMILE |= {"cheekSquintRight": 0.4}

_Shown = tuple[str, float, dict[str, float]]
_POSED: tuple[_Shown, ...] = (
    ("front", 0.0, {}), ("45 degrees", 45.0, {}), ("90 degrees", 90.0, {})
)  # fmt: skip
_MOVED: tuple[_Shown, ...] = (
    ("blink", 0.0, _BLINK), ("smile", 0.0, _SMILE), ("jaw open", 0.0, {"jawOpen": 0.6})
)  # fmt: skip


def photo_report(face: Face, views: Sequence[PhotoView]) -> Pixels:
    """(H, W, 3) uint8: each photo with its landmarks and with the fitted mesh, the texture, and the
    face from the front, at 45 and at 90 degrees, blinking, smiling and with its jaw open.

    Args:
        face: that was made.
        views: the photos it was made from.
    """
    rows, captions = [], []
    for view in views:
        found, fitted = _overlays(view)
        rows.append([_fitted_in(view.photo, _box(view)), found, fitted])
        captions.append(["photo", "landmarks found", "face fitted"])
    rows[0].append(_square(face.texture))
    captions[0].append("texture")
    for group in (_POSED, _MOVED):
        rows.append([_picture(face, side, weights) for _, side, weights in group])
        captions.append([name for name, _, _ in group])
    rows[-2].append(render(face, view=35, style="shaded", size=_SIZE))
    rows[-1].append(render(face, view="front", style="shaded", size=_SIZE))
    captions[-2].append("shape, 35 degrees")
    captions[-1].append("shape, front")
    return contact_sheet(rows, captions)


def _picture(face: Face, azimuth: float, weights: dict[str, float]) -> Pixels:
    return render(face.with_weights(weights), view=azimuth, style="textured", size=_SIZE)


def _box(view: PhotoView) -> tuple[int, int, int, int]:
    """Left, top, right and bottom of the part of the photo that a report shows."""
    marks = view.found.landmarks[:, :2]
    middle = 0.5 * (marks.min(axis=0) + marks.max(axis=0))
    half = 0.8 * float(np.ptp(marks, axis=0).max()) * np.array([_SIZE[0] / _SIZE[1], 1.0])
    left, top = np.rint(middle - half).astype(int).tolist()
    right, bottom = np.rint(middle + half).astype(int).tolist()
    return left, top, right, bottom


def _fitted_in(photo: Pixels, box: tuple[int, int, int, int]) -> Pixels:
    """That part of the photo at the size of the other pictures; black beyond its border."""
    part = _image(photo[..., :3]).crop(box)
    return np.asarray(part.resize(_SIZE, _resampling().LANCZOS))


def _overlays(view: PhotoView) -> tuple[Pixels, Pixels]:
    box = _box(view)
    picture = _fitted_in(view.photo, box)
    scale = _SIZE[0] / (box[2] - box[0])

    def placed(points: NDArray[np.float64]) -> NDArray[np.float64]:
        return np.asarray((points - (box[0], box[1])) * scale)

    found = _image(picture)
    draw = require("PIL.ImageDraw", "render", "to draw a report").Draw(found)
    for x, y in placed(view.found.landmarks[:, :2]).tolist():
        draw.ellipse((x - 1.5, y - 1.5, x + 1.5, y + 1.5), fill=_FOUND)
    places = placed(seen(view.found, view.shape).places)
    fitted = _image(picture)
    draw = require("PIL.ImageDraw", "render", "to draw a report").Draw(fitted)
    for lines in (places[:: _EVERY[0]], places[:, :: _EVERY[1]].swapaxes(0, 1)):
        for line in lines:
            draw.line([tuple(point) for point in line.tolist()], fill=_FITTED)
    return np.asarray(found), np.asarray(fitted)


def _square(texture: Pixels | None) -> Pixels:
    """The texture, as high as a picture is wide."""
    pixels = np.zeros((2, 2, 3), np.uint8) if texture is None else texture[..., :3]
    side = _SIZE[0]
    return np.asarray(_image(pixels).resize((side, side), _resampling().LANCZOS))


def _image(pixels: Pixels) -> Any:
    image = require("PIL.Image", "render", "to draw a report")
    return image.fromarray(np.ascontiguousarray(pixels))


def _resampling() -> Any:
    return require("PIL.Image", "render", "to draw a report").Resampling
