"""Steps 1 to 3 of the paper's texture mapping: the scaled grid and the two warp meshes."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pdeface.errors import InputError
from pdeface.texture._front import Front
from pdeface.texture._point_checks import NAMES, OPTIONAL_NAMES, POINT_NAMES, check_names
from pdeface.texture.points import FeaturePoints

__all__ = ["ScaledGrid", "check_targets", "fit_grid", "uv_nodes", "warp_meshes"]

FloatArray = NDArray[np.float64]

_NEAREST = np.ix_(np.clip(np.arange(7), 1, 5), np.clip(np.arange(7), 1, 5))


@dataclass(frozen=True, eq=False)
class ScaledGrid:
    """The uv grid laid over a photo (step 1).

    Level coordinates are pixels from ``middle``, x along the line through the eyes.

    Attributes:
        front: the grid before it was scaled.
        scale: (2,) pixels per unit of ``front``, across and down.
        offset: (2,) level position of the origin of ``front``, pixels.
        middle: (2,) pixel position of the middle between the eyes.
        tilt: angle of the line through the eyes, radians, positive clockwise.
    """

    front: Front
    scale: FloatArray
    offset: FloatArray
    middle: FloatArray
    tilt: float

    def __call__(self, u: Any, v: Any) -> FloatArray:
        """(..., 2) pixel positions of points (u, v) in the photo."""
        return self.to_photo(self.level(u, v))

    def level(self, u: Any, v: Any) -> FloatArray:
        """(..., 2) level coordinates of points (u, v)."""
        u, v = np.broadcast_arrays(np.asarray(u, float), np.asarray(v, float))
        return np.asarray(self.front(u, v) * self.scale + self.offset)

    def to_photo(self, level: FloatArray) -> FloatArray:
        """Pixel positions in the photo of level coordinates."""
        across = np.array([math.cos(self.tilt), math.sin(self.tilt)])
        down = np.array([-across[1], across[0]])
        return np.asarray(self.middle + level[..., :1] * across + level[..., 1:] * down)

    def nodes(self, rows: int = 28, columns: int = 41) -> FloatArray:
        """(rows, columns, 2) pixel positions of the uv mesh's nodes, 0 <= v <= pi: Fig. 6(b)."""
        u, v = np.linspace(0.0, 1.0, rows), np.linspace(0.0, np.pi, columns)
        return self(u[:, None], v[None, :])


def check_targets(targets: Mapping[str, tuple[float, float]]) -> FloatArray:
    """(5, 5, 2) values (u, v) of the feature points on the face, inside the face and in order."""
    check_names({name: targets[name] for name in targets if name not in OPTIONAL_NAMES})
    uv = np.array([targets[name] for name in NAMES], dtype=np.float64).reshape(5, 5, 2)
    wrong = np.asarray(~((uv > 0.0) & (uv < (1.0, np.pi))).all(axis=-1))
    wrong[1:] |= np.diff(uv[..., 0], axis=0) <= 0.0
    wrong[:, 1:] |= np.diff(uv[..., 1], axis=1) <= 0.0
    if wrong.any():
        row, column = np.argwhere(wrong)[0]
        raise InputError(
            "targets must lie inside 0 < u < 1 and 0 < v < pi, u growing downwards and v from the "
            f"subject's right to left; got {tuple(uv[row, column].tolist())} for "
            f"{POINT_NAMES[row][column]}"
        )
    return uv


def fit_grid(points: FeaturePoints, uv: FloatArray, front: Front) -> ScaledGrid:
    """Step 1: the uv grid, scaled to the photo.

    The grid is turned with the line through the eyes, which undoes the head's tilt; scaled
    horizontally so that both eye centres fall on their columns of the grid; and vertically so that
    the mouth corners (their mean, where a smile is crooked) fall on their row.

    Args:
        points: feature points of the photo.
        uv: (5, 5, 2) as from :func:`check_targets`.
        front: the grid before it is scaled.
    """
    level, seen = points.upright(), front(uv[..., 0], uv[..., 1])
    eyes, mouth = np.s_[1, [1, 3]], np.s_[3, [1, 3]]
    middle, seen_middle = level[eyes].mean(axis=0), seen[eyes].mean(axis=0)
    across = np.diff(level[eyes], axis=0)[0, 0] / np.diff(seen[eyes], axis=0)[0, 0]
    down = level[mouth].mean(axis=0)[1] / (seen[mouth].mean(axis=0) - seen_middle)[1]
    scale = np.array([across, down])
    centre = points.array[eyes].mean(axis=0)
    return ScaledGrid(front, scale, middle - seen_middle * scale, centre, points.tilt)


def uv_nodes(uv: FloatArray) -> FloatArray:
    """(7, 7, 2) values (u, v) of the feature points and, straight beyond, the mesh's border."""
    nodes = uv[_NEAREST[0] - 1, _NEAREST[1] - 1].copy()
    nodes[0, :, 0], nodes[-1, :, 0] = 0.0, 1.0
    nodes[:, 0, 1], nodes[:, -1, 1] = 0.0, np.pi
    return nodes


def warp_meshes(
    points: FeaturePoints, uv: FloatArray, grid: ScaledGrid
) -> tuple[FloatArray, FloatArray]:
    """Steps 2 and 3: the source and the target mesh, 7 x 7 nodes each, in level coordinates.

    The 25 inner nodes of the source mesh are the photo's feature points; those of the target mesh
    are where the grid has these points. The paper puts the 24 others on the border of the photo,
    straight beyond the feature points. Here they lie straight beyond them at the border of the
    face: as far as the grid reaches, in the target; in the source as far too, but at the scale
    that fits all 25 points best (in a smile, the mouth corners alone would give a wrong one).
    """
    level = points.upright()
    nodes = uv_nodes(uv)
    seen = grid.front(nodes[..., 0], nodes[..., 1])
    spread = level - level.mean(axis=(0, 1))
    own = seen[1:-1, 1:-1] - seen[1:-1, 1:-1].mean(axis=(0, 1))
    best = (spread * own).sum(axis=(0, 1)) / (own * own).sum(axis=(0, 1))
    beyond = _straight(seen - seen[_NEAREST])
    target = grid.level(uv[..., 0], uv[..., 1])
    inner = _NEAREST[0] - 1, _NEAREST[1] - 1
    return level[inner] + beyond * best, target[inner] + beyond * grid.scale


def _straight(beyond: FloatArray) -> FloatArray:
    """Keep of (7, 7, 2) steps beyond the feature points what goes straight outwards.

    A slanting row or column could fold. At its least, the way is a hundredth of the face's size.
    """
    inner = _NEAREST[0][:, 0]
    across, down = beyond[inner, :, 0].copy(), beyond[:, inner, 1].copy()
    across[:, 1:-1] = down[1:-1] = 0.0
    least = 0.01 * np.abs(beyond).max()
    for outer, sign in ((0, -1.0), (-1, 1.0)):
        across[:, outer] = sign * np.maximum(sign * across[:, outer], least)
        down[outer] = sign * np.maximum(sign * down[outer], least)
    return np.stack([across, down], axis=-1)
