"""The surface against the paper's equations, taken literally and solved in mpmath."""

from __future__ import annotations

import doctest
from itertools import product

import mpmath
import numpy as np
import pytest
from mpmath import mp

from pdeface.curves import curve_parameters, mirror_points
from pdeface.errors import InputError
from pdeface.pde import PDESurface, surface
from pdeface.pde.fourier import wave_numbers

FACE = (28, 46)


def relative(difference, points):
    return np.abs(difference).max() / np.abs(points).max()


@pytest.mark.parametrize("a", [1.0, 4.0, 20.0])
@pytest.mark.parametrize("modes", range(23))
@pytest.mark.parametrize("join", ["smooth", "patchwise"])
def test_passes_through_every_curve(rng, join, modes, a):
    points = rng.normal(size=(*FACE, 3))
    made = PDESurface(points, a=a, modes=modes, join=join)
    u = np.linspace(0.0, 1.0, 28)[:, None]
    assert relative(made(u, curve_parameters(46)) - points, points) < 1e-12
    assert relative(made(u, curve_parameters(46), side="before") - points, points) < 1e-12


@pytest.mark.parametrize("count", [2, 3, 4, 5, 7, 8, 55, 109])
@pytest.mark.parametrize("samples", [3, 4, 9, 46, 47])
def test_passes_through_any_number_of_curves(rng, count, samples):
    points = rng.normal(size=(count, samples, 3))
    u = np.linspace(0.0, 1.0, count)[:, None]
    for join in ("smooth", "patchwise") if count % 3 == 1 else ("smooth",):
        made = PDESurface(points, join=join)
        assert relative(made(u, curve_parameters(samples)) - points, points) < 1e-12


def interpolated(values, v):
    """The trigonometric interpolant of the points of one curve, from its definition."""
    count = len(values)
    nodes = [(mp.mpf(j) + 0.5) * 2 * mp.pi / count for j in range(count)]

    def kernel(x):
        terms = [mp.cos(n * x) for n in range(1, (count - 1) // 2 + 1)]
        return (1 + 2 * mpmath.fsum(terms)) / count

    assert count % 2, "the test keeps clear of the highest mode of an even count"
    return mpmath.fdot((value, kernel(v - node)) for value, node in zip(values, nodes, strict=True))


def harmonic(values, n, v):
    """What one curve has in mode n, at v (equation 2)."""
    count = len(values)
    nodes = [(mp.mpf(j) + 0.5) * 2 * mp.pi / count for j in range(count)]
    factor = mp.mpf(2 if n else 1) / count
    return factor * mpmath.fdot(
        (value, mp.cos(n * (v - node))) for value, node in zip(values, nodes, strict=True)
    )


def by_the_book(solver, values, modes, a, u, v):
    """Equations (6) to (8): modes 0 to N, and a remainder of what they leave of the curves."""
    own = [[harmonic(curve, n, v) for curve in values] for n in range(modes + 1)]
    finite = [solver(a * n, column)(u) for n, column in enumerate(own)]
    left = [
        interpolated(curve, v) - mpmath.fsum(column[k] for column in own)
        for k, curve in enumerate(values)
    ]
    return mpmath.fsum(finite) + solver(a * (modes + 1), left)(u)


@pytest.mark.parametrize("join", ["smooth", "patchwise"])
@pytest.mark.parametrize(("modes", "a"), [(0, 1), (1, 4), (2, 20), (4, 1), (6, 20)])
def test_equations_6_to_8_taken_literally(oracle, rng, join, modes, a):
    points = rng.normal(size=(7, 9, 3))
    made = PDESurface(points, a=a, modes=modes, join=join)
    with mp.workdps(oracle.digits(a * (modes + 1))):
        solver = oracle.spline if join == "smooth" else oracle.patches
        values = [[mp.mpf(x) for x in curve] for curve in points[:, :, 1]]
        for u, v in [(0.03, 0.4), (0.31, 2.0), (0.5, 5.9), (0.93, 3.3)]:
            expected = float(by_the_book(solver, values, min(modes, 4), a, mp.mpf(u), mp.mpf(v)))
            assert made(u, v)[1] == pytest.approx(expected, rel=1e-12, abs=1e-12)


@pytest.mark.parametrize(("modes", "a"), [(0, 1), (2, 4), (3, 20)])
def test_blend_of_two_positions_and_two_derivatives(oracle, rng, modes, a):
    points, derivatives = rng.normal(size=(2, 2, 7, 3))
    made = PDESurface.blend(points, derivatives, a=a, modes=modes)
    v = curve_parameters(7)
    for end in (0, 1):
        np.testing.assert_allclose(made(end, v), points[end], atol=1e-12)
        np.testing.assert_allclose(made.derivative(end, v, 1), derivatives[end], atol=1e-12)
    conditions = [(0, 0), (1, 0), (0, 1), (1, 1)]
    with mp.workdps(oracle.digits(a * (modes + 1))):
        values = [[mp.mpf(x) for x in curve] for curve in np.vstack([points, derivatives])[:, :, 0]]
        for u, v in [(0.03, 0.4), (0.5, 5.9), (0.93, 3.3)]:
            expected = by_the_book(
                lambda w, four: oracle.solve(w, conditions, four), values, modes, a, mp.mpf(u), v
            )
            assert made(u, v)[0] == pytest.approx(float(expected), rel=1e-12, abs=1e-12)


@pytest.mark.parametrize("a", [1.0, 4.0])
@pytest.mark.parametrize("join", ["smooth", "patchwise"])
def test_equation_1_holds_where_every_mode_is_solved(rng, join, a):
    """S_uuuu + 2 a^2 S_uuvv + a^4 S_vvvv = 0, for N = M / 2: no mode is left to the remainder."""
    made = PDESurface(rng.normal(size=(7, 12, 3)), a=a, modes=6, join=join)
    u, v = rng.uniform(size=50), rng.uniform(0.0, 2 * np.pi, size=50)
    terms = [
        factor * made.derivative(u, v, du, dv)
        for factor, du, dv in ((1, 4, 0), (2 * a**2, 2, 2), (a**4, 0, 4))
    ]
    assert relative(sum(terms), terms) < 1e-12


def test_the_remainder_solves_its_own_equation_in_u_alone(rng):
    """Above N the exponent is a (N + 1) whatever the mode: (D^2 - w^2)^2 S = 0."""
    points = rng.normal(size=(7, 12, 3))
    made = [PDESurface(points, a=2.0, modes=n) for n in (0, 6)]
    mean = PDESurface(points.mean(axis=1, keepdims=True) + np.zeros((7, 12, 1)), modes=0)
    u, v, w = rng.uniform(size=50), rng.uniform(0.0, 2 * np.pi, size=50), 2.0

    def residual(own):
        terms = [
            factor * (own.derivative(u, v, d) - mean.derivative(u, v, d))
            for factor, d in ((1, 4), (-2 * w**2, 2), (w**4, 0))
        ]
        return relative(sum(terms), terms)

    assert residual(made[0]) < 1e-12
    assert residual(made[1]) > 1e-3


# Eighth-order central differences of the first derivative.
STEPS = np.array([-4, -3, -2, -1, 1, 2, 3, 4])
STENCIL = np.array([1 / 280, -4 / 105, 1 / 5, -4 / 5, 4 / 5, -1 / 5, 4 / 105, -1 / 280])


@pytest.mark.parametrize("join", ["smooth", "patchwise"])
@pytest.mark.parametrize("order", [o for o in product(range(4), range(4)) if 0 < sum(o) <= 3])
def test_derivative_is_the_derivative(rng, join, order):
    """Every order against differences of the order below, in u and in v."""
    made = PDESurface(rng.normal(size=(7, 12, 3)), a=2.0, modes=3, join=join)
    u = (rng.integers(6, size=40) + rng.uniform(0.3, 0.7, size=40)) / 6
    v = rng.uniform(0.0, 2 * np.pi, size=40)
    exact = made.derivative(u, v, *order)
    step = 0.01
    for axis in (0, 1):
        if order[axis] == 0:
            continue
        below = [n - (i == axis) for i, n in enumerate(order)]
        shifts = step * STEPS[:, None]
        at = (u + shifts, v + 0 * shifts) if axis == 0 else (u + 0 * shifts, v + shifts)
        difference = np.tensordot(STENCIL, made.derivative(*at, *below), axes=1) / step
        assert relative(difference - exact, exact) < 1e-7


def test_smooth_surface_has_continuous_second_derivatives_at_every_curve(rng):
    made = PDESurface(rng.normal(size=(*FACE, 3)))
    u, v = np.linspace(0.0, 1.0, 28)[1:-1, None], np.linspace(0.0, 2 * np.pi, 50)
    for order in ((0, 0), (1, 0), (0, 1), (2, 0), (1, 1), (0, 2)):
        before, after = (made.derivative(u, v, *order, side=s) for s in ("before", "after"))
        assert relative(before - after, after) < 1e-12


def test_patchwise_surface_creases_at_every_third_curve_only(rng):
    made = PDESurface(rng.normal(size=(10, 12, 3)), join="patchwise")
    v = np.linspace(0.0, 2 * np.pi, 50)
    for curve in range(1, 9):
        before, after = (made.derivative(curve / 9, v, 1, side=s) for s in ("before", "after"))
        jump = relative(before - after, after)
        assert jump > 0.1 if curve % 3 == 0 else jump < 1e-12


def test_crease_and_slit_split_the_smooth_surface(rng):
    points = rng.normal(size=(12, 10, 3))
    made = PDESurface(points, continuity={3: "crease", 7: "slit"})
    v = np.linspace(0.0, 2 * np.pi, 40)
    u = np.linspace(0.0, 1.0, 12)[:, None]
    np.testing.assert_allclose(made(u, curve_parameters(10)), points, atol=1e-12)
    before, after = (made.derivative(3 / 11, v, 1, side=s) for s in ("before", "after"))
    assert relative(before - after, after) > 0.1
    # At the curves of the slit both sides mean the surface, not the strip between them.
    for curve, inwards in ((7, -1), (8, 1)):
        near = made.derivative(curve / 11 + inwards * 1e-9, v, 1)
        for side in ("before", "after"):
            there = made.derivative(curve / 11, v, 1, side=side)
            assert relative(there - near, near) < 1e-6


def test_opening_a_slit_moves_nothing_on_the_other_side(rng):
    points = rng.normal(size=(12, 10, 3))
    opened = points.copy()
    opened[6:] += [0.0, -0.03, 0.01]
    u, v = np.linspace(0.0, 5 / 11, 60)[:, None], np.linspace(0.0, 2 * np.pi, 40)
    shut, open_ = (PDESurface(p, continuity={5: "slit"}) for p in (points, opened))
    np.testing.assert_array_equal(shut(u, v), open_(u, v))
    moved = open_(1.0 - u, v) - shut(1.0 - u, v)
    np.testing.assert_allclose(moved, np.broadcast_to([0.0, -0.03, 0.01], moved.shape), atol=1e-14)
    # Without the slit the other side feels it: the trap that slits are for.
    shut, open_ = (PDESurface(p) for p in (points, opened))
    assert np.abs(open_(u, v) - shut(u, v)).max() > 1e-3


def test_reflected_curves_give_a_reflected_surface(rng):
    half = rng.normal(size=(7, 8, 3))
    made = PDESurface(mirror_points(half, 0.3))
    u, v = rng.uniform(size=60), rng.uniform(0.0, np.pi, size=60)
    front, back = made(u, v), made(u, 2 * np.pi - v)
    np.testing.assert_allclose(front[:, :2], back[:, :2], atol=1e-13)
    np.testing.assert_allclose(front[:, 2] - 0.3, 0.3 - back[:, 2], atol=1e-13)
    np.testing.assert_allclose(made(u, 0.0)[:, 2], 0.3, atol=1e-13)


def test_every_slice_of_many_points_is_evaluated(rng):
    made = PDESurface(rng.normal(size=(5, 6, 3)))
    u, v = rng.uniform(size=10_000), rng.uniform(0.0, 7.0, size=10_000)
    some = rng.integers(10_000, size=50)
    np.testing.assert_allclose(made(u, v)[some], made(u[some], v[some]), atol=1e-14)


def test_shapes_broadcast_and_v_has_period_2_pi(rng):
    made = PDESurface(rng.normal(size=(5, 6, 3)))
    assert made(0.5, 1.0).shape == (3,)
    assert made(np.zeros((4, 1)), np.zeros(5)).shape == (4, 5, 3)
    assert made(np.zeros(0), 1.0).shape == (0, 3)
    assert made.normal(np.zeros((4, 1)), np.zeros(5)).shape == (4, 5, 3)
    assert made.curvature(np.zeros((4, 1)), np.zeros(5)).mean.shape == (4, 5)
    np.testing.assert_allclose(made(0.3, -1.0), made(0.3, 2 * np.pi - 1.0), atol=1e-13)


def test_wave_numbers_are_those_of_the_paper():
    np.testing.assert_array_equal(wave_numbers(10, 2.0, 3), [0, 2, 4, 6, 8, 8])
    np.testing.assert_array_equal(wave_numbers(10, 2.0, 9), [0, 2, 4, 6, 8, 10])


def test_docstring_example():
    assert doctest.testmod(surface).attempted > 0
    assert doctest.testmod(surface).failed == 0


RINGS = np.zeros((4, 6, 3))


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: PDESurface(RINGS, a=0.5), "a must be a number >= 1 .* got 0.5"),
        (lambda: PDESurface(RINGS, a=np.nan), "a must be a number >= 1"),
        (lambda: PDESurface(RINGS, modes=-1), "modes must be a whole number >= 0 .* got -1"),
        (lambda: PDESurface(RINGS, modes=1.5), "modes must be a whole number >= 0 .* got 1.5"),
        (lambda: PDESurface(RINGS[0]), r"points must have the shape .* got \(6, 3\)"),
        (lambda: PDESurface(RINGS[:1]), r"got \(1, 6, 3\)"),
        (lambda: PDESurface(RINGS[:, :2]), r"got \(4, 2, 3\)"),
        (lambda: PDESurface(RINGS * np.inf), "points must be finite"),
        (lambda: PDESurface(RINGS[:3], join="patchwise"), "3p [+] 1 curves"),
        (lambda: PDESurface(RINGS)(1.5, 0.0), r"u must lie in \[0, 1\], got 1.5"),
        (lambda: PDESurface(RINGS)(0.5, np.nan), "v must be finite"),
        (lambda: PDESurface(RINGS).derivative(0.5, 0.0, -1), "0 or more, got du=-1, dv=0"),
        (lambda: PDESurface(RINGS)(0.5, 0.0, side="up"), "side must be 'before' or 'after'"),
        (lambda: PDESurface.blend(RINGS, RINGS), r"two curves of position and two of derivative"),
        (lambda: PDESurface.blend(RINGS[:2], RINGS[:2, :5]), r"got \(2, 6, 3\) and \(2, 5, 3\)"),
    ],
)
@pytest.mark.filterwarnings("ignore:invalid value")
def test_bad_input_is_refused_in_one_line(make, message):
    with pytest.raises(InputError, match=message) as caught:
        make()
    assert "\n" not in str(caught.value)
