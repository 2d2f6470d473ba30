"""Normals and curvatures from derivatives."""

from __future__ import annotations

import numpy as np
import pytest

from pdeface.pde import curvature, unit_normal
from pdeface.pde.differential import write_unit_normals


def test_normal_is_right_handed_and_of_unit_length():
    np.testing.assert_allclose(unit_normal([3.0, 0.0, 0.0], [0.0, 2.0, 0.0]), [0.0, 0.0, 1.0])
    np.testing.assert_allclose(unit_normal([0.0, 2.0, 0.0], [3.0, 0.0, 0.0]), [0.0, 0.0, -1.0])


def test_degenerate_normal_is_zero():
    np.testing.assert_array_equal(unit_normal(np.zeros(3), np.ones(3)), 0.0)


def test_planar_normals_are_the_normals(rng):
    s_u, s_v = rng.normal(size=(2, 3, 4, 5))
    s_v[:, 0, 0] = 2.0 * s_u[:, 0, 0]
    s_u[:, 1, 1] = 0.0
    out = np.empty((3, 4, 5))
    write_unit_normals(s_u, s_v, out, np.empty((2, 4, 5)))
    expected = unit_normal(np.moveaxis(s_u, 0, -1), np.moveaxis(s_v, 0, -1))
    np.testing.assert_allclose(np.moveaxis(out, 0, -1), expected, atol=1e-14)
    np.testing.assert_array_equal(out[:, 1, 1], 0.0)


@pytest.mark.parametrize("shear", [0.0, 0.7])
def test_curvature_does_not_depend_on_the_parameters(shear):
    """A saddle z = (p x^2 + q y^2) / 2 at its origin, through sheared and scaled parameters."""
    p, q = 3.0, -1.0
    frame = np.array([[2.0, 0.0], [shear, 0.5]])  # rows: dx, dy along u and along v
    s_u, s_v = np.column_stack([frame, [0.0, 0.0]])
    second = frame @ np.diag([p, q]) @ frame.T
    s_uu, s_uv, s_vv = (np.array([0.1, -0.4, second[i]]) for i in ((0, 0), (0, 1), (1, 1)))
    found = curvature(s_u, s_v, s_uu, s_uv, s_vv)
    assert found.gaussian == pytest.approx(p * q)
    # Hollow towards the normal: the mean is positive where the surface bulges along it.
    assert found.mean == pytest.approx(-(p + q) / 2)


def test_curvature_of_a_degenerate_place_is_not_a_number_and_not_a_warning(recwarn):
    zero = np.zeros(3)
    found = curvature(zero, zero, zero, zero, zero)
    assert np.isnan(found.gaussian)
    assert not recwarn.list
