"""The paper's texture mapping (section 3): a photo and its feature points to a texture.

1. Fit the uv grid to the photo by scaling it on eyes and mouth.
2. The source warp mesh M_s: the feature points, and nodes around them.
3. The target warp mesh M_t: where the uv mesh has these points.
4. The two-pass mesh warp.
5. The warped image textures the uv mesh: texture coordinates are (v, u).
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pdeface.errors import InputError
from pdeface.images import MAX_SIDE
from pdeface.texture import _finish, _grid
from pdeface.texture._front import neutral_front, straight_front
from pdeface.texture._lattice import lattice_names, photo_lattice
from pdeface.texture._margins import clean_margins
from pdeface.texture._result import UVTexture
from pdeface.texture._upright import set_upright
from pdeface.texture.points import FeaturePoints
from pdeface.texture.warp import Engine, warp

__all__ = ["photo_mesh", "uv_texture"]

FloatArray = NDArray[np.float64]
Pixels = NDArray[np.uint8]

_SMALLEST, _LARGEST, _STEP = 512, 4096, 16


def uv_texture(
    image: Any,
    points: FeaturePoints,
    size: tuple[int, int] | None = None,
    targets: Mapping[str, tuple[float, float]] | None = None,
    *,
    finish: bool = True,
    margins: bool = True,
    follow_face: bool = True,
    engine: Engine = "auto",
) -> UVTexture:
    """Turn a frontal photo into a texture for the uv mesh, by the paper's five steps.

    What differs from the paper, and why:

    - The head's tilt is undone first, by the line through the eyes.
    - The grid of step 1 is the neutral face's uv mesh seen from the front, not a straight one: its
      rows and columns are not evenly spaced on the face, so that a straight grid is right at the
      feature points and nowhere else.
    - The outer nodes of the warp meshes lie on the border of the face, not of the photo, and the
      texture's edge is finished: beside the face a photo shows background, hair and ears.
    - If the mouth is open (the points ``upper_lip`` and ``lower_lip`` say so), what shows between
      the lips is left out of them, because the face's mouth is closed.
    - The photo is resampled once, straight to the uv mesh, so that the texture coordinates are
      simply (v / pi, u).

    Args:
        image: (h, w), (h, w, 3) or (h, w, 4) uint8; transparent pixels count as unknown.
        points: the 25 feature points, placed on this photo or on a scaled copy of it.
        size: (height, width) of the texture, at most 8192; by default enough to keep every
            detail of the photo, from 512 to 4096.
        targets: (u, v) of each feature point on the face; those of the template by default.
        finish: whether to fade the texture's edge, from the face's outline outwards, into the
            skin's colour. Without it the photo's pixels there are stretched to the edge.
        margins: whether to take the photo's lashes off the upper lids and its teeth off the lips,
            which would show when the face moves, and draw a fine dark line there instead.
        follow_face: whether the grid of step 1 is the neutral face's; if not, it is straight.
        engine: as for :func:`pdeface.texture.warp`.

    Raises:
        InputError: a point is outside the photo or in crossing order (the message names it), or
            the photo or ``size`` cannot be used.
    """
    photo = _check_photo(image)
    points = points.scaled_to(photo.shape)
    points.validate(photo.shape)
    uv = _grid.check_targets(targets or _template_targets())
    photo, points = set_upright(photo, points, engine)

    grid = _grid.fit_grid(points, uv, neutral_front if follow_face else straight_front)
    source, target = _grid.warp_meshes(points, uv, grid)
    shape = _check_size(size) if size else _size_for(points.array, uv)
    places, lattice = photo_lattice(source, target, uv, grid, points.opening())
    texel = np.array([shape[1] / np.pi, shape[0]])
    names = lattice_names(uv)
    warped = _warp_marked(photo, places, lattice[..., ::-1] * texel, shape, engine, names)
    weights = np.ones(shape)
    if finish:
        hair = _finish.hair_beside(warped, photo, places, uv)
        weights = _finish.trust(uv, shape, hair)
    texture = _finish.finish(warped, weights, float(uv[0, :, 0].mean()), engine)
    if margins:
        texture = clean_margins(texture)
    return UVTexture(
        image=texture,
        warped=np.clip(np.rint(warped[..., :3]), 0, 255).astype(np.uint8),
        photo=photo,
        points=points,
        grid=grid,
        targets=uv,
        source_mesh=grid.to_photo(source),
        target_mesh=_grid.uv_nodes(uv)[..., ::-1] * texel,
        grid_mesh=grid.to_photo(target),
    )


def photo_mesh(points: FeaturePoints) -> FloatArray:
    """(7, 7, 2) the source warp mesh M_s over the photo, pixels: Fig. 6(c), without the warp.

    Args:
        points: the feature points, on a photo however tilted.

    Raises:
        InputError: two points are in crossing order.
    """
    points.validate(points.image_size[::-1])
    uv = _grid.check_targets(_template_targets())
    grid = _grid.fit_grid(points, uv, neutral_front)
    return grid.to_photo(_grid.warp_meshes(points, uv, grid)[0])


def _warp_marked(
    photo: Pixels,
    source: FloatArray,
    target: FloatArray,
    shape: tuple[int, int],
    engine: Engine,
    names: list[list[str]],
) -> NDArray[Any]:
    """Step 4: (H, W, 3) uint8; or, if some of the photo is unknown, (H, W, 4) floats.

    The floats are colours times alpha, so that no colour bleeds out of what is unseen: transparent
    pixels, and everything outside a photo that cuts the face's edge off.
    """
    height, width = photo.shape[:2]
    low = np.floor(source.min(axis=(0, 1))).astype(int) - 3
    high = np.ceil(source.max(axis=(0, 1))).astype(int) + 3
    cut = bool((low < 0).any() or (high > (width, height)).any())
    if photo.shape[2] == 4 or cut:
        low, high = np.maximum(low, 0), np.minimum(high, (width, height))
        part = _with_alpha(photo[low[1] : high[1], low[0] : high[0]])
        # Beyond its border an image repeats its last pixels: a transparent border is enough.
        part = np.pad(part, ((2, 2), (2, 2), (0, 0)))
        return warp(part, source - low + 2.0, target, shape, engine=engine, names=names)
    return warp(photo, source, target, shape, engine=engine, names=names)


def _with_alpha(photo: Pixels) -> NDArray[np.float32]:
    """(h, w, 4) floats, colours times alpha."""
    result = np.full((*photo.shape[:2], 4), 255.0, np.float32)
    result[..., : photo.shape[2]] = photo
    result[..., :3] *= result[..., 3:] / np.float32(255.0)
    return result


def _size_for(points: FloatArray, uv: FloatArray) -> tuple[int, int]:
    """(height, width) at which no part of the face, as seen in the photo, loses pixels."""
    wide = np.linalg.norm(np.diff(points, axis=1), axis=-1) / np.diff(uv[..., 1], axis=1) * np.pi
    high = np.linalg.norm(np.diff(points, axis=0), axis=-1) / np.diff(uv[..., 0], axis=0)
    sides = (int(np.ceil(side.max() / _STEP)) * _STEP for side in (high, wide))
    height, width = (min(max(side, _SMALLEST), _LARGEST) for side in sides)
    return height, width


def _check_photo(image: Any) -> Pixels:
    photo = np.asarray(image)
    if photo.ndim == 2:
        photo = np.repeat(photo[..., None], 3, axis=2)
    if photo.dtype != np.uint8 or photo.ndim != 3 or photo.shape[2] not in (3, 4):
        raise InputError(
            "a photo must be an array of uint8 with the shape (height, width), (height, width, 3) "
            f"or (height, width, 4), got {photo.dtype} {np.shape(image)}; "
            "read it with pdeface.texture.read_photo"
        )
    return photo


def _check_size(size: Any) -> tuple[int, int]:
    try:
        height, width = (int(side) for side in size)
    except (TypeError, ValueError):
        height = width = 0
    if not (2 <= height <= MAX_SIDE and 2 <= width <= MAX_SIDE):
        raise InputError(f"size must be (height, width), each from 2 to {MAX_SIDE}, got {size!r}")
    return height, width


def _template_targets() -> Mapping[str, tuple[float, float]]:
    from pdeface import template

    targets: Mapping[str, tuple[float, float]] = template.feature_points()
    return targets
