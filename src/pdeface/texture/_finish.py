"""The edge of the texture: skin colour where a frontal photo shows no skin."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from pdeface.texture._fill import extend
from pdeface.texture._lattice import outline
from pdeface.texture.warp import Engine, warp

__all__ = ["finish", "trust"]

FloatArray = NDArray[np.float64]

INSET, FADE = 0.03, 0.07
"""Where the outline's pixels stop being trusted, and over what width, as parts of the texture."""

_COARSE = 256


def trust(uv: FloatArray, shape: tuple[int, int]) -> FloatArray:
    """How far each texel can be trusted to show the face.

    1 inside the outline that the outer feature points draw (the sides of the face from the brows
    to the chin, and the chin), falling smoothly to 0 on it. There is no limit above, and the
    outline widens to the whole face above the brows: what a photo shows beside the forehead is
    the hair that belongs there.

    Args:
        uv: (5, 5, 2) the feature points on the face.
        shape: (height, width) of the texture.

    Returns:
        (height, width) weights in [0, 1].
    """
    height, width = shape
    u, v = np.arange(0.5, height) / height, np.arange(0.5, width) * (np.pi / width)
    right, left, chin = outline(uv, u, v)
    right, left = (
        edge + np.clip(2.0 - 2.0 * u / uv[0, column, 0], 0.0, 1.0) * (border - edge)
        for edge, column, border in ((right, 0, -0.1), (left, -1, np.pi + 0.1))
    )
    sides = _fade((v - right[:, None]) / np.pi) * _fade((left[:, None] - v) / np.pi)
    return np.asarray(sides * _fade(chin - u[:, None]))


def finish(
    warped: NDArray[np.uint8], weights: FloatArray, engine: Engine = "auto"
) -> NDArray[np.uint8]:
    """Fade what is not trusted into a smooth extension of what is.

    Args:
        warped: (H, W, 3), or (H, W, 4) with colours multiplied by alpha, which is then a further
            weight: 0 where the photo showed nothing.
        weights: (H, W) as from :func:`trust`.

    Returns:
        (H, W, 3) opaque colours.
    """
    height, width = warped.shape[:2]
    shape = tuple(max(1, side * _COARSE // max(height, width, _COARSE)) for side in (height, width))
    known: NDArray[Any] = weights[..., None].astype(np.float32)
    colours: NDArray[Any] = warped[..., :3].astype(np.float32)
    if warped.shape[2] == 4:
        alpha = warped[..., 3:] / np.float32(255.0)
        known = known * alpha
        colours = np.divide(colours, alpha, out=np.zeros_like(colours), where=alpha > 0.0)
    if float(known.min()) >= 1.0:
        return warped[..., :3]

    def resized(image: NDArray[Any], to: tuple[int, ...]) -> NDArray[Any]:
        return warp(image, _frame(image.shape), _frame(to), (to[0], to[1]), engine=engine)

    # What is filled in is smooth: a coarse image holds all of it.
    small = resized(known, shape)
    coarse = resized(colours * known, shape) / np.maximum(small, 1e-6)
    guess = resized(extend(coarse, np.clip(small[..., 0], 0.0, 1.0)), (height, width))
    result = known * colours + (1.0 - known) * guess
    return np.asarray(np.clip(np.rint(result), 0, 255), dtype=np.uint8)


def _fade(inside: FloatArray) -> FloatArray:
    t = np.clip((inside - INSET) / FADE, 0.0, 1.0)
    return np.asarray(t * t * (3.0 - 2.0 * t))


def _frame(shape: tuple[int, ...]) -> FloatArray:
    """The corners of an image as a mesh."""
    x, y = np.meshgrid([0.0, shape[1]], [0.0, shape[0]])
    return np.stack([x, y], axis=-1)
