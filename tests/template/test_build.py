"""The command that measures the template, run on the head it was measured on."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from pdeface import template
from pdeface.curves import mirror_points
from pdeface.template import LEVELS

pytest.importorskip("igl", reason="needs the extra 'template'")
pytest.importorskip("scipy", reason="needs the extra 'template'")

# What the surface shall reach over the front of the face: RMS and median of the distance to the
# scan in mm, median angle of the normals in degrees.
REACH = {"28x46": (0.28, 0.09, 2.8), "55x92": (0.15, 0.09, 1.8), "109x184": (0.08, 0.09, 1.2)}


@pytest.fixture(scope="module")
def scan(shared_data: Path):  # type: ignore[no-untyped-def]
    from pdeface.template.build.closing import close_head
    from pdeface.template.build.cutting import cut_face
    from pdeface.template.build.head import load_head

    head = load_head(shared_data / "data" / "ict_facekit")
    return head, cut_face(close_head(head).mesh)


def test_the_command_rebuilds_what_ships(shared_data: Path, tmp_path: Path) -> None:
    target = tmp_path / "neutral.npz"
    subprocess.run(
        [sys.executable, "-m", "pdeface.template.build", str(shared_data / "data/ict_facekit"),
         "-o", str(target)],
        check=True,
    )  # fmt: skip
    with np.load(target) as built, np.load(template.DATA) as shipped:
        assert set(built.files) == set(shipped.files)
        for name in built.files:
            np.testing.assert_allclose(built[name], shipped[name], atol=2e-6)


@pytest.mark.parametrize("level", LEVELS)
def test_the_surface_is_as_near_to_the_scan_as_it_shall_be(scan, level: str) -> None:  # type: ignore[no-untyped-def]
    from pdeface.template.build.measure import measure

    accuracy = measure(template.neutral_curves(level).points, scan[1])
    rms, median, normal = REACH[level]
    assert accuracy.rms <= rms
    assert accuracy.median <= median
    assert accuracy.normal <= normal
    assert accuracy.folds == 0


def test_the_closed_head_follows_the_head(scan) -> None:  # type: ignore[no-untyped-def]
    # Every vertex but those on the eyeballs is the same combination of the head's in any position.
    head, mesh = scan
    np.testing.assert_allclose(np.asarray(mesh.links.sum(axis=1)).ravel(), 1.0, atol=1e-9)
    moved = mesh.links @ (head.vertices * 1.1) - mesh.links @ head.vertices
    np.testing.assert_allclose(moved, 0.1 * (mesh.links @ head.vertices), atol=1e-12)
    at_rest = np.linalg.norm(mesh.links @ head.vertices - mesh.vertices, axis=1)
    assert np.quantile(at_rest, 0.9) < 1e-9
    assert at_rest.max() < 0.003  # how far the eyeballs bulge out of the plane of the lids


def test_a_folder_without_the_head_is_one_clear_line(tmp_path: Path) -> None:
    done = subprocess.run(
        [sys.executable, "-m", "pdeface.template.build", str(tmp_path)],
        capture_output=True,
        text=True,
    )
    assert done.returncode == 2
    assert done.stderr.startswith("error: ")
    assert done.stderr.count("\n") == 1
    assert "generic_neutral_mesh.obj" in done.stderr


def test_fitting_recovers_curves_from_their_own_surface() -> None:
    from pdeface.pde import GridEvaluator
    from pdeface.pde.fit import fit_curves

    curves = template.neutral_curves()
    v = (np.arange(184) + 0.5) * 2 * np.pi / 184
    evaluator = GridEvaluator(curves.shape, np.linspace(0, 1, 217), v)
    samples = evaluator.positions(curves.points)
    fitted = fit_curves(samples, curves.shape, fairness=0.0, damping=0.0)
    np.testing.assert_allclose(fitted, curves.points, atol=1e-10)
    np.testing.assert_allclose(mirror_points(fitted[:, :23], curves.mirror_z), fitted, atol=1e-10)
