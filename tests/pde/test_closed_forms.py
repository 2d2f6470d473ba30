"""Surfaces whose exact position, normal and curvature are known."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
import pytest

from pdeface.curves import curve_parameters
from pdeface.pde import PDESurface, unit_normal

JOINS = ["smooth", "patchwise"]
Function = Callable[[np.ndarray], np.ndarray]


class Revolution(NamedTuple):
    """Radius and height against u, each with two derivatives, about the y axis."""

    radius: tuple[Function, Function, Function]
    height: tuple[Function, Function, Function]

    def points(self, u, v, order=(0, 0)):
        """Position or a derivative at (u, v), which broadcast."""
        turn = v + order[1] * np.pi / 2
        r = self.radius[order[0]](u)
        h = self.height[order[0]](u) * (order[1] == 0)
        return np.stack(np.broadcast_arrays(r * np.cos(turn), h, r * np.sin(turn)), axis=-1)

    def curves(self, count, samples=12):
        return self.points(np.linspace(0.0, 1.0, count)[:, None], curve_parameters(samples))


def constant(value):
    return lambda u: np.full_like(u, value)


def linear(factor):
    return (lambda u: factor * u, constant(factor), constant(0.0))


CATENOID = Revolution((np.cosh, np.sinh, np.cosh), linear(1.0))
SPINDLE = Revolution((np.sinh, np.cosh, np.sinh), linear(1.0))
CYLINDER = Revolution((constant(0.7), constant(0.0), constant(0.0)), linear(2.0))
CONE = Revolution(linear(0.5), linear(2.0))
TORUS = Revolution(
    (
        lambda u: 2.0 + np.cos(2.0 * u),
        lambda u: -2.0 * np.sin(2.0 * u),
        lambda u: -4.0 * np.cos(2.0 * u),
    ),
    (
        lambda u: np.sin(2.0 * u),
        lambda u: 2.0 * np.cos(2.0 * u),
        lambda u: -4.0 * np.sin(2.0 * u),
    ),
)
DISC = Revolution((np.exp, np.exp, np.exp), linear(0.0))
U = np.linspace(0.0, 1.0, 61)[:, None]
FINE = np.linspace(0.0, 1.0, 397)[:, None]
V = np.linspace(0.0, 2 * np.pi, 13)


@pytest.mark.parametrize("shape", [CATENOID, SPINDLE], ids=["catenoid", "spindle with a tip"])
@pytest.mark.parametrize("join", JOINS)
@pytest.mark.parametrize("count", [4, 10, 28])
def test_solutions_of_the_equation_are_reproduced_exactly(count, join, shape):
    """cosh u cos v and sinh u cos v solve equation (1) with a = 1, and u does."""
    made = PDESurface(shape.curves(count), join=join)
    for order in ((0, 0), (1, 0), (0, 1), (2, 0), (1, 1), (0, 2)):
        exact = shape.points(U, V, order)
        np.testing.assert_allclose(made.derivative(U, V, *order), exact, atol=1e-10)


@pytest.mark.parametrize("join", JOINS)
def test_catenoid_is_a_minimal_surface(join):
    curvature = PDESurface(CATENOID.curves(7), join=join).curvature(U, V)
    np.testing.assert_allclose(curvature.mean, 0.0, atol=1e-11)
    exact = np.broadcast_to(-1.0 / np.cosh(U) ** 4, curvature.gaussian.shape)
    np.testing.assert_allclose(curvature.gaussian, exact, atol=1e-10)


@pytest.mark.parametrize("join", JOINS)
def test_tip_of_the_spindle_is_degenerate_and_finite(join):
    made = PDESurface(SPINDLE.curves(7), join=join)
    np.testing.assert_allclose(made(0.0, V), 0.0, atol=1e-15)
    assert np.isfinite(made.normal(0.0, V)).all()


@pytest.mark.parametrize("join", JOINS)
def test_plane_stays_a_plane(rng, join):
    """Whatever the curves in it, to rounding: no coordinate leaves the span of the data."""
    flat = rng.normal(size=(7, 12, 2))
    across, along, normal = np.linalg.qr(rng.normal(size=(3, 3)))[0]
    points = flat @ np.stack([across, along]) + 0.4 * normal
    made = PDESurface(points, join=join)
    np.testing.assert_allclose(made(U, V) @ normal, 0.4, atol=1e-13)
    np.testing.assert_allclose(np.abs(made.normal(U, V) @ normal), 1.0, atol=1e-12)
    curvature = PDESurface(DISC.curves(7), join=join).curvature(U, V)
    np.testing.assert_allclose(curvature.gaussian, 0.0, atol=1e-12)
    np.testing.assert_allclose(curvature.mean, 0.0, atol=1e-12)


def errors(shape, join, part):
    """Largest error of position and of u-derivative for doubling numbers of intervals."""
    result = []
    for count in (7, 13, 25, 49):
        made = PDESurface(shape.curves(count), join=join)
        result.append(
            [
                np.abs(made.derivative(part, V, *order) - shape.points(part, V, order)).max()
                for order in ((0, 0), (1, 0))
            ]
        )
    return np.array(result)


@pytest.mark.parametrize(
    "shape", [CYLINDER, CONE, TORUS], ids=["cylinder", "cone", "torus section"]
)
@pytest.mark.parametrize(
    ("join", "part", "order"),
    [
        # Four curves a patch: a cubic's order everywhere.
        ("patchwise", FINE, 4.0),
        # y'' = w^2 y at the ends is not theirs: second order there, dying out within a few
        # curves; fourth or better elsewhere.
        ("smooth", FINE, 2.0),
        ("smooth", 0.25 + 0.5 * FINE, 4.0),
    ],
    ids=["patchwise", "smooth, to the ends", "smooth, inside"],
)
def test_known_shapes_are_approached_at_the_stated_order(shape, join, part, order):
    measured = errors(shape, join, part)
    position, slope = np.log2(measured[:-1] / measured[1:]).mean(axis=0)
    assert position > order - 0.15
    assert slope > order - 1.15
    if join == "patchwise" or part is FINE:  # and no better: the statement is sharp
        assert position < order + 0.15


@pytest.mark.parametrize("join", JOINS)
@pytest.mark.parametrize(
    ("shape", "gaussian", "mean"),
    [
        (CYLINDER, lambda u: 0.0 * u, lambda u: 0.0 * u + 1 / 1.4),
        (CONE, lambda u: 0.0 * u, lambda u: 0.5 / (0.5 * u * np.sqrt(1 + 0.25**2))),
        (
            TORUS,
            lambda u: np.cos(2 * u) / (2 + np.cos(2 * u)),
            lambda u: 0.5 * (1 + np.cos(2 * u) / (2 + np.cos(2 * u))),
        ),
    ],
    ids=["cylinder", "cone", "torus section"],
)
def test_normals_and_curvatures_of_known_shapes(join, shape, gaussian, mean):
    """Inside, at the 28 curves of a face; the mean curvature is positive where it bulges."""
    u = np.linspace(0.3, 0.7, 41)[:, None]
    made = PDESurface(shape.curves(28), join=join)
    outward = unit_normal(shape.points(u, V, (1, 0)), shape.points(u, V, (0, 1)))
    radial = np.stack([np.cos(V), 0.0 * V, np.sin(V)], axis=-1)
    sign = np.sign((outward * radial).sum(axis=-1, keepdims=True))
    assert np.abs(made.normal(u, V) - outward).max() < 1e-4
    curvature = made.curvature(u, V)
    # Two orders below the position; the smooth join's second derivative has no jumps besides.
    tolerance = 0.02 if join == "patchwise" else 2e-3
    assert np.abs(curvature.gaussian - gaussian(u)).max() < tolerance
    assert np.abs(curvature.mean * sign[..., 0] - mean(u)).max() < tolerance


def test_mean_curvature_is_positive_on_a_ball_seen_from_outside():
    """Rows run downwards and columns from the subject's right to left, as on a face."""
    u, v = np.linspace(0.5, np.pi - 0.5, 25)[:, None], curve_parameters(12)
    rings = np.stack(
        np.broadcast_arrays(-np.sin(u) * np.cos(v), np.cos(u), np.sin(u) * np.sin(v)), axis=-1
    )
    made = PDESurface(0.1 * rings)
    centre = np.linspace(0.3, 0.7, 9)[:, None]
    position, normal = made(centre, V), made.normal(centre, V)
    np.testing.assert_allclose(normal, position / 0.1, atol=1e-3)
    np.testing.assert_allclose(made.curvature(centre, V).mean, 10.0, rtol=1e-3)
    np.testing.assert_allclose(made.curvature(centre, V).gaussian, 100.0, rtol=1e-3)
