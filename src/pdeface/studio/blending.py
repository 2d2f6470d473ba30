"""Two faces as one: curves and textures between them."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from pdeface.curves import BoundaryCurves
from pdeface.errors import InputError, require
from pdeface.face import Face

__all__ = ["blended"]

Pixels = NDArray[np.uint8]


def blended(one: Face, other: Face, share: float) -> Face:
    """The face that is ``share`` of the way from one to another, without weights.

    Curves are mixed point by point: rows and columns lie on the same features of every face. Their
    textures, which are pinned to the same (u, v), texel by texel.

    Args:
        one: at 0.
        other: at 1.
        share: 0 to 1.

    Raises:
        InputError: curves of different sizes, or a share out of range.
    """
    if not 0.0 <= share <= 1.0:
        raise InputError(f"a share of a blend lies in [0, 1], got {share:g}; choose one inside")
    if one.curves.shape != other.curves.shape:
        raise InputError(
            f"faces are blended that have as many curves and points, got {one.curves.shape} and "
            f"{other.curves.shape}; make both at one level"
        )
    points = (1.0 - share) * one.curves.points + share * other.curves.points
    mirror = (1.0 - share) * one.curves.mirror_z + share * other.curves.mirror_z
    bare = one.with_weights(dict.fromkeys(one.weights, 0.0))
    return bare.with_curves(BoundaryCurves(points, mirror)).with_texture(_mixed(one, other, share))


def _mixed(one: Face, other: Face, share: float) -> Pixels | None:
    """The texture between two; that of the only one that has one."""
    if one.texture is None or other.texture is None:
        return one.texture if other.texture is None else other.texture
    height, width = one.texture.shape[:2]
    image = require("PIL.Image", "texture", "to blend textures")
    second = image.fromarray(np.ascontiguousarray(other.texture[..., :3])).resize((width, height))
    mixed = (1.0 - share) * one.texture[..., :3] + share * np.asarray(second, dtype=np.float64)
    return np.rint(mixed).astype(np.uint8)
