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
from pdeface.texture._point_checks import NAMES, POINT_NAMES, check_names
from pdeface.texture.points import FeaturePoints

__all__ = [
    "NODE_NAMES",
    "ScaledGrid",
    "check_targets",
    "fit_grid",
    "source_mesh",
    "texels",
    "uv_nodes",
]

FloatArray = NDArray[np.float64]

NODE_NAMES: tuple[tuple[str, ...], ...] = (
    ("a corner", *(f"the node above {name}" for name in POINT_NAMES[0]), "a corner"),
    *((f"the node beside {row[0]}", *row, f"the node beside {row[-1]}") for row in POINT_NAMES),
    ("a corner", *(f"the node below {name}" for name in POINT_NAMES[4]), "a corner"),
)
"""What errors call the 7 x 7 nodes."""


@dataclass(frozen=True, eq=False)
class ScaledGrid:
    """The uv grid laid over a photo (step 1): ``corner + v across + u down``.

    Attributes:
        corner: (2,) pixel position of u = v = 0.
        across: (2,) pixels per radian of v.
        down: (2,) pixels per unit of u.
    """

    corner: FloatArray
    across: FloatArray
    down: FloatArray

    def __call__(self, u: Any, v: Any) -> FloatArray:
        """(..., 2) pixel positions of points (u, v)."""
        u, v = np.asarray(u, float)[..., None], np.asarray(v, float)[..., None]
        return np.asarray(self.corner + v * self.across + u * self.down)

    def nodes(self, rows: int = 28, columns: int = 41) -> FloatArray:
        """(rows, columns, 2) pixel positions of the uv mesh's nodes, 0 <= v <= pi."""
        u, v = np.linspace(0.0, 1.0, rows), np.linspace(0.0, np.pi, columns)
        return self(u[:, None], v[None, :])


def check_targets(targets: Mapping[str, tuple[float, float]]) -> FloatArray:
    """(5, 5, 2) values (u, v) of the feature points on the face, inside the face and in order."""
    check_names(targets)
    uv = np.array([targets[name] for name in NAMES], dtype=np.float64).reshape(5, 5, 2)
    inside = (uv > 0.0) & (uv < (1.0, np.pi))
    if not inside.all():
        row, column, _ = np.argwhere(~inside)[0]
        raise InputError(
            f"targets must lie inside 0 < u < 1, 0 < v < pi, got {uv[row, column]} for "
            f"{POINT_NAMES[row][column]}"
        )
    return uv


def fit_grid(points: FeaturePoints, uv: FloatArray) -> ScaledGrid:
    """Step 1: the uv grid, scaled to the photo.

    The grid is turned with the line through the eyes, which undoes the head's tilt; scaled
    horizontally so that both eye centres fall on their grid points; and vertically so that the
    mouth corners (their mean, where a smile is crooked) fall on their horizontal of the grid.

    Args:
        points: feature points of the photo.
        uv: (5, 5, 2) as from :func:`check_targets`.
    """
    upright, eyes = points.upright(), points.array[1, [1, 3]]
    across = np.array([math.cos(points.tilt), math.sin(points.tilt)])
    down = np.array([-across[1], across[0]])
    v_right, v_left = uv[1, 1, 1], uv[1, 3, 1]
    u_eyes, u_mouth = uv[1, [1, 3], 0].mean(), uv[3, [1, 3], 0].mean()
    across = across * np.linalg.norm(eyes[1] - eyes[0]) / (v_left - v_right)
    down = down * upright[3, [1, 3], 1].mean() / (u_mouth - u_eyes)
    middle = eyes.mean(axis=0)
    corner = middle - 0.5 * (v_right + v_left) * across - u_eyes * down
    return ScaledGrid(corner, across, down)


def source_mesh(points: FeaturePoints, mesh: FloatArray, front: Front) -> FloatArray:
    """Step 2: the source mesh, 25 feature points and 24 nodes around them.

    The paper puts the 24 on the border of the photo, straight beyond the feature points, where
    they would draw background on to the sides of the face. Here they lie as far beyond as the
    neutral face reaches beyond its own feature points, seen from the front.

    Args:
        points: feature points of the photo.
        mesh: (7, 7, 2) the nodes as (u, v), from :func:`uv_nodes`.
        front: the face seen from the front.

    Returns:
        (7, 7, 2) pixel positions in the photo.
    """
    level = np.zeros((7, 7, 2))
    level[1:-1, 1:-1] = points.upright()
    seen = front(mesh[..., 0], mesh[..., 1])
    inner = seen[1:-1, 1:-1]
    spread = level[1:-1, 1:-1] - level[1:-1, 1:-1].mean(axis=(0, 1))
    own = inner - inner.mean(axis=(0, 1))
    scale = (spread * own).sum(axis=(0, 1)) / (own * own).sum(axis=(0, 1))
    nearest = np.clip(np.arange(7), 1, 5)
    near = np.ix_(nearest, nearest)
    beyond = (seen - seen[near]) * scale
    # Straight beyond, as in the paper: slanting rows and columns could fold.
    beyond[:, 1:-1, 0] = beyond[1:-1, :, 1] = 0.0
    level = level[near] + beyond
    across = np.array([math.cos(points.tilt), math.sin(points.tilt)])
    down = np.array([-across[1], across[0]])
    middle = points.array[1, [1, 3]].mean(axis=0)
    return np.asarray(middle + level[..., :1] * across + level[..., 1:] * down)


def uv_nodes(uv: FloatArray) -> FloatArray:
    """Step 3: the target mesh, read off the uv mesh.

    Args:
        uv: (5, 5, 2) where the face has the feature points, as from :func:`check_targets`.

    Returns:
        (7, 7, 2) values (u, v): the feature points, and 24 outer nodes straight beyond them on
        the border of the uv mesh.
    """
    nearest = np.clip(np.arange(7), 1, 5) - 1
    nodes = uv[np.ix_(nearest, nearest)].copy()
    nodes[0, :, 0], nodes[-1, :, 0] = 0.0, 1.0
    nodes[:, 0, 1], nodes[:, -1, 1] = 0.0, np.pi
    return nodes


def texels(uv: FloatArray, shape: tuple[int, int]) -> FloatArray:
    """(..., 2) texel positions (x, y) in a texture of (height, width) of points (u, v)."""
    return np.asarray(uv[..., ::-1] * (shape[1] / np.pi, shape[0]))
