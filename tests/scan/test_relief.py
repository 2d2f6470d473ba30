"""What few curves leave out of a scan comes back with the relief."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.spatial import cKDTree

from pdeface.scan import fit_scan, make_scan, relief_of


@pytest.fixture(scope="module")
def fit(known):
    return fit_scan(known.scan, (28, 46), landmarks=known.landmarks, units="m")


@pytest.fixture(scope="module")
def relief(fit):
    return relief_of(fit, 256)


def test_a_relief_brings_a_coarse_fit_onto_its_scan(fit, relief) -> None:
    mesh = fit.face.mesh(109, 121, openings="none")
    inner = np.abs(mesh.texcoords - 0.5).max(axis=1) < 0.3
    # Vertices of the scan lie half a millimetre apart: what is along the surface does not count.
    tree, facing = cKDTree(fit.scan.vertices), fit.scan.normals

    def off(vertices: np.ndarray) -> float:
        near = tree.query(vertices[inner])[1]
        away = ((vertices[inner] - fit.scan.vertices[near]) * facing[near]).sum(axis=1)
        return float(np.median(np.abs(away)))

    assert off(relief.raised(mesh).vertices) < 0.25 * off(mesh.vertices)


def test_a_bump_is_as_high_as_it_is(known, relief) -> None:
    """A wart of a millimetre on a cheek, narrower than the curves are apart."""
    place = known.face.surface()(0.6, 0.9)
    away = np.linalg.norm(known.scan.vertices - place, axis=1)
    wart = 1e-3 * np.exp(-((away / 2.5e-3) ** 2))[:, None] * known.scan.normals
    scan = make_scan(known.scan.vertices + wart, known.scan.triangles)
    warty = relief_of(fit_scan(scan, (28, 46), landmarks=known.landmarks, units="m"), 256)
    rise = warty.heights - relief.heights
    top = np.unravel_index(rise.argmax(), rise.shape)
    assert 0.6e-3 < rise.max() < 1.05e-3
    np.testing.assert_allclose((np.array(top) + 0.5) / 256 * (1.0, np.pi), (0.6, 0.9), atol=0.03)
    assert np.median(np.abs(rise)) < 0.01e-3
