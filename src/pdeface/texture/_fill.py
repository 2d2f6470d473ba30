"""Colours where there are none: smooth extension of an image beyond what is known of it."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

__all__ = ["extend"]

FloatArray = NDArray[np.floating[Any]]


def extend(colours: FloatArray, weights: FloatArray) -> FloatArray:
    """Fill in by pull and push: each unknown pixel takes the mean of the nearest known ones.

    The image is halved again and again, every level the weighted mean of what is known; then,
    from the coarsest to the finest, what is unknown takes the colour of the level above.

    Args:
        colours: (H, W, C).
        weights: (H, W) in [0, 1]; 0 where the colour is unknown.

    Returns:
        (H, W, C): ``colours`` where the weight is 1, smoothly extended elsewhere; black where
        nothing at all is known.
    """
    weights = weights[..., None]
    if max(colours.shape[:2]) == 1 or float(weights.min()) >= 1.0:
        return colours
    total = _halve(weights)
    mean = _halve(colours * weights) / np.maximum(total, 1e-12)
    # Half of the four pixels known is as good as all: colours shall come from close by.
    coarse = extend(mean, np.minimum(2.0 * total, 1.0)[..., 0])
    guess = _double(coarse, colours.shape[:2])
    return np.asarray(weights * colours + (1.0 - weights) * guess, dtype=np.float32)


def _halve(image: FloatArray) -> FloatArray:
    """Means of 2 x 2 pixels; an odd row or column is repeated."""
    height, width = image.shape[:2]
    padded = np.pad(image, ((0, height % 2), (0, width % 2), (0, 0)), mode="edge")
    rows = padded[0::2] + padded[1::2]
    return np.asarray(0.25 * (rows[:, 0::2] + rows[:, 1::2]), dtype=np.float32)


def _double(image: FloatArray, shape: tuple[int, ...]) -> FloatArray:
    """Twice the size, bilinear, cut to ``shape``."""
    for axis in (0, 1):
        image = np.moveaxis(image, axis, 0)
        padded = np.concatenate([image[:1], image, image[-1:]])
        doubled = np.empty((2 * len(image), *image.shape[1:]), np.float32)
        doubled[0::2] = 0.25 * padded[:-2] + 0.75 * image
        doubled[1::2] = 0.75 * image + 0.25 * padded[2:]
        image = np.moveaxis(doubled[: shape[axis]], 0, axis)
    return image
