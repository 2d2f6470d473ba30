"""Closed boundary curves: sampling, reflection, and what is refused."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from pdeface.curves import BoundaryCurves, curve_parameters, mirror_points
from pdeface.errors import InputError

HALF = arrays(np.float64, (3, 4, 3), elements=st.floats(-1.0, 1.0))
HEIGHT = st.floats(-1.0, 1.0)


def test_point_11_of_46_lies_on_the_midline():
    assert curve_parameters(46)[11] == pytest.approx(np.pi / 2)


@pytest.mark.parametrize("count", [4, 5, 46, 92])
def test_points_are_evenly_spaced_and_their_reflections_are_points(count):
    v = curve_parameters(count)
    np.testing.assert_allclose(np.diff(v), 2 * np.pi / count)
    np.testing.assert_allclose(v[::-1], 2 * np.pi - v)


@given(HALF, HEIGHT)
def test_closed_curves_are_their_own_reflection(half, height):
    curves = BoundaryCurves.from_half(half, height)
    assert curves.shape == (3, 8)
    assert curves.is_mirrored
    np.testing.assert_array_equal(curves.half, half)
    reflected = curves.points[:, ::-1] * [1.0, 1.0, -1.0] + [0.0, 0.0, 2 * height]
    np.testing.assert_allclose(reflected, curves.points, atol=1e-15)


@given(HALF, HEIGHT)
def test_a_moved_point_breaks_the_reflection(half, height):
    curves = BoundaryCurves.from_half(half, height)
    displacement = np.zeros((3, 8, 3))
    displacement[1, 2, 0] = 0.25
    assert not curves.displaced(displacement).is_mirrored


def test_an_odd_number_of_points_is_not_mirrored():
    assert not BoundaryCurves(np.zeros((2, 5, 3))).is_mirrored


def test_mirroring_a_batch_mirrors_each():
    halves = np.random.default_rng(3).normal(size=(2, 5, 3, 4, 3))
    whole = mirror_points(halves, 0.2)
    assert whole.shape == (2, 5, 3, 8, 3)
    np.testing.assert_array_equal(whole[1, 2], mirror_points(halves[1, 2], 0.2))


def test_curves_are_a_value():
    points = np.zeros((2, 4, 3))
    curves = BoundaryCurves(points, 0.5)
    points[0, 0, 0] = 7.0
    assert curves.points[0, 0, 0] == 0.0, "a copy"
    with pytest.raises(ValueError, match="read-only"):
        curves.points[0, 0, 0] = 1.0
    assert curves == BoundaryCurves(np.zeros((2, 4, 3)), 0.5)
    assert curves != BoundaryCurves(np.zeros((2, 4, 3)), 0.4)
    assert curves != "curves"
    moved = curves.displaced(np.ones((2, 4, 3)))
    assert moved != curves
    assert moved.mirror_z == 0.5
    assert repr(curves) == "BoundaryCurves(2 curves x 4 points)"


@pytest.mark.parametrize("shape", [(4, 3), (1, 4, 3), (2, 3, 3), (2, 4, 2), (2, 2, 4, 3)])
def test_a_wrong_shape_is_named(shape):
    with pytest.raises(InputError, match=r"curves >= 2, points >= 4, 3.*got"):
        BoundaryCurves(np.zeros(shape))


@pytest.mark.parametrize("bad", [np.nan, np.inf, -np.inf])
def test_a_point_that_is_no_number_is_named(bad):
    points = np.zeros((4, 6, 3))
    points[2, 5, 1] = bad
    with pytest.raises(InputError, match=r"finite points, got .* in curve 2, point 5"):
        BoundaryCurves(points)
