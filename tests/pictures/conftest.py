"""A head that needs no data: an ellipsoid with a nose."""

from __future__ import annotations

import numpy as np
import pytest

from pdeface.curves import BoundaryCurves, curve_parameters
from pdeface.face import Face


def head_points(rows: int = 13, half: int = 11) -> np.ndarray:
    """(rows, half, 3) points of the front, from the forehead down, right ear to left."""
    v = curve_parameters(2 * half)[:half][None, :]
    u = np.linspace(0.0, 1.0, rows)[:, None]
    ring = np.sqrt(1.0 - (0.55 * (2.0 * u - 1.0)) ** 2)
    nose = 0.03 * np.exp(-(((u - 0.55) / 0.12) ** 2) - ((v - np.pi / 2) / 0.25) ** 2)
    x = -0.075 * ring * np.cos(v)
    y = 0.10 - 0.20 * u + 0.0 * v
    z = (0.09 * ring + nose) * np.sin(v)
    return np.stack([x, y, z], axis=-1)


@pytest.fixture(scope="session")
def head() -> Face:
    return Face(BoundaryCurves.from_half(head_points(), 0.0))


@pytest.fixture(scope="session")
def painted(head: Face) -> Face:
    """The head in grey, with a red cheek on its left and a blue one on its right."""
    texture = np.full((64, 64, 3), 200, np.uint8)
    texture[28:44, 8:24] = (30, 60, 220)
    texture[28:44, 40:56] = (220, 40, 30)
    return head.with_texture(texture)
