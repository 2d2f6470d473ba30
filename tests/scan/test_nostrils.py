"""Nostrils of a scan that are shallower than the neutral face's."""

from __future__ import annotations

import numpy as np
import pytest

from pdeface.pde import GridEvaluator
from pdeface.scan import Target, fit_scan, make_scan
from pdeface.scan.nostrils import _closings, fitted_nostrils
from pdeface.uvmesh import UVMesh

GRID = 217, 184


def shallower(face, share):
    """The face's grid with its nostrils closed by a share."""
    u, v = np.linspace(0.0, 1.0, GRID[0]), (np.arange(GRID[1]) + 0.5) * (np.pi / GRID[1])
    points = GridEvaluator(face.curves.shape, u, v).positions(face.curves.points)
    return points + share * sum(closing for _, closing in _closings(*GRID))


def scan_of(grid):
    triangles = UVMesh(*GRID).triangles
    return make_scan(grid.reshape(-1, 3), triangles)


def off(grid, scan):
    """Root mean square distance of both nostrils from a scan, metres."""
    inside = np.any([inside for inside, _ in _closings(*GRID)], axis=0)
    return float(np.sqrt((Target(scan).nearest(grid[inside]).away ** 2).mean()))


@pytest.mark.parametrize("share", [0.0, 0.5, 1.0])
def test_the_depth_is_that_of_the_scan(known, share) -> None:
    wanted = shallower(known.face, share)
    found = fitted_nostrils(shallower(known.face, 0.0), Target(scan_of(wanted), 4.0e-3))
    assert np.linalg.norm(found - wanted, axis=2).max() < 0.9e-3


def test_nothing_else_moves(known) -> None:
    deep = shallower(known.face, 0.0)
    found = fitted_nostrils(deep, Target(scan_of(shallower(known.face, 1.0)), 4.0e-3))
    moved = np.linalg.norm(found - deep, axis=2) > 0.0
    assert 0.001 < moved.mean() < 0.01


def test_a_fit_follows_shallow_nostrils(known) -> None:
    scan = scan_of(shallower(known.face, 0.8))
    found = fit_scan(scan, (109, 184), landmarks=known.landmarks, units="m")
    fitted = shallower(found.face, 0.0)
    assert off(fitted, found.scan) < 0.3e-3
