"""What random people wear about their faces: hair that has a shape, and clothes.

In a photo a face is hardly ever seen with a bare skull and neck before an even wall. What is learnt
from bare heads reads who they are from ears and skulls, which photos do not show.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import gaussian_filter, median_filter, zoom
from scipy.spatial import cKDTree

from pdeface.photo.build.heads import Head
from pdeface.uvmesh import UVMesh

__all__ = ["Cover", "random_covers", "random_ground"]

FloatArray = NDArray[np.float64]

_HAIRY, _LONG, _CLAD, _SKIN_COLORED = 0.75, 0.45, 0.75, 0.2
"""Shares of people with hair, of these with long hair, of people in clothes, and of clothes that
are of the skin's colour, as bare shoulders are."""

_EVEN = 0.3
"""Share of the grounds that are of one colour."""

_MIDDLE = np.array([0.0, 0.045, 0.01])
"""About which a skull is round, metres."""

_ROWS, _COLUMNS = 64, 128
_LINE = np.array([[0.0, 0.088], [0.5, 0.085], [0.9, 0.06], [1.2, 0.045], [1.7, 0.065],
                  [2.2, 0.0], [np.pi, -0.04]])  # fmt: skip
"""Height of the hairline by the angle from ahead about the vertical, metres."""

_SUNK = 4e-3
"""How far below the skin hair lies where none grows, metres."""

_NECK, _SHOULDERS = np.array([0.068, 0.068]), np.array([0.16, 0.05])
"""Half a neck's width and depth, and how much more shoulders are, metres."""


class Cover(NamedTuple):
    """Something worn.

    Attributes:
        vertices: (V, 3) metres.
        triangles: (T, 3), seen from their front sides.
        color: (V, 3) sRGB from 0 to 1.
    """

    vertices: FloatArray
    triangles: NDArray[np.int32]
    color: FloatArray


def random_covers(rng: np.random.Generator, head: Head, tone: FloatArray) -> list[Cover]:
    """Hair and clothes for a head, or nothing.

    Args:
        rng: decides.
        head: whose.
        tone: (3,) sRGB of the skin.
    """
    covers = []
    if rng.random() < _HAIRY:
        color = np.clip(rng.uniform(0.03, 0.75) * np.array([1.0, 0.8, 0.6]) ** rng.uniform(0, 1.5),
                        0.02, 0.9)  # fmt: skip
        covers.append(_cap(rng, head, color))
        if rng.random() < _LONG:
            covers.append(_curtain(rng, color))
    if rng.random() < _CLAD:
        bare = rng.random() < _SKIN_COLORED
        covers.append(_clothes(rng, tone if bare else rng.uniform(0.03, 0.95, 3)))
    return covers


def random_ground(rng: np.random.Generator, size: tuple[int, int]) -> FloatArray:
    """(H, W, 3) what is behind a head, sRGB from 0 to 1: an even wall, or blurred things."""
    width, height = size
    image = np.ones((height, width, 3)) * rng.uniform(0.05, 0.95, 3)
    if rng.random() < _EVEN:
        return image
    for _ in range(rng.integers(2, 9)):
        middle, half = rng.uniform(0.0, 1.0, 2), rng.uniform(0.05, 0.5, 2)
        low, high = (np.clip((middle + s * half) * (height, width), 0, None).astype(int)
                     for s in (-1.0, 1.0))  # fmt: skip
        image[low[0] : high[0], low[1] : high[1]] = rng.uniform(0.0, 1.0, 3)
    image = gaussian_filter(image, (*[rng.uniform(0.0, 12.0)] * 2, 0))
    return image * (1.0 + rng.uniform(0.0, 0.3) * _noise(rng, (height, width), 24)[..., None])


def _cap(rng: np.random.Generator, head: Head, color: FloatArray) -> Cover:
    """Hair on the skull: short or thick, its line high or low on the forehead."""
    down, around = np.meshgrid(np.linspace(0.02, 2.5, _ROWS),
                               np.linspace(-np.pi, np.pi, _COLUMNS), indexing="ij")  # fmt: skip
    ways = np.stack([np.sin(down) * np.sin(around), np.cos(down), np.sin(down) * np.cos(around)],
                    axis=-1)  # fmt: skip
    radius = _skull(head, ways)
    height = (_MIDDLE + radius[..., None] * ways)[..., 1]
    grown = height - _hairline(rng, around)
    thickness = np.exp(rng.uniform(np.log(2e-3), np.log(45e-3)))
    full = np.clip(grown / rng.uniform(0.006, 0.04), 0.0, 1.0)
    full = full * full * (3.0 - 2.0 * full) * (1.0 + 0.5 * _noise(rng, down.shape, 12))
    out = radius + np.where(grown > 0.0, 1e-3 + thickness * full, np.maximum(4.0 * grown, -_SUNK))
    vertices = _MIDDLE + out[..., None] * ways
    triangles = _grid(*down.shape)
    triangles = triangles[(grown.ravel()[triangles] > -0.012).any(axis=1)]
    return Cover(vertices.reshape(-1, 3), triangles, _strands(rng, color, down.shape))


def _skull(head: Head, ways: FloatArray) -> FloatArray:
    """(rows, columns) how far a head reaches in some directions, without its ears."""
    points = head.vertices[np.unique(head.skin)] - _MIDDLE
    away = np.linalg.norm(points, axis=1)
    tree = cKDTree(points / away[:, None])
    near = tree.query(ways.reshape(-1, 3), k=4)[1]
    radius = away[near].mean(axis=1).reshape(ways.shape[:2])
    return np.minimum(radius, median_filter(radius, (13, 13), mode="nearest") + 4e-3)


def _hairline(rng: np.random.Generator, around: FloatArray) -> FloatArray:
    """Heights: of someone's, a little otherwise on either side."""
    lines = _LINE[:, 1] + rng.normal(0.0, 0.008, len(_LINE))
    lines[:2] += rng.uniform(-0.022, 0.02)
    line = np.interp(np.abs(around), _LINE[:, 0], lines)
    phase, swing = rng.uniform(0.0, 2.0 * np.pi), rng.normal(0.0, 0.006)
    return np.asarray(line + swing * np.sin(rng.uniform(1.0, 6.0) * around + phase))


def _curtain(rng: np.random.Generator, color: FloatArray) -> Cover:
    """Long hair, hanging down from the top of the ears, with the face between its edges."""
    edge = rng.uniform(0.95, 1.7, 2)
    along, down = np.meshgrid(np.linspace(0.0, 1.0, 80), np.linspace(0.0, 1.0, 24), indexing="ij")
    around = edge[0] + along * (2.0 * np.pi - edge.sum())
    top, bottom = 0.105, rng.uniform(-0.26, 0.02)
    out = rng.uniform(0.0, 0.035) + rng.normal(0.0, 0.03) * down**2
    out = out + rng.uniform(0.0, 0.012) * _noise(rng, along.shape, 8) - 0.035 * (1.0 - down) ** 6
    vertices = np.stack([(0.088 + out) * np.sin(around), top + (bottom - top) * down,
                         (0.1 + out) * np.cos(around)], axis=-1)  # fmt: skip
    triangles = _grid(*along.shape)
    both = np.concatenate([triangles[:, ::-1], triangles])
    colors = _strands(rng, color, along.shape[::-1], turned=True)
    return Cover(vertices.reshape(-1, 3), both, colors)


def _clothes(rng: np.random.Generator, color: FloatArray) -> Cover:
    """Around the neck and over the shoulders, with or without stripes."""
    down, around = np.meshgrid(np.linspace(0.0, 1.0, 40), np.linspace(-np.pi, np.pi, 64),
                               indexing="ij")  # fmt: skip
    slope = np.clip(down / rng.uniform(0.2, 0.5), 0.0, 1.0)
    ease = rng.uniform(0.0, 0.02) * (1.0 - down)
    more = _SHOULDERS * rng.uniform(0.7, 1.2)
    wide, deep = (a + ease + b * slope * slope * (3.0 - 2.0 * slope)
                  for a, b in zip(_NECK, more, strict=True))  # fmt: skip
    neckline = rng.uniform(0.0, 0.07) * np.clip(np.cos(around), 0.0, None) ** 2 * (1.0 - down)
    height = rng.uniform(-0.15, -0.095) - neckline - 0.3 * down
    vertices = np.stack([wide * np.sin(around), height, deep * np.cos(around) - 0.006], axis=-1)
    stripes = rng.uniform(0.0, 0.5) * (rng.random() < 0.4)
    pattern = np.sign(np.sin(rng.uniform(20.0, 120.0) * down + rng.integers(0, 20) * around))
    shade = 1.0 + stripes * pattern + 0.15 * _noise(rng, down.shape, 10)
    colors = np.clip(color * shade[..., None], 0.0, 1.0).reshape(-1, 3)
    return Cover(vertices.reshape(-1, 3), _grid(*down.shape), colors)


def _strands(
    rng: np.random.Generator, color: FloatArray, shape: tuple[int, int], turned: bool = False
) -> FloatArray:
    """(rows * columns, 3) a colour in streaks that run down."""
    streaks = rng.normal(0.0, rng.uniform(0.0, 0.3), shape[1]) + 0.1 * _noise(rng, shape, 6)
    shade = np.clip(1.0 + streaks, 0.3, 1.8)
    shade = shade.T if turned else shade
    return np.asarray(np.clip(color * shade.reshape(-1, 1), 0.0, 1.0))


def _noise(rng: np.random.Generator, shape: tuple[int, int], cells: int) -> FloatArray:
    """Smooth noise of about 1."""
    coarse = rng.normal(size=(cells, cells))
    fine = zoom(coarse, (shape[0] / cells, shape[1] / cells), order=1)
    return np.asarray(fine[: shape[0], : shape[1]])


def _grid(rows: int, columns: int) -> NDArray[np.int32]:
    """Triangles of a grid, anticlockwise where rows go down and columns to the left."""
    quads = UVMesh(rows, columns).quads
    return np.concatenate([quads[:, [0, 1, 3]], quads[:, [3, 1, 2]]])
