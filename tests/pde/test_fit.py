"""Fitting curves to samples of a surface."""

from __future__ import annotations

import numpy as np
import pytest

from pdeface.curves import curve_parameters
from pdeface.errors import InputError
from pdeface.pde import PDESurface
from pdeface.pde.fit import fit_curves


@pytest.mark.parametrize("options", [{}, {"a": 4.0, "modes": 2}])
def test_curves_are_recovered_from_their_own_surface(rng, options):
    """Without damping the least-squares problem has their points as its exact solution."""
    points = rng.normal(size=(7, 11, 3))
    u, v = np.linspace(0.0, 1.0, 40)[:, None], curve_parameters(24)
    samples = PDESurface(points, **options)(u, v)
    fitted = fit_curves(samples, (7, 11), fairness=0.0, damping=0.0, **options)
    np.testing.assert_allclose(fitted, points, atol=1e-10)


def test_no_other_curves_are_nearer(rng):
    """Away from the edge rows, which count more, to samples that no such surface passes."""
    samples = rng.normal(size=(30, 20, 3))
    u, v = np.linspace(0.0, 1.0, 30)[:, None], curve_parameters(20)
    weight = np.ones((30, 1, 1))
    weight[[0, -1]] = 20.0

    def distance(points):
        return np.sum(weight * (PDESurface(points)(u, v) - samples) ** 2)

    best = fit_curves(samples, (6, 9), fairness=0.0, damping=0.0)
    for _ in range(10):
        assert distance(best + rng.normal(scale=1e-3, size=best.shape)) > distance(best)


def test_fairness_flattens(rng):
    samples = rng.normal(size=(30, 20, 3))
    bending = [
        np.sum(np.diff(fit_curves(samples, (6, 9), fairness=f), 2, axis=0) ** 2)
        for f in (0.0, 0.1, 10.0)
    ]
    assert bending[0] > bending[1] > bending[2]


def test_too_few_samples_are_refused():
    with pytest.raises(InputError, match="7 x 12 data points .* got 6 x 24"):
        fit_curves(np.zeros((6, 24, 3)), (7, 12))
