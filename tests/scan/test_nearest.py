"""Nearest places on triangles and clouds, and views of them."""

from __future__ import annotations

import numpy as np
import pytest

from pdeface.scan import make_scan
from pdeface.scan.nearest import Target
from pdeface.scan.raster import look
from pdeface.scan.surface import Scan
from pdeface.scan.visible import outside

trimesh = pytest.importorskip("trimesh", reason="needs the extra 'scan'")


@pytest.fixture(scope="module")
def ball():
    mesh = trimesh.creation.icosphere(subdivisions=4, radius=0.08)
    return make_scan(mesh.vertices + (0.0, 0.0, 0.06), mesh.faces)


def test_nearest_places_are_the_nearest(ball) -> None:
    points = np.random.default_rng(1).normal(size=(300, 3)) * 0.06
    found = Target(ball).nearest(points)
    # Every place of every triangle, densely, is at least as far away.
    shares = np.random.default_rng(2).dirichlet((1.0, 1.0, 1.0), 40)
    corners = ball.vertices[ball.triangles]
    places = np.einsum("sc,tci->tsi", shares, corners).reshape(-1, 3)
    for point, away in zip(points[:40], found.away[:40], strict=True):
        assert away <= np.linalg.norm(places - point, axis=1).min() + 1e-9
    np.testing.assert_allclose(found.weights.sum(axis=1), 1.0)
    at = np.einsum("nc,nci->ni", found.weights, ball.vertices[found.corners])
    np.testing.assert_allclose(at, found.points, atol=1e-12)


def test_a_breadth_finds_the_side_that_faces_the_same_way() -> None:
    """Two sheets 1 mm apart, back to back: the nearer one faces the wrong way."""
    x, y = np.meshgrid(*[np.linspace(-0.02, 0.02, 81)] * 2)
    sheet = np.stack([x.ravel(), y.ravel(), np.zeros(x.size)], axis=1)
    normals = np.tile([0.0, 0.0, 1.0], (len(sheet), 1))
    cloud = Scan(
        np.concatenate([sheet, sheet - (0.0, 0.0, 1e-3)]),
        np.zeros((0, 3), np.int64),
        given_normals=np.concatenate([normals, -normals]),
    )
    below = np.array([[0.001, 0.002, -2e-3]])
    up = np.array([[0.0, 0.0, 1.0]])
    assert Target(cloud).nearest(below).points[0, 2] == pytest.approx(-1e-3)
    assert Target(cloud, 4e-3).nearest(below, up).points[0, 2] == pytest.approx(0.0)


def test_a_view_sees_the_front_of_a_ball(ball) -> None:
    seen = look(ball, np.eye(3), np.array([0.0, 0.0, 0.06]), 0.2, (101, 101))
    assert seen.depth[50, 50] == pytest.approx(0.08, abs=1e-4)
    assert seen.item[0, 0] == -1
    share = (seen.item >= 0).mean()
    assert share == pytest.approx(np.pi * 0.08**2 / 0.2**2, abs=0.01)
    places = seen.spread(ball, ball.vertices)[seen.item >= 0]
    np.testing.assert_allclose(np.linalg.norm(places - (0, 0, 0.06), axis=1), 0.08, atol=3e-4)


def test_a_cloud_lets_no_light_through(ball) -> None:
    cloud = make_scan(ball.vertices)
    seen = look(cloud, np.eye(3), np.array([0.0, 0.0, 0.06]), 0.2, (101, 101))
    inside = np.hypot(*(np.indices((101, 101)) - 50.0)) < 37
    assert (seen.depth[inside] > 0.0).mean() > 0.999


@pytest.mark.parametrize("turned", [False, True])
def test_the_outside_leaves_out_what_lies_within(ball, turned: bool) -> None:
    inner = 0.6 * (ball.vertices - (0, 0, 0.06)) + (0, 0, 0.06)
    triangles = np.concatenate([ball.triangles, ball.triangles + len(inner)])
    both = make_scan(np.concatenate([ball.vertices, inner]), triangles)
    skin = outside(both.inside_out() if turned else both)
    away = skin.vertices - (0.0, 0.0, 0.06)
    np.testing.assert_allclose(np.linalg.norm(away, axis=1), 0.08, atol=1e-6)
    assert (skin.normals * away).sum(axis=1).min() > 0.0
    assert len(skin.vertices) > 0.4 * len(ball.vertices)


def test_the_normals_of_a_cloud_are_made_to_face_outwards(ball) -> None:
    skin = outside(make_scan(ball.vertices))
    away = skin.vertices - (0.0, 0.0, 0.06)
    assert ((skin.normals * away).sum(axis=1) > 0.0).mean() > 0.99
