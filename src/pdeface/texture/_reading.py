"""Photos read at scattered places."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

__all__ = ["PhotoReader"]

FloatArray = NDArray[np.floating[Any]]
Pixels = NDArray[np.uint8]

_SMALLEST = 8
_MOST_ENLARGED = 4


class PhotoReader:
    """The part of a photo around a face, smooth enough to be read anywhere in it.

    Args:
        photo: (h, w, 3 or 4) uint8; transparent pixels count as unseen.
        low, high: (2,) x and y of the box that will be read, pixels.
        step: pixels between two texels that are read, where they lie closest. If it is less than
            one the part is enlarged first, so that no pixel shows as a square; if it is more it
            is reduced, so that none is passed over.
    """

    def __init__(self, photo: Pixels, low: FloatArray, high: FloatArray, step: float) -> None:
        from PIL import Image

        limit = np.array(photo.shape[1::-1])
        left, top = np.clip(np.floor(low).astype(int) - 4, 0, np.maximum(limit - _SMALLEST, 0))
        right, bottom = np.minimum(np.ceil(high).astype(int) + 4, limit)
        right, bottom = max(right, left + 2), max(bottom, top + 2)
        part = photo[top:bottom, left:right]
        alpha = part[..., 3] if part.shape[2] == 4 else np.full(part.shape[:2], 255, np.uint8)
        scale = float(np.clip(1.0 / max(step, 1e-6), 1.0 / 64.0, _MOST_ENLARGED))
        scale = scale if scale < 0.7 or scale > 1.4 else 1.0
        size = tuple(max(2, round(side * scale)) for side in (part.shape[1], part.shape[0]))
        way = Image.Resampling.LANCZOS if scale > 1.0 else Image.Resampling.BOX
        if scale != 1.0:
            part = np.asarray(
                Image.fromarray(np.ascontiguousarray(part[..., :3])).resize(size, way)
            )
            alpha = np.asarray(Image.fromarray(np.ascontiguousarray(alpha)).resize(size, way))
        pixels = np.ascontiguousarray(np.dstack([part[..., :3], alpha]))
        # A pixel's four bytes are fetched as one number.
        self._pixels = pixels.view(np.uint32)[..., 0]
        self._corner = np.array([left, top], np.float32)
        self._scale = np.array(size, np.float32) / (right - left, bottom - top)
        self._photo_size = limit

    def colours(self, places: FloatArray) -> FloatArray:
        """(..., 3) float32, 0 to 255, at (..., 2) places in pixels of the photo; bilinear."""
        flat = np.ascontiguousarray(places, dtype=np.float32).reshape(-1, 2)
        return self._read(flat)[:, :3].reshape(*places.shape[:-1], 3)

    def seen(self, places: FloatArray) -> FloatArray:
        """(...,) 1 where the photo shows something, falling to 0 at its border and beyond."""
        alpha = self._read(np.asarray(places, np.float32).reshape(-1, 2))[:, 3] / 255.0
        inside = np.minimum(places, self._photo_size - places).min(axis=-1)
        border = 0.005 * float(self._photo_size.max())
        return np.asarray(alpha.reshape(inside.shape) * np.clip(inside / border, 0.0, 1.0))

    def _read(self, places: FloatArray) -> FloatArray:
        height, width = self._pixels.shape[:2]
        at = (places - self._corner) * self._scale - np.float32(0.5)
        np.clip(at, 0.0, np.array([width - 1.001, height - 1.001], np.float32), out=at)
        first = at.astype(np.int32)
        x, y = (at - first).T[:, :, None]
        flat, index = self._pixels.ravel(), first[:, 1] * width + first[:, 0]

        def fetched(step: int) -> Pixels:
            return flat[index + step].view(np.uint8).reshape(-1, 4)

        upper = _between(fetched(0), fetched(1), x)
        return _between(upper, _between(fetched(width), fetched(width + 1), x), y)


def _between(one: NDArray[Any], other: NDArray[Any], share: FloatArray) -> FloatArray:
    result = other.astype(np.float32)
    result -= one
    result *= share
    result += one
    return result
