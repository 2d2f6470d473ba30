"""The kernel against the same problems in mpmath, in the paper's basis, with 50 spare digits."""

from __future__ import annotations

import numpy as np
import pytest
from mpmath import mp

from pdeface.pde.kernel import basis, cardinals, hermite

WAVE_NUMBERS = [0, 1e-6, 1e-3, 0.11, 0.5, 1, 1 + 1e-9, 1.5, 3, 7, 22, 51, 100, 300, 700]
POSITIONS = [0.0, 1e-3, 0.013, 0.21, 0.5, 0.77, 0.999, 1.0]
FORMS = {
    "four position curves": [(0, 0), ((1, 3), 0), ((2, 3), 0), (1, 0)],
    "two position, two derivative": [(0, 0), (1, 0), (0, 1), (1, 1)],
}
# Of the largest value that the same weight, or derivative of it, has on the interval.
RELATIVE = 1e-13


def as_mp(at):
    return mp.mpf(at[0]) / at[1] if isinstance(at, tuple) else mp.mpf(at)


def as_float(at):
    return at[0] / at[1] if isinstance(at, tuple) else float(at)


@pytest.mark.parametrize("form", FORMS)
@pytest.mark.parametrize("w", WAVE_NUMBERS)
def test_kernel_against_mpmath(oracle, w, form):
    conditions = FORMS[form]
    t = np.array(POSITIONS)
    with mp.workdps(oracle.digits(w)):
        exact_conditions = [(as_mp(at), order) for at, order in conditions]
        solutions = [
            oracle.solve(mp.mpf(w), exact_conditions, [mp.mpf(i == j) for j in range(4)])
            for i in range(4)
        ]
        expected = [
            np.array([[float(y(mp.mpf(x), d)) for y in solutions] for x in POSITIONS])
            for d in range(4)
        ]
    for d, exact in enumerate(expected):
        ours = cardinals(w, [(as_float(at), order) for at, order in conditions], t, d)
        scale = np.abs(exact).max(axis=0)
        np.testing.assert_array_less(np.abs(ours - exact) / scale, RELATIVE)


@pytest.mark.parametrize("w", [1e-6, 0.11, 1.0, 1.5, 20.0, 700.0])
def test_basis_solves_the_equation(w):
    """(D^2 - w^2)^2 = D^4 - 2 w^2 D^2 + w^4."""
    t = np.linspace(0.0, 1.0, 9)
    fourth, second, value = (basis(w, t, d) for d in (4, 2, 0))
    terms = np.abs(fourth) + 2 * w**2 * np.abs(second) + w**4 * np.abs(value)
    residual = fourth - 2 * w**2 * second + w**4 * value
    assert np.all(np.abs(residual) <= 1e-14 * terms)


def test_the_papers_printed_remainder_could_not_meet_four_curves():
    """Equation (7) as printed has two functions, each twice: rank 2. Bloor and Wilson's is 4."""
    t = np.arange(4) / 3.0
    w = 7.0
    printed = np.stack([np.exp(w * t), np.exp(-w * t), np.exp(w * t), np.exp(-w * t)], -1)
    meant = np.stack([np.exp(w * t), t * np.exp(w * t), np.exp(-w * t), t * np.exp(-w * t)], -1)
    assert np.linalg.matrix_rank(printed) == 2
    assert np.linalg.matrix_rank(meant) == 4


def test_conditions_are_met_to_the_last_bit():
    for w in WAVE_NUMBERS:
        ends = hermite(w, np.array([0.0, 1.0]))
        np.testing.assert_array_equal(ends, np.eye(4)[:2])
        slopes = hermite(w, np.array([0.0, 1.0]), 1)
        np.testing.assert_array_equal(slopes, np.eye(4)[2:])


def test_weights_are_finite_and_bounded_far_beyond_the_face():
    t = np.linspace(0.0, 1.0, 101)
    for w in np.geomspace(1e-8, 700.0, 60):
        weights = hermite(w, t)
        assert np.all(np.isfinite(weights))
        assert np.abs(weights).max() <= 1.0 + 1e-12


def test_an_exponent_of_an_n_t_ripples_and_a_ninth_of_it_does_not():
    """Why one uv mesh for the whole face matters (section 2.2): overshoot of a patch."""
    t = np.linspace(0.0, 1.0, 301)
    patch = [(0.0, 0), (1 / 3, 0), (2 / 3, 0), (1.0, 0)]
    overshoot = {w: np.abs(cardinals(w, patch, t)).max() for w in (7 / 9, 22 / 9, 7.0, 22.0)}
    assert overshoot[7 / 9] < 1.07
    assert overshoot[22 / 9] < 1.2
    assert overshoot[7.0] > 1.5
    assert overshoot[22.0] > 50.0
