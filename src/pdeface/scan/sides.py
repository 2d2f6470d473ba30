"""The sides from which a face is looked for on a scan."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

__all__ = ["around", "usual"]

FloatArray = NDArray[np.float64]

_X, _Y, _Z = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)
_USUAL = (
    (_Z, _Y),
    ((0.0, -1.0, 0.0), _Z),
    ((0.0, 0.0, -1.0), _Y),
    (_Y, _Z),
    (_X, _Y),
    ((-1.0, 0.0, 0.0), _Y),
)
"""Forwards and up, as scans usually have them."""

_AROUND = 40


def usual() -> list[FloatArray]:
    """(3, 3) axes, rows: right, up, towards the viewer, as scans usually have them."""
    return [_axes(np.array(forward), np.array(up)) for forward, up in _USUAL]


def around() -> Iterator[FloatArray]:
    """(3, 3) axes to look along from all around, each upright and turned by an eighth."""
    index = np.arange(_AROUND) + 0.5
    polar, azimuth = np.arccos(1.0 - 2.0 * index / _AROUND), np.pi * (1.0 + 5.0**0.5) * index
    ways = np.stack(
        [np.cos(azimuth) * np.sin(polar), np.cos(polar), np.sin(azimuth) * np.sin(polar)], axis=1
    )
    for forward in ways:
        axes = _axes(forward, np.eye(3)[1 if abs(forward[1]) < 0.8 else 0])
        yield axes
        yield _turned(axes, np.pi / 4)


def _axes(forward: FloatArray, up: FloatArray) -> FloatArray:
    right = np.cross(up, forward)
    right /= np.linalg.norm(right)
    return np.stack([right, np.cross(forward, right), forward])


def _turned(axes: FloatArray, angle: float) -> FloatArray:
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, s, 0.0], [-s, c, 0.0], [0.0, 0.0, 1.0]]) @ axes
