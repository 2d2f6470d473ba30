"""What the tests of textures share."""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np
import pytest
from numpy.typing import NDArray

from pdeface.texture import POINT_NAMES, FeaturePoints

Targets = Mapping[str, tuple[float, float]]


@pytest.fixture(params=["numpy", "numba"])
def engine(request: pytest.FixtureRequest) -> str:
    if request.param == "numba":
        pytest.importorskip("numba")
    return str(request.param)


@pytest.fixture
def frame():
    """The corners of an image of (height, width) as a 2 x 2 mesh."""

    def corners(height: float, width: float) -> NDArray[np.float64]:
        x, y = np.meshgrid([0.0, width], [0.0, height])
        return np.stack([x, y], axis=-1)

    return corners


@pytest.fixture
def targets() -> Targets:
    """A plausible, symmetric layout of the feature points on a face."""
    u = [0.25, 0.35, 0.55, 0.7, 0.92]
    v = [0.25, 1.0, math.pi / 2, math.pi - 1.0, math.pi - 0.25]
    return {
        name: (u[row], v[column])
        for row, names in enumerate(POINT_NAMES)
        for column, name in enumerate(names)
    }


@pytest.fixture
def face_points() -> FeaturePoints:
    """Points of an upright face of about 90 x 100 pixels in a photo of 160 x 200."""
    rows = [
        [(35, 60), (55, 57), (80, 60), (105, 57), (125, 60)],
        [(33, 72), (57, 71), (80, 73), (103, 71), (127, 72)],
        [(35, 100), (70, 98), (80, 96), (90, 98), (125, 100)],
        [(40, 120), (62, 119), (80, 121), (98, 119), (120, 120)],
        [(51, 143), (62, 150), (80, 156), (98, 150), (109, 143)],
    ]
    return FeaturePoints.from_array(rows, (160, 200))
