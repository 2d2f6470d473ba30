"""A weighted sum of surfaces is the surface of the weighted sum."""

from __future__ import annotations

import numpy as np
import pytest

from pdeface.errors import InputError
from pdeface.pde import GridEvaluator, ShapeBasis
from pdeface.pde.shape_basis import SMALL

MESHES = ((9, 13), (70, 33), (200, 7), (600, 9))


def evaluator(mesh: tuple[int, int], **options: object) -> GridEvaluator:
    u, v = np.linspace(0.0, 1.0, mesh[0]), np.linspace(0.0, np.pi, mesh[1])
    return GridEvaluator((7, 12), u, v, **options)


def test_both_ways_are_tried() -> None:
    assert {rows * columns <= SMALL for rows, columns in MESHES} == {True, False}


@pytest.mark.parametrize("mesh", MESHES)
@pytest.mark.parametrize("parting", [None, {3: "slit"}])
def test_sums_are_those_of_the_points(mesh: tuple[int, int], parting: object) -> None:
    rng = np.random.default_rng(1)
    grid = evaluator(mesh, parting=parting)
    points = rng.normal(size=(5, *grid.shape, 3))
    weights = rng.normal(size=(17, 5))
    found = ShapeBasis(grid, points).positions(weights)
    expected = grid.positions(np.tensordot(weights, points, 1))
    np.testing.assert_allclose(found, expected, rtol=0, atol=1e-12)


def test_results_are_planar_memory_that_can_be_written_over() -> None:
    grid = evaluator((70, 33))
    basis = ShapeBasis(grid, np.random.default_rng(2).normal(size=(3, 7, 12, 3)))
    out = basis.empty(2)
    assert basis.positions(np.ones((2, 3)), out=out) is out
    assert np.moveaxis(out, -1, 0).flags.c_contiguous
    with pytest.raises(InputError, match="planar memory"):
        basis.positions(np.ones((3, 3)), out=out)


def test_points_and_weights_of_other_shapes_are_refused() -> None:
    grid = evaluator((9, 13))
    with pytest.raises(InputError, match=r"\(B, 7, 12, 3\)"):
        ShapeBasis(grid, np.zeros((7, 12, 3)))
    with pytest.raises(InputError, match="3 weights a frame"):
        ShapeBasis(grid, np.zeros((3, 7, 12, 3))).positions(np.zeros((2, 4)))
