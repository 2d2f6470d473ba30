"""The splines of the mesh lines: straight where they can be, and never beyond their nodes."""

from __future__ import annotations

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from pdeface.texture import _spline

STEPS = st.lists(st.floats(1e-3, 1e3), min_size=1, max_size=12)


@given(STEPS, st.data())
def test_through_increasing_values_the_curve_increases(steps, data):
    rises = data.draw(st.lists(st.floats(1e-3, 1e3), min_size=len(steps), max_size=len(steps)))
    knots, values = (np.concatenate([[0.0], np.cumsum(s)]) for s in (steps, rises))
    at = np.linspace(-0.1 * knots[-1], 1.1 * knots[-1], 500)
    curve = _spline.evaluate(knots, _spline.coefficients(knots, values), at)
    assert (np.diff(curve) >= -1e-9 * values[-1]).all()
    np.testing.assert_allclose(
        _spline.evaluate(knots, _spline.coefficients(knots, values), knots), values, rtol=1e-9
    )


@given(STEPS, st.data())
def test_the_curve_stays_between_neighbouring_values(steps, data):
    count = len(steps) + 1
    values = np.array(data.draw(st.lists(st.floats(-50, 50), min_size=count, max_size=count)))
    knots = np.concatenate([[0.0], np.cumsum(steps)])
    polynomials = _spline.coefficients(knots, values)
    for k in range(len(steps)):
        at = np.linspace(knots[k], knots[k + 1], 30)
        curve = _spline.evaluate(knots, polynomials, at)
        low, high = sorted(values[k : k + 2])
        assert low - 1e-6 <= curve.min()
        assert curve.max() <= high + 1e-6


@given(STEPS, st.floats(-5, 5), st.floats(-5, 5))
def test_a_straight_line_is_reproduced_and_continued(steps, slope, offset):
    knots = np.concatenate([[0.0], np.cumsum(steps)])
    at = np.linspace(-knots[-1], 2 * knots[-1], 77)
    curve = _spline.evaluate(knots, _spline.coefficients(knots, slope * knots + offset), at)
    np.testing.assert_allclose(curve, slope * at + offset, rtol=1e-9, atol=1e-9 * knots[-1])


def test_many_curves_at_once_are_each_their_own():
    rng = np.random.default_rng(3)
    knots = np.cumsum(rng.uniform(0.1, 2, (4, 6)), axis=1)
    values = rng.normal(size=(2, 4, 6))
    at = np.linspace(-1, 12, 60)
    together = _spline.evaluate(knots, _spline.coefficients(knots, values), at)
    assert together.shape == (2, 4, 60)
    for i, k in np.ndindex(2, 4):
        alone = _spline.evaluate(knots[k], _spline.coefficients(knots[k], values[i, k]), at)
        np.testing.assert_allclose(together[i, k], alone)


def test_the_curve_has_no_corner_at_a_knot():
    knots, values = np.array([0.0, 1.0, 2.5, 3.0, 6.0]), np.array([0.0, 2.0, 3.0, 7.0, 8.0])
    polynomials = _spline.coefficients(knots, values)
    for knot in knots:
        before, at, behind = _spline.evaluate(knots, polynomials, knot + np.array([-1e-6, 0, 1e-6]))
        assert abs((behind - at) - (at - before)) < 1e-9
