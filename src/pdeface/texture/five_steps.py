"""The paper's texture mapping (section 3): a photo and its feature points to a texture.

1. Fit the uv grid to the photo by scaling it on eyes and mouth.
2. The source warp mesh M_s: the feature points, and nodes around them.
3. The target warp mesh M_t: where the uv mesh has these points.
4. The two-pass mesh warp.
5. The warped image textures the uv mesh: texture coordinates are (v, u).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pdeface.errors import InputError
from pdeface.texture import _finish, _grid
from pdeface.texture._front import Front, neutral_front, refine
from pdeface.texture._grid import ScaledGrid
from pdeface.texture._upright import set_upright
from pdeface.texture.points import FeaturePoints
from pdeface.texture.warp import Engine, warp

__all__ = ["UVTexture", "uv_texture"]

FloatArray = NDArray[np.float64]
Pixels = NDArray[np.uint8]

PARTS = 6

_SMALLEST, _LARGEST, _STEP = 512, 4096, 16


@dataclass(frozen=True, eq=False)
class UVTexture:
    """A texture for the uv mesh, and everything that led to it.

    Attributes:
        image: (H, W, 3) uint8, step 5: row ``u H``, column ``v W / pi``, the whole face.
        warped: (H, W, 3) uint8, step 4: before its edge was finished.
        photo: (h, w, 3 or 4) uint8 that the meshes lie on: the given photo, or a turned copy
            if the head was tilted by more than 15 degrees.
        points: the feature points in ``photo``.
        grid: the scaled uv grid in ``photo``, step 1.
        targets: (5, 5, 2) values (u, v) of the feature points.
        source_mesh: (7, 7, 2) M_s, pixels of ``photo``, step 2.
        target_mesh: (7, 7, 2) M_t, texels of ``image``, step 3.
    """

    image: Pixels
    warped: Pixels
    photo: Pixels
    points: FeaturePoints
    grid: ScaledGrid
    targets: FloatArray
    source_mesh: FloatArray
    target_mesh: FloatArray

    def uv_nodes(self, rows: int = 28, columns: int = 41) -> FloatArray:
        """(rows, columns, 2) texel positions of the uv mesh's nodes, Fig. 6(e)."""
        height, width = self.image.shape[:2]
        x, y = np.meshgrid(np.linspace(0.0, width, columns), np.linspace(0.0, height, rows))
        return np.stack([x, y], axis=-1)


def uv_texture(
    image: Any,
    points: FeaturePoints,
    size: tuple[int, int] | None = None,
    targets: Mapping[str, tuple[float, float]] | None = None,
    *,
    finish: bool = True,
    engine: Engine = "auto",
    front: Front = neutral_front,
) -> UVTexture:
    """Turn a frontal photo into a texture for the uv mesh, by the paper's five steps.

    Differences from the paper: the head's tilt is undone first, by the line through the eyes;
    the outer nodes of M_s lie near the face's outline instead of on the photo's border, and the
    texture's edge is finished, both because a frontal photo has background, hair and ears where
    the texture needs the sides of the face; and the texture is cut to the uv mesh, so that its
    texture coordinates are simply (v / pi, u).

    Args:
        image: (h, w), (h, w, 3) or (h, w, 4) uint8; transparent pixels count as unknown.
        points: the 25 feature points, placed on this photo or on a scaled copy of it.
        size: (height, width) of the texture, at most 8192; by default enough to keep every
            detail of the photo, from 512 to 4096.
        targets: (u, v) of each feature point on the face; those of the template by default.
        finish: whether to fade the texture's edge, from the face's outline outwards, into the
            skin's colour. Without it the photo's pixels there are stretched to the edge.
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

    grid = _grid.fit_grid(points, uv)
    nodes = _grid.uv_nodes(uv)
    source = _grid.source_mesh(points, nodes, front)
    shape = _check_size(size) if size else _size_for(source, uv)
    target = _grid.texels(nodes, shape)
    fine_source, fine_uv = refine(source, nodes, front, PARTS)
    fine_target = _grid.texels(fine_uv, shape)
    warped = _warp_marked(photo, fine_source, fine_target, shape, engine)
    weights = _finish.trust(target, shape) if finish else np.ones(shape)
    texture = _finish.finish(warped, weights, engine)
    return UVTexture(texture, warped[..., :3], photo, points, grid, uv, source, target)


def _warp_marked(
    photo: Pixels, source: FloatArray, target: FloatArray, shape: tuple[int, int], engine: Engine
) -> Pixels:
    """Step 4; with alpha (and colours multiplied by it) if some of the photo is unknown.

    Unknown are transparent pixels, and everything outside a photo that cuts the face's edge off.
    """
    low, high = source.min(axis=(0, 1)), source.max(axis=(0, 1))
    height, width = photo.shape[:2]
    cut = bool((low < 0.0).any() or (high > (width, height)).any())
    if photo.shape[2] == 4 or cut:
        photo = _with_alpha(photo)
    if cut:
        # Beyond its border an image repeats its last pixels: a transparent border is enough.
        photo = np.pad(photo, ((2, 2), (2, 2), (0, 0)))
        source = source + 2.0
    return warp(photo, source, target, shape, engine=engine)


def _with_alpha(photo: Pixels) -> Pixels:
    """(h, w, 4), colours multiplied by alpha, so that no colour bleeds out of what is unseen."""
    if photo.shape[2] == 3:
        return np.concatenate([photo, np.full_like(photo[..., :1], 255)], axis=2)
    alpha = photo[..., 3:].astype(np.uint16)
    colours = ((photo[..., :3] * alpha + 127) // 255).astype(np.uint8)
    return np.concatenate([colours, photo[..., 3:]], axis=2)


def _size_for(source: FloatArray, uv: FloatArray) -> tuple[int, int]:
    """(height, width) at which no part of the face, as seen in the photo, loses pixels."""
    inner = source[1:-1, 1:-1]
    wide = np.linalg.norm(np.diff(inner, axis=1), axis=-1) / np.diff(uv[..., 1], axis=1) * np.pi
    high = np.linalg.norm(np.diff(inner, axis=0), axis=-1) / np.diff(uv[..., 0], axis=0)
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
    if not (2 <= height <= 2 * _LARGEST and 2 <= width <= 2 * _LARGEST):
        raise InputError(
            f"size must be (height, width), each from 2 to {2 * _LARGEST}, got {size!r}"
        )
    return height, width


def _template_targets() -> Mapping[str, tuple[float, float]]:
    from pdeface import template

    targets: Mapping[str, tuple[float, float]] = template.feature_points()
    return targets
