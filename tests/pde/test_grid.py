"""The evaluator of a uv mesh against the surface itself, on every path that it can take."""

from __future__ import annotations

import numpy as np
import pytest

from pdeface.curves import curve_parameters, mirror_points
from pdeface.errors import InputError
from pdeface.pde import GridEvaluator, PDESurface
from pdeface.pde.kernel import hermite
from pdeface.pde.rows import locate
from pdeface.pde.stations import choose_stations
from pdeface.uvmesh import UVMesh

# Rows that are the curves, every second curve, a few, between curves, and dense enough for
# stations (in single precision).
ROWS = [28, 10, 14, 61, 541]


@pytest.fixture
def curves(rng):
    """28 mirrored curves of 46 points with the smoothness of a face."""
    u, v = np.linspace(0.0, 1.0, 28)[:, None], curve_parameters(46)[:23]
    bumps = sum(
        rng.normal(size=3) * 0.005 * (np.cos(3 * n * u) * np.cos(n * v))[..., None]
        for n in range(1, 8)
    )
    half = np.stack([-0.08 * np.cos(v) + 0 * u, 0.2 - 0.25 * u + 0 * v, 0.1 * np.sin(v) + 0 * u])
    return mirror_points(np.moveaxis(half, 0, -1) + bumps, -0.03)


def both(points, mesh, **options):
    """Positions and normals by the surface and by the evaluator."""
    dtype = options.pop("dtype", np.float64)
    mirrored = options.pop("mirrored", False)
    made = PDESurface(points, **options)
    evaluator = GridEvaluator(
        points.shape[:2], mesh.u, mesh.v, mirrored=mirrored, dtype=dtype, **options
    )
    u = mesh.u[:, None]
    return (made(u, mesh.v), made.normal(u, mesh.v)), evaluator.positions_and_normals(points)


@pytest.mark.parametrize("rows", ROWS)
@pytest.mark.parametrize(
    "options",
    [
        {},
        {"join": "patchwise"},
        {"a": 4.0, "modes": 0},
        {"a": 20.0, "modes": 30},
        {"continuity": {9: "crease", 14: "slit"}},
        {"mirrored": True},
    ],
    ids=str,
)
def test_evaluator_is_the_surface(curves, rows, options):
    exact, ours = both(curves, UVMesh(rows, 41), **options)
    np.testing.assert_allclose(ours[0], exact[0], atol=1e-14)
    np.testing.assert_allclose(ours[1], exact[1], atol=1e-11)


@pytest.mark.parametrize("rows", ROWS)
@pytest.mark.parametrize("mirrored", [True, False])
@pytest.mark.parametrize("join", ["smooth", "patchwise"])
def test_single_precision_keeps_a_millionth(curves, rows, mirrored, join):
    options = {"join": join, "mirrored": mirrored, "dtype": np.float32}
    exact, ours = both(curves, UVMesh(rows, 61), **options)
    assert ours[0].dtype == ours[1].dtype == np.float32
    assert np.abs(ours[0] - exact[0]).max() < 1e-6 * np.abs(exact[0]).max()
    assert np.abs(ours[1] - exact[1]).max() < 2e-4
    assert np.median(np.linalg.norm(ours[1] - exact[1], axis=-1)) < 1e-5
    np.testing.assert_allclose(np.linalg.norm(ours[1], axis=-1), 1.0, atol=1e-6)


@pytest.mark.parametrize("samples", [5, 6])
@pytest.mark.parametrize("count", [2, 4, 7])
def test_small_levels(rng, count, samples):
    points = rng.normal(size=(count, samples, 3))
    exact, ours = both(points, UVMesh(11, 7, "loop"), modes=1)
    np.testing.assert_allclose(ours[0], exact[0], atol=1e-13)
    np.testing.assert_allclose(ours[1], exact[1], atol=1e-9)


def test_rows_in_any_order(curves):
    u = np.array([0.7, 0.1, 0.1, 1.0, 0.0, 1 / 27, 0.33])
    evaluator = GridEvaluator((28, 46), u, [0.5, 0.1])
    exact = PDESurface(curves)(u[:, None], [0.5, 0.1])
    np.testing.assert_allclose(evaluator.positions(curves), exact, atol=1e-14)
    one = GridEvaluator((28, 46), 0.25, 2.0)
    np.testing.assert_allclose(one.positions(curves)[0, 0], PDESurface(curves)(0.25, 2.0))


@pytest.mark.parametrize("rows", ROWS)
def test_a_batch_is_every_face_on_its_own(curves, rng, rows):
    batch = mirror_points(
        curves[:, :23] + rng.normal(scale=1e-3, size=(2, 60, 28, 23, 3)), mirror_z=-0.03
    )
    mesh = UVMesh(rows, 33)
    evaluator = GridEvaluator((28, 46), mesh.u, mesh.v, mirrored=True, dtype=np.float32)
    positions, normals = evaluator.positions_and_normals(batch)
    assert positions.shape == normals.shape == (2, 60, rows, 33, 3)
    for face in ((0, 0), (0, 7), (1, 59)):
        alone = evaluator.positions_and_normals(batch[face])
        np.testing.assert_allclose(positions[face], alone[0], atol=1e-6)
        assert np.median(np.abs(normals[face] - alone[1])) < 1e-5
    assert evaluator.positions(batch[:0]).shape == (0, 60, rows, 33, 3)


@pytest.mark.parametrize("mirrored", [True, False])
def test_displacements_are_evaluated_like_points(curves, rng, mirrored):
    """So that 52 expressions are one product with their positions, the vertex basis."""
    half = rng.normal(scale=1e-2, size=(5, 28, 23, 3))
    basis, weights = mirror_points(half), rng.uniform(size=5)
    mesh = UVMesh(28, 41)
    evaluator = GridEvaluator((28, 46), mesh.u, mesh.v, mirrored=mirrored)
    vertices = evaluator.positions(curves) + np.tensordot(
        weights, evaluator.positions(basis), axes=1
    )
    displaced = curves + np.tensordot(weights, basis, axes=1)
    np.testing.assert_allclose(vertices, evaluator.positions(displaced), atol=1e-14)


def test_mirrored_evaluation_reads_the_first_half_and_the_plane(curves):
    mesh = UVMesh(61, 21, "loop")
    evaluator = GridEvaluator((28, 46), mesh.u, mesh.v, mirrored=True)
    expected = evaluator.positions(curves)
    damaged = curves.copy()
    damaged[:, 24:] = np.nan
    np.testing.assert_array_equal(evaluator.positions(damaged), expected)
    # The back of the loop is the reflection of the front.
    back = expected[:, :0:-1] * [1.0, 1.0, -1.0] + [0.0, 0.0, -0.06]
    np.testing.assert_allclose(back, expected[:, 1:], atol=1e-14)


def test_results_are_planar_and_memory_can_be_used_again(curves):
    mesh = UVMesh(30, 20)
    evaluator = GridEvaluator((28, 46), mesh.u, mesh.v)
    out = evaluator.empty(), evaluator.empty()
    fresh = evaluator.positions_and_normals(curves)
    for result, own, first in zip(
        evaluator.positions_and_normals(curves, out=out), out, fresh, strict=True
    ):
        assert result is own
        np.testing.assert_array_equal(result, first)
        assert np.moveaxis(result, -1, 0).flags.c_contiguous
    assert evaluator.positions(2 * curves, out=out[0]) is out[0]
    np.testing.assert_allclose(out[0], 2 * fresh[0], atol=1e-15)
    np.testing.assert_array_equal(evaluator.normals(curves), fresh[1])


def test_stations_are_fewer_rows_and_lose_nothing():
    rows = locate(np.linspace(0.0, 1.0, 1081), 28)
    chosen = choose_stations(rows, 7 / 27, np.float32)
    assert chosen is not None
    assert len(chosen.rows.t) < 0.25 * 1081
    covered = [run.rows for _, runs in chosen.groups for run in runs]
    assert [part.start for part in covered] == [0, *(part.stop for part in covered[:-1])]
    assert covered[-1].stop == 1081
    for group, runs in chosen.groups:
        t = chosen.rows.t[group]
        for run in runs:
            interpolated = run.weights @ hermite(7 / 27, t[run.stations])
            exact = hermite(7 / 27, rows.t[run.rows])
            np.testing.assert_allclose(interpolated, exact, atol=3e-7)


def test_stations_are_left_alone_where_they_would_not_pay():
    dense = locate(np.linspace(0.0, 1.0, 1081), 28)
    assert choose_stations(locate(np.linspace(0.0, 1.0, 61), 28), 0.3, np.float32) is None
    assert choose_stations(dense, 0.3, np.float64) is None
    assert choose_stations(dense, 100.0, np.float32) is None


def test_degenerate_normals_are_zero_and_finite():
    mesh = UVMesh(28, 41)
    evaluator = GridEvaluator((28, 46), mesh.u, mesh.v, dtype=np.float32)
    np.testing.assert_array_equal(evaluator.normals(np.zeros((28, 46, 3))), 0.0)


EVALUATOR = {"shape": (28, 46), "u": [0.0, 1.0], "v": [0.0, 1.0]}


@pytest.mark.parametrize(
    ("use", "message"),
    [
        (lambda: GridEvaluator(**{**EVALUATOR, "u": [0.0, 1.1]}), r"u must lie in \[0, 1\]"),
        (lambda: GridEvaluator(**EVALUATOR, a=0.0), "a must be a number >= 1"),
        (lambda: GridEvaluator(**{**EVALUATOR, "shape": (27, 46)}, join="patchwise"), "3p [+] 1"),
        (
            lambda: GridEvaluator(**{**EVALUATOR, "shape": (28, 45)}, mirrored=True),
            "even number of points, got 45",
        ),
        (
            lambda: GridEvaluator(**EVALUATOR).positions(np.zeros((28, 44, 3))),
            r"serves points of shape \(..., 28, 46, 3\), got \(28, 44, 3\)",
        ),
        (
            lambda: GridEvaluator(**EVALUATOR).positions(
                np.zeros((28, 46, 3)), out=np.zeros((2, 2, 3))
            ),
            "planar memory .* use what empty",
        ),
    ],
)
def test_bad_input_is_refused(use, message):
    with pytest.raises(InputError, match=message):
        use()
