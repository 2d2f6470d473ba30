"""Windows of the shape controls: from 0 to 1, smooth, and nothing beyond their support."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from pdeface.controls.shape.windows import STEEPEST, dome, fall, hill, rise

SMALL = st.floats(-10, 10)


@given(SMALL, st.floats(0.1, 10))
def test_a_rise_goes_from_0_to_1_and_never_back(start: float, width: float) -> None:
    x = np.linspace(start - width, start + 2 * width, 301)
    y = rise(x, start, start + width)
    assert (y[x <= start] == 0.0).all()
    assert (y[x >= start + width] == 1.0).all()
    assert (np.diff(y) >= 0.0).all()
    assert np.diff(y).max() <= STEEPEST * (x[1] - x[0]) / width * (1 + 1e-9)
    np.testing.assert_allclose(y + fall(x, start, start + width), 1.0, atol=1e-12)


def test_a_rise_has_two_continuous_derivatives() -> None:
    jumps = []
    for steps in (1000, 2000):
        x = np.linspace(-0.5, 1.5, 2 * steps + 1)
        second = np.diff(rise(x, 0.0, 1.0), 2) * steps**2
        jumps.append(np.abs(np.diff(second)).max())
    assert jumps[1] == pytest.approx(jumps[0] / 2, rel=0.05)


def test_a_hill_is_1_on_its_top_and_0_around() -> None:
    y = hill([-1.0, 0.0, 1.0, 1.5, 2.0, 3.0, 4.0], 0.0, 1.0, 2.0, 3.0)
    np.testing.assert_array_equal(y, [0, 0, 1, 1, 1, 0, 0])


@given(st.tuples(SMALL, SMALL, SMALL))
def test_a_dome_ends_at_its_ellipsoid(place: tuple[float, float, float]) -> None:
    points = np.array([place])
    weight = dome(points, (1.0, 2.0, 3.0), (2.0, 3.0, np.inf), 0.4)
    distance = np.hypot((place[0] - 1.0) / 2.0, (place[1] - 2.0) / 3.0)
    assert (weight[0] == 0.0) or distance < 1.0
    assert (weight[0] == 1.0) == (distance <= 0.4) or abs(distance - 0.4) < 0.05
