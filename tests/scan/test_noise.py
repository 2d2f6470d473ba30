"""Noise on a mesh: how much there is, and a fit that does not follow it."""

from __future__ import annotations

import numpy as np
import pytest

from pdeface.scan import Target, fit_scan, make_scan
from pdeface.scan.noise import noise_of, quiet_width

from .conftest import scanned


def noisy(scan, sigma: float):
    """The scan, its vertices moved at random by so many metres."""
    moved = scan.vertices + np.random.default_rng(1).normal(0.0, sigma, scan.vertices.shape)
    return make_scan(moved, scan.triangles)


@pytest.fixture(scope="module")
def coarser(known):
    return scanned(known.face, 82, 75)


@pytest.mark.parametrize("sigma", [0.3e-3, 1.0e-3])
def test_the_noise_is_what_it_is(coarser, sigma: float) -> None:
    assert noise_of(noisy(coarser.scan, sigma)) == pytest.approx(sigma, rel=0.15)


def test_a_mesh_as_it_should_be_needs_no_smoothing(coarser) -> None:
    assert quiet_width(coarser.scan) == 0.0
    assert quiet_width(make_scan(coarser.scan.vertices)) == 0.0


def test_a_fit_does_not_follow_the_noise(coarser) -> None:
    words = {"landmarks": coarser.landmarks, "units": "m"}
    found = fit_scan(noisy(coarser.scan, 1.0e-3), (109, 184), **words)
    u, v = np.linspace(0.1, 0.85, 80)[:, None], np.linspace(0.9, np.pi - 0.9, 80)
    ours = (found.face.surface()(u, v).reshape(-1, 3) - found.shift) @ found.rotation
    there = Target(coarser.scan).nearest(ours)
    assert np.sqrt((there.away**2).mean()) < 0.4e-3
    facing = found.face.surface().normal(u, v).reshape(-1, 3) @ found.rotation
    angle = np.degrees(np.arccos((facing * there.normals).sum(axis=1).clip(-1.0, 1.0)))
    assert np.median(angle) < 4.5
