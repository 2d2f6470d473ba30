"""Joins: against mpmath, by what makes them joins, and by the errors they raise."""

from __future__ import annotations

import numpy as np
import pytest
from mpmath import mp
from scipy.interpolate import CubicSpline

from pdeface.errors import InputError
from pdeface.pde.joins import check_join, slopes
from pdeface.pde.kernel import hermite
from pdeface.pde.rows import locate, u_weights

WAVE_NUMBERS = [0, 1e-6, 1e-3, 0.11, 1, 4.0, 7, 22, 51, 150, 300, 700]
SMOOTH_CASES = {
    "C2": {},
    "crease": {2: "crease"},
    "slit": {3: "slit"},
    "both": {1: "slit", 4: "crease"},
}


def against_mpmath(oracle, exact, w, count, **options):
    """Largest error of positions and three derivatives, of the largest value of each."""
    u = np.array([0.0, 0.04, 0.1999, 0.2001, 0.41, 0.5, 0.63, 0.77, 0.95, 0.9999])
    errors = []
    values = np.cos(np.arange(count) ** 2)
    with mp.workdps(oracle.digits(w)):
        solution = exact(mp.mpf(w), [mp.mpf(float(x)) for x in values])
        for d in range(4):
            expected = np.array([float(solution(mp.mpf(float(x)), d)) for x in u])
            ours = u_weights(u, float(w), count, derivative=d, **options) @ values
            errors.append(np.abs(ours - expected).max() / np.abs(expected).max())
    return max(errors)


@pytest.mark.parametrize("w", WAVE_NUMBERS)
@pytest.mark.parametrize("continuity", SMOOTH_CASES.values(), ids=SMOOTH_CASES)
def test_smooth_join_against_mpmath(oracle, w, continuity):
    error = against_mpmath(
        oracle,
        lambda w, values: oracle.spline(w, values, continuity),
        w,
        count=6,
        continuity=continuity,
    )
    assert error < 1e-12


@pytest.mark.parametrize("w", WAVE_NUMBERS)
def test_patchwise_join_against_mpmath(oracle, w):
    assert against_mpmath(oracle, oracle.patches, w, count=7, join="patchwise") < 1e-12


def test_smooth_join_of_mode_zero_is_the_natural_cubic_spline():
    values = np.array([0.3, -1.0, 2.0, 0.7, 0.1, -0.4])
    u = np.linspace(0.0, 1.0, 51)
    spline = CubicSpline(np.linspace(0.0, 1.0, 6), values, bc_type="natural")
    for d in range(3):
        ours = u_weights(u, 0.0, 6, derivative=d) @ values
        np.testing.assert_allclose(ours, spline(u, d), atol=1e-12 * np.abs(spline(u, d)).max())


@pytest.mark.parametrize("w", [0.0, 1e-3, 1.0, 13.0, 100.0])
def test_smooth_join_is_c2_and_its_ends_are_free(w):
    count = 9
    knots = np.linspace(0.0, 1.0, count)
    weights = {
        (side, d): u_weights(knots, w, count, side=side, derivative=d)
        for side in ("before", "after")
        for d in (1, 2)
    }
    for d in (1, 2):
        before, after = weights["before", d], weights["after", d]
        np.testing.assert_allclose(before, after, atol=1e-12 * np.abs(after).max())
    free = weights["after", 2] - w**2 * u_weights(knots, w, count)
    scale = np.abs(weights["after", 2]).max()
    np.testing.assert_allclose(free[[0, -1]], 0.0, atol=1e-12 * scale)
    if w < 100.0:  # an inner curve is no such end
        assert np.abs(free[1:-1]).max() > 1e-3 * scale


def test_smooth_join_has_no_more_continuity_than_promised():
    knots = np.array([0.25, 0.5, 0.75])
    third = [u_weights(knots, 3.0, 5, side=side, derivative=3) for side in ("before", "after")]
    assert np.abs(third[0] - third[1]).max() > 1.0


@pytest.mark.parametrize("w", [0.0, 0.5, 6.0, 40.0])
def test_smooth_join_minimises_its_energy(rng, w):
    """Against admissible functions: the same values at the curves, continuous first derivative,
    any slopes, and any bubble between two curves."""
    intervals = 6
    omega = w / intervals
    node, weight = np.polynomial.legendre.leggauss(30)
    t, weight = 0.5 + 0.5 * node, 0.5 * weight

    def operator(ends):
        """y'' - omega^2 y at the nodes of every interval: (intervals, nodes)."""
        return ends @ (hermite(omega, t, 2) - omega**2 * hermite(omega, t)).T

    values = rng.normal(size=intervals + 1)
    of_slopes = slopes(w, intervals + 1) @ values
    spline = operator(np.stack([values[:-1], values[1:], of_slopes[:, 0], of_slopes[:, 1]], -1))
    energy = np.sum(weight * spline**2)
    for _ in range(20):
        slope, height = rng.normal(size=intervals + 1), rng.normal(size=(intervals, 1))
        nothing = np.zeros(intervals)
        change = operator(np.stack([nothing, nothing, slope[:-1], slope[1:]], -1))
        # t^2 (1 - t)^2, which vanishes with its slope at both curves.
        bubble = 2.0 - 12.0 * t + 12.0 * t**2 - omega**2 * (t * (1.0 - t)) ** 2
        change = change + height * bubble
        cross = np.sum(weight * spline * change)
        extra = np.sum(weight * change**2)
        assert abs(cross) < 1e-11 * np.sqrt(energy * extra)
        assert np.sum(weight * (spline + 0.1 * change) ** 2) > energy


def test_crease_breaks_the_tangent_and_nothing_else(rng):
    values = rng.normal(size=8)
    sides = {
        (side, d): u_weights(3 / 7, 4.0, 8, continuity={3: "crease"}, side=side, derivative=d)
        @ values
        for side in ("before", "after")
        for d in (0, 1)
    }
    assert sides["before", 0] == sides["after", 0] == values[3]
    assert abs(sides["before", 1] - sides["after", 1]) > 0.1


def test_slit_sides_do_not_feel_each_other():
    u = np.linspace(0.0, 1.0, 141)
    weights = u_weights(u, 5.0, 8, continuity={3: "slit"})
    above, below = u <= 3 / 7, u >= 4 / 7
    assert not weights[above][:, 4:].any()
    assert not weights[below][:, :4].any()
    strip = weights[~above & ~below]
    assert strip[:, 3:5].all()
    assert not strip[:, [0, 1, 2, 5, 6, 7]].any()


def test_a_c2_spline_would_throw_the_lips_out_of_place():
    """Design note: a jump between two curves overshoots by 11 per cent in the next interval."""
    u = np.linspace(0.0, 1.0, 701)
    jump = np.repeat([0.0, 1.0], 4)
    c2 = u_weights(u, 0.0, 8) @ jump
    assert 0.08 < c2.max() - 1.0 < 0.14
    parted = u_weights(u, 0.0, 8, continuity={3: "slit"}) @ jump
    assert parted.max() <= 1.0 + 1e-15
    assert parted.min() >= -1e-15


def test_a_slit_curve_belongs_to_the_surface_not_to_the_strip():
    for side in ("before", "after"):
        rows = locate(np.arange(8) / 7, 8, side, {3: "slit"})
        assert rows.interval[3] == 2
        assert rows.interval[4] == 4


def test_curves_are_met_whatever_the_rounding_of_u():
    for count in (4, 10, 28, 55, 109):
        for side in ("before", "after"):
            rows = locate(np.linspace(0.0, 1.0, count), count, side)
            assert np.isin(rows.t, (0.0, 1.0)).all()
            np.testing.assert_array_equal(rows.interval + rows.t, np.arange(count))


def test_two_and_three_curves_are_enough_for_the_smooth_join():
    assert slopes(3.0, 2).shape == (1, 2, 2)
    values = np.array([1.0, 2.0, 0.5])
    middle = u_weights([0.5], 3.0, 3) @ values
    assert middle == pytest.approx(2.0, abs=1e-15)


@pytest.mark.parametrize(
    ("join", "count", "continuity", "message"),
    [
        ("round", 7, {}, "join must be 'smooth' or 'patchwise', got 'round'"),
        ("patchwise", 8, {}, "3p [+] 1 curves .* got 8; use join='smooth'"),
        ("patchwise", 1, {}, "got 1"),
        ("patchwise", 7, {3: "crease"}, "smooth join only"),
        ("smooth", 7, {3: "C1"}, "'C2', 'crease' or 'slit', got 'C1' at curve 3"),
        ("smooth", 7, {0: "crease"}, "inner curves, 1 to 5 of 7, got curve 0"),
        ("smooth", 7, {6: "slit"}, "got curve 6"),
        ("smooth", 7, {"lip": "slit"}, "got curve 'lip'"),
    ],
)
def test_joins_that_cannot_be_are_refused(join, count, continuity, message):
    with pytest.raises(InputError, match=message):
        check_join(count, join, continuity)


def test_a_patch_beyond_floating_point_is_refused():
    assert np.isfinite(slopes(700.0, 4, "patchwise")).all()
    with pytest.raises(InputError, match=r"at most 700, got 701 .*lower a or modes"):
        slopes(701.0, 4, "patchwise")


@pytest.mark.parametrize("u", [-1e-3, 1.001, np.nan])
def test_u_outside_the_mesh_is_refused(u):
    with pytest.raises(InputError, match=r"u must lie in \[0, 1\]"):
        locate([0.5, u], 7)


def test_an_unknown_side_is_refused():
    with pytest.raises(InputError, match="side must be 'before' or 'after', got 'left'"):
        locate([0.5], 7, "left")
