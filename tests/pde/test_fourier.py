"""Fourier modes: exact on the data points, and what a mirrored curve has of them."""

from __future__ import annotations

import numpy as np
import pytest

from pdeface.curves import curve_parameters, mirror_points
from pdeface.pde.fourier import analysis, synthesis
from pdeface.pde.waves import closed_waves, mirrored_waves

COUNTS = [3, 4, 5, 46, 47, 92, 184]


@pytest.mark.parametrize("count", COUNTS)
def test_a_closed_curve_is_the_sum_of_its_modes(count):
    weights = np.einsum("cvn,cnm->vm", synthesis(count, curve_parameters(count)), analysis(count))
    np.testing.assert_allclose(weights, np.eye(count), atol=1e-13)


@pytest.mark.parametrize("count", COUNTS)
def test_modes_are_the_fourier_coefficients(rng, count):
    """Of a trigonometric polynomial whose coefficients are known."""
    highest = (count - 1) // 2
    cosine, sine = rng.normal(size=(2, highest + 1))
    sine[0] = 0.0
    angle = np.outer(curve_parameters(count), np.arange(highest + 1))
    found = analysis(count) @ (np.cos(angle) @ cosine + np.sin(angle) @ sine)
    np.testing.assert_allclose(found[0, : highest + 1], cosine, atol=1e-13)
    np.testing.assert_allclose(found[1, : highest + 1], sine, atol=1e-13)


@pytest.mark.parametrize("derivative", [0, 1, 2, 3])
def test_derivatives_of_the_waves(derivative):
    v, n = np.linspace(-3.0, 9.0, 17), np.arange(5)
    cosine, sine = synthesis(8, v, derivative)
    wave = n**derivative * np.exp(1j * (np.outer(v, n) + derivative * np.pi / 2))
    np.testing.assert_allclose(cosine, wave.real, atol=1e-12)
    np.testing.assert_allclose(sine, wave.imag, atol=1e-12)


@pytest.mark.parametrize("count", [4, 6, 46, 92])
@pytest.mark.parametrize("derivative", [0, 1])
def test_half_the_waves_make_a_mirrored_curve(rng, count, derivative):
    points = mirror_points(rng.normal(size=(3, count // 2, 3)), 0.4)
    v = np.linspace(0.0, 7.0, 20)
    results = []
    for waves in (closed_waves(count), mirrored_waves(count)):
        coefficients = waves.analysis @ waves.samples(points, np.float64).swapaxes(1, 2)
        assert coefficients.shape[1] == waves.per_harmonic * (count // 2 + 1)
        results.append(coefficients.swapaxes(1, 2) @ waves.synthesis(v, derivative))
    np.testing.assert_allclose(*results, atol=1e-11)
