"""Hair, clothes and grounds of the random people that shapes are learnt from."""

from __future__ import annotations

import numpy as np
import pytest

pytest.importorskip("scipy", reason="needs the extra 'template'")
pytest.importorskip("vtk", reason="needs the extra 'render'")

from pdeface.photo.build.heads import HeadSpace, mesh_normals
from pdeface.photo.build.scenes import Scene, photograph
from pdeface.photo.build.skins import random_skin
from pdeface.photo.build.wardrobe import random_covers, random_ground
from pdeface.pictures.raster_vtk import Canvas

SEEDS = range(12)


@pytest.fixture(scope="module")
def head(shared_data):
    return HeadSpace(shared_data / "data" / "ict_facekit").neutral


@pytest.fixture(scope="module")
def covers(head):
    return {n: random_covers(np.random.default_rng(n), head, np.full(3, 0.6)) for n in SEEDS}


def test_covers_are_of_many_kinds_and_colours(covers) -> None:
    assert len({len(each) for each in covers.values()}) >= 3
    colors = [c.color for each in covers.values() for c in each]
    assert min(c.min() for c in colors) >= 0.0 and max(c.max() for c in colors) <= 1.0
    assert np.std([c.mean() for c in colors]) > 0.05


def test_covers_turn_their_front_sides_out(covers) -> None:
    """Away from the vertical line through the head; of a curtain's two sides the first."""
    for cover in (c for each in covers.values() for c in each):
        triangles, half = cover.triangles, len(cover.triangles) // 2
        if np.array_equal(triangles[:half, ::-1], triangles[half:]):
            triangles = triangles[:half]
        used = np.unique(triangles)
        normal = mesh_normals(cover.vertices, triangles)[used]
        away = (cover.vertices[used] - (0.0, 0.045, 0.0)) * (1.0, 0.3, 1.0)
        outward = np.einsum("ni,ni->n", normal, away / np.linalg.norm(away, axis=1)[:, None])
        assert outward.mean() > 0.4


def test_the_face_is_free_and_much_about_it_is_not(head, covers) -> None:
    scene, canvas = Scene(filling=0.7), Canvas()
    skin = random_skin(np.random.default_rng(1))
    bare = photograph(head, skin, scene, canvas).astype(int)
    places, _ = scene.camera.project(head.vertices, scene.size)
    space = head.texcoords[:, 1]
    face = (space > 0.2) & (space < 0.85) & (np.abs(head.texcoords[:, 0] - 0.5) < 0.25)
    columns, rows = places[face].astype(int).T
    changed = []
    for each in covers.values():
        worn = photograph(head, skin, scene, canvas, each).astype(int)
        away = np.abs(worn - bare).max(axis=2) > 3
        assert away[rows, columns].mean() < 0.01
        changed.append(away.mean())
    assert np.mean(np.array(changed) > 0.05) > 0.6


def test_grounds_stay_behind_and_are_of_many_kinds(head) -> None:
    scene, canvas = Scene(filling=0.7), Canvas()
    skin = random_skin(np.random.default_rng(1))
    grounds = [random_ground(np.random.default_rng(n), scene.size) for n in SEEDS]
    even = [g.std(axis=(0, 1)).max() < 1e-9 for g in grounds]
    assert any(even) and not all(even)
    one, other = (photograph(head, skin, scene, canvas, ground=g).astype(int) for g in grounds[:2])
    middle = one.shape[0] // 2, one.shape[1] // 2
    assert (one[middle] == other[middle]).all()
    assert np.abs(one[0, 0] - other[0, 0]).max() > 3
