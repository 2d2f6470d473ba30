"""The edge of the texture: skin colour where a frontal photo shows no skin."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from pdeface.texture._fill import extend
from pdeface.texture._lattice import outline
from pdeface.texture._smooth import step
from pdeface.texture.warp import Engine, warp

__all__ = ["finish", "hair_beside", "trust"]

FloatArray = NDArray[np.float64]

INSET, FADE = 0.03, 0.07
"""Where the outline's pixels stop being trusted, and over what width, as parts of the texture."""

HAIRLINE = 0.6
"""Over what part of the forehead, upwards from the brow, hair beside it comes to be trusted."""

SURELY_OTHER = 40.0
"""Distance of two colours, of 255, that nobody takes for one."""

SKIN_SPREAD = 60.0
"""How far the colours of one person's skin in one photo spread, of 255."""

FAINTEST = 0.02
"""Alpha below which a colour is taken for none."""

_COARSE = 256


def trust(uv: FloatArray, shape: tuple[int, int], hair: tuple[bool, bool]) -> FloatArray:
    """How far each texel can be trusted to show the face.

    1 inside the outline that the outer feature points draw (the sides of the face from the brows
    to the chin, and the chin), falling smoothly to 0 on it. There is no limit above. Where hair
    is seen beside the forehead it belongs there, and is trusted more and more above the brows.

    Args:
        uv: (5, 5, 2) the feature points on the face.
        shape: (height, width) of the texture.
        hair: whether there is any on the subject's right and left, from :func:`hair_beside`.

    Returns:
        (height, width) weights in [0, 1].
    """
    height, width = shape
    u, v = np.arange(0.5, height) / height, np.arange(0.5, width) * (np.pi / width)
    right, left, chin = outline(uv, u, v)
    sides = np.ones(shape)
    for edge, column, sign, seen in ((right, 0, 1.0, hair[0]), (left, -1, -1.0, hair[1])):
        inside = _fade(sign * (v - edge[:, None]) / np.pi)
        beside = step(0.0, 1.0, (1.0 - u / uv[0, column, 0]) / HAIRLINE)[:, None]
        sides *= np.maximum(inside, beside) if seen else inside
    return np.asarray(sides * _fade(chin - u[:, None]))


def hair_beside(
    warped: NDArray[Any], photo: NDArray[np.uint8], places: FloatArray, uv: FloatArray
) -> tuple[bool, bool]:
    """Whether what the photo shows right and left beside the forehead is not its background.

    Told by the middle colours: of the texture's corner, and of the photo's border at that height.

    Args:
        warped: (H, W, 3 or 4) the texture.
        photo: (h, w, 3 or 4).
        places: (rows, columns, 2) positions in the photo of a lattice over the texture.
        uv: (5, 5, 2) the feature points on the face.
    """
    height, width = warped.shape[:2]
    found = []
    for side, column in ((0, slice(0, 1)), (-1, slice(-1, None))):
        u, v = uv[0, side]
        rows = max(1, int(0.8 * u * height))
        wide = max(1, int(0.7 * min(v, np.pi - v) / np.pi * width))
        corner = warped[:rows, :wide] if side == 0 else warped[:rows, -wide:]
        lattice_rows = max(1, int(u * len(places)))
        y = np.clip(places[:lattice_rows, column, 1], 0, len(photo) - 1).astype(int)
        border = max(1, photo.shape[1] // 32)
        part = photo[y.min() : y.max() + 1]
        background = part[:, :border] if side == 0 else part[:, -border:]
        found.append(_differ(corner, background))
    return found[0], found[1]


def _differ(one: NDArray[Any], other: NDArray[Any]) -> bool:
    if one.shape[2] == 4 and np.median(one[..., 3]) < 128:
        return False  # nothing is seen there
    one, other = (image[..., :3].reshape(-1, 3).astype(float) for image in (one, other))
    apart = np.linalg.norm(np.median(one, axis=0) - np.median(other, axis=0))
    spread = np.linalg.norm(other.std(axis=0))
    return bool(apart > SURELY_OTHER + spread)


def finish(
    warped: NDArray[Any], weights: FloatArray, brow: float = 0.0, engine: Engine = "auto"
) -> NDArray[np.uint8]:
    """Fade what is not trusted into a smooth extension of what is.

    Args:
        warped: (H, W, 3) uint8, or (H, W, 4) floats, of which the first three are colours times
            alpha; alpha (of 255) is then a further weight: 0 where the photo showed nothing.
        weights: (H, W) as from :func:`trust`.
        brow: u of the brows: above them hair may spread, below them skin alone.

    Returns:
        (H, W, 3) opaque colours.
    """
    height, width = warped.shape[:2]
    shape = tuple(max(1, side * _COARSE // max(height, width, _COARSE)) for side in (height, width))
    known: NDArray[Any] = weights[..., None].astype(np.float32)
    colours: NDArray[Any] = warped[..., :3].astype(np.float32)
    if warped.shape[2] == 4:
        alpha = warped[..., 3:] / np.float32(255.0)
        known = np.where(alpha > FAINTEST, known * np.minimum(alpha, 1.0), 0.0)
        colours = np.clip(colours / np.maximum(alpha, FAINTEST), 0.0, 255.0)
    if warped.dtype == np.uint8 and float(known.min()) >= 1.0:
        return warped[..., :3]

    def resized(image: NDArray[Any], to: tuple[int, ...]) -> NDArray[Any]:
        return warp(image, _frame(image.shape), _frame(to), (to[0], to[1]), engine=engine)

    # What is filled in is smooth: a coarse image holds all of it.
    small = resized(known, shape)
    coarse = resized(colours * known, shape) / np.maximum(small, 1e-6)
    sure = np.clip(small[..., 0], 0.0, 1.0)
    guess = resized(extend(coarse, sure * _like_skin(coarse, sure, brow)), (height, width))
    result = known * colours + (1.0 - known) * guess
    return np.asarray(np.clip(np.rint(result), 0, 255), dtype=np.uint8)


def _like_skin(colours: NDArray[Any], known: NDArray[Any], brow: float) -> NDArray[Any]:
    """(H, W) how near each colour below the brows comes to the face's middle one, which is skin.

    Brows, shadow and hair belong where the photo shows them, and are not to spread from there.
    """
    middle = np.median(colours[known > 0.5 * known.max()], axis=0)
    apart = np.linalg.norm(colours - middle, axis=-1) / SKIN_SPREAD
    # Never nothing: where all is unlike, all counts alike.
    like = np.maximum(np.exp(-(apart**2)), 1e-3)
    u = np.arange(0.5, len(colours)) / len(colours)
    above = step(0.0, 1.0, (1.0 - u / brow) / HAIRLINE)[:, None]
    return np.asarray(above + (1.0 - above) * like, dtype=np.float32)


def _fade(inside: FloatArray) -> FloatArray:
    return np.asarray(step(INSET, INSET + FADE, inside), dtype=np.float64)


def _frame(shape: tuple[int, ...]) -> FloatArray:
    """The corners of an image as a mesh."""
    x, y = np.meshgrid([0.0, shape[1]], [0.0, shape[0]])
    return np.stack([x, y], axis=-1)
