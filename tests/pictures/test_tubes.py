from __future__ import annotations

import numpy as np
import pytest

from pdeface.pictures.camera import frame
from pdeface.pictures.solid import Solid, merge
from pdeface.pictures.tubes import balls, tube

RED = np.array([1.0, 0.0, 0.0])


def volume(solid: Solid) -> float:
    """Signed volume by the divergence theorem: positive if all triangles face outwards."""
    a, b, c = (solid.vertices[solid.triangles[:, k]] for k in range(3))
    return float(np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6.0)


def ring(count: int = 60) -> np.ndarray:
    angle = np.arange(count) * 2 * np.pi / count
    return np.stack([np.cos(angle), np.sin(2 * angle) * 0.2, np.sin(angle)], axis=1)


def test_a_closed_tube_is_closed_and_faces_outwards() -> None:
    solid = tube(ring(), 0.05, RED, closed=True)
    edges = np.sort(solid.triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
    _, counts = np.unique(edges, axis=0, return_counts=True)
    # The first and the last ring need not be turned alike, but every edge has two sides.
    assert np.all(counts == 2)
    assert volume(solid) > 0.0


def test_a_tube_has_its_radius_all_along() -> None:
    path = ring()
    solid = tube(path[:40], 0.05, RED)
    rings = solid.vertices.reshape(40, -1, 3)
    np.testing.assert_allclose(np.linalg.norm(rings - path[:40, None], axis=-1), 0.05)


def test_a_straight_tube_faces_outwards() -> None:
    solid = tube(np.array([[0.0, 0.0, 0.0], [0.0, 1.0, 0.0]]), 0.1, RED)
    a, b, c = (solid.vertices[solid.triangles[:, k]] for k in range(3))
    outwards = (a + b + c) / 3.0 * [1.0, 0.0, 1.0]
    assert np.all(np.einsum("ij,ij->i", np.cross(b - a, c - a), outwards) > 0.0)


def test_balls_face_the_camera() -> None:
    camera = frame(np.array([[-0.1, -0.1, 0.0], [0.1, 0.1, 0.1]]), 40.0)
    centres = np.array([[0.0, 0.0, 0.05], [0.05, 0.02, 0.0]])
    solid = balls(centres, 0.01, np.array([[1.0, 0, 0], [0, 1.0, 0]]), camera)
    a, b, c = (solid.vertices[solid.triangles[:, k]] for k in range(3))
    assert np.all(np.cross(b - a, c - a) @ camera.backward > -1e-12)
    middles = centres + 0.01 * camera.backward
    near = np.linalg.norm(solid.vertices[:, None] - middles, axis=-1).min(axis=1)
    assert near.max() == pytest.approx(0.01)


def test_merged_solids_keep_their_shapes_and_colours() -> None:
    parts = [tube(ring() + k, 0.05, RED * k, closed=True) for k in (0, 1)]
    both = merge(parts)
    assert volume(both) == pytest.approx(sum(map(volume, parts)))
    assert len(np.unique(both.colors, axis=0)) == 2
