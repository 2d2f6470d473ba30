"""Fewer vertices, the same shape; normals in closed form."""

from __future__ import annotations

import numpy as np
import pytest

from pdeface.scan import make_scan
from pdeface.scan.raster import look
from pdeface.scan.surface import flattest
from pdeface.scan.thinning import thinned

trimesh = pytest.importorskip("trimesh", reason="needs the extra 'scan'")


@pytest.fixture(scope="module")
def ball():
    made = trimesh.creation.icosphere(subdivisions=5)
    colors = np.rint(127.0 * made.vertices + 128.0).clip(0, 255).astype(np.uint8)
    return make_scan(made.vertices, made.faces, colors=colors)


def test_a_thin_mesh_is_the_same_surface(ball) -> None:
    thin = thinned(ball, 0.1)
    assert len(thin.vertices) < len(ball.vertices) / 4
    np.testing.assert_allclose(np.linalg.norm(thin.vertices, axis=1), 1.0, atol=5e-3)
    a, b, c = thin.triangles.T
    assert (a != b).all() and (b != c).all() and (c != a).all()
    # Neither holes nor anything turned over: a ball of triangles that all face outwards.
    middle = thin.vertices[thin.triangles].mean(axis=1)
    corner = thin.vertices[thin.triangles]
    across = np.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0])
    area = 0.5 * np.linalg.norm(across, axis=1)
    assert ((across * middle).sum(axis=1) > 0.0).all()
    assert area.sum() == pytest.approx(4.0 * np.pi, rel=0.03)
    assert thin.colors is not None
    assert np.abs(thin.colors - (127.0 * thin.vertices + 128.0)).max() < 13.0


def test_a_thin_cloud_has_one_point_a_cube() -> None:
    points = np.random.default_rng(0).random((5000, 3))
    thin = thinned(make_scan(points), 0.25)
    assert thin.is_cloud
    assert len(thin.vertices) == 64


def test_nothing_is_thinned_by_cubes_that_are_too_many_to_number(ball) -> None:
    assert thinned(ball, 1e-8) is ball


def test_pictures_of_a_ball_are_whole(ball) -> None:
    """Every pixel within the outline is seen, at the depth of the ball, whatever the triangles."""
    for scan, off in ((ball, 2e-3), (thinned(ball, 0.1), 0.03)):
        seen = look(scan, np.eye(3), np.zeros(3), 2.4, (240, 240))
        x, y = np.meshgrid(*[0.01 * (np.arange(240) - 119.5)] * 2)
        inside = x**2 + y**2 < 0.9
        assert (seen.item[inside] >= 0).all()
        depth = np.sqrt(1.0 - (x**2 + y**2)[inside])
        np.testing.assert_allclose(seen.depth[inside], depth, atol=off)
        assert (seen.item[x**2 + y**2 > 1.0] == -1).all()


def test_the_flattest_direction_is_the_eigenvector() -> None:
    random = np.random.default_rng(3)
    points = random.normal(size=(400, 12, 3)) * (3.0, 1.0, 0.1)
    points = points @ np.linalg.qr(random.normal(size=(400, 3, 3)))[0]
    spreads = points.swapaxes(1, 2) @ points
    expected = np.linalg.eigh(spreads)[1][:, :, 0]
    agreement = np.abs((flattest(spreads) * expected).sum(axis=1))
    np.testing.assert_allclose(agreement, 1.0, atol=1e-9)


def test_points_on_a_line_or_at_one_place_have_some_direction() -> None:
    line = np.diag([1.0, 0.0, 0.0])
    found = flattest(np.array([line, np.zeros((3, 3)), np.eye(3)]))
    assert np.isfinite(found).all()
