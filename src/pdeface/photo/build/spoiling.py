"""Pictures spoiled as photos are: out of focus, noisy, badly lit, compressed, cut out askew.

Renderings are cleaner than any photo. What is learnt from them alone holds for them alone.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from pdeface.errors import require

__all__ = ["spoiled"]

Pixels = NDArray[np.uint8]

_TURN, _SHIFT, _SIZE = 3.0, 7.0, 0.05
"""How far askew: degrees, pixels, and part of the size."""


def spoiled(picture: Pixels, rng: np.random.Generator) -> Pixels:
    """(h, w, 3) the picture, worse in several ways."""
    cv2: Any = require("cv2", "photo", "to spoil pictures")
    picture = _askew(picture, rng, cv2)
    if rng.random() < 0.6:
        picture = cv2.GaussianBlur(picture, (0, 0), rng.uniform(0.3, 1.6))
    picture = _noisy(_toned(picture, rng), rng)
    if rng.random() < 0.5:
        quality = [cv2.IMWRITE_JPEG_QUALITY, int(rng.integers(35, 95))]
        picture = cv2.imdecode(cv2.imencode(".jpg", picture, quality)[1], cv2.IMREAD_COLOR)
    return picture


def _askew(picture: Pixels, rng: np.random.Generator, cv2: Any) -> Pixels:
    height, width = picture.shape[:2]
    size = 1.0 + rng.uniform(-_SIZE, _SIZE)
    shift = rng.uniform(-_SHIFT, _SHIFT, 2)
    turn = np.radians(rng.uniform(-_TURN, _TURN))
    axes = size * np.array([[np.cos(turn), -np.sin(turn)], [np.sin(turn), np.cos(turn)]])
    middle = 0.5 * np.array([width, height])
    affine = np.column_stack([axes, middle + shift - axes @ middle])
    moved = cv2.warpAffine(
        picture, affine, (width, height), flags=cv2.INTER_LINEAR, borderMode=cv2.BORDER_REPLICATE
    )
    return np.asarray(moved)


def _toned(picture: Pixels, rng: np.random.Generator) -> NDArray[np.float32]:
    """(h, w, 3) 0 to 1 and beyond: another exposure, contrast and white, or grey."""
    image = (picture.astype(np.float32) / 255.0) ** np.exp(rng.uniform(-0.4, 0.4))
    mean = image.mean()
    image = (image - mean) * rng.uniform(0.75, 1.25) + mean + rng.uniform(-0.06, 0.06)
    image = image * rng.uniform(0.88, 1.12, 3)
    return np.asarray(image.mean(axis=2, keepdims=True) + 0.0 * image
                      if rng.random() < 0.2 else image)  # fmt: skip


def _noisy(image: NDArray[np.floating], rng: np.random.Generator) -> Pixels:
    image = image + rng.normal(0.0, rng.uniform(0.0, 0.03), image.shape)
    return np.clip(np.rint(255.0 * image), 0, 255).astype(np.uint8)
