"""OBJ, PLY and STL, as trimesh and VTK read them."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import pyvista
import trimesh
from PIL import Image

import pdeface
from pdeface.curves import BoundaryCurves
from pdeface.face import Face

SIZE = (9, 12)


def read_back(path: Path) -> trimesh.Trimesh:
    (mesh,) = trimesh.load_scene(path, process=False).geometry.values()
    return mesh


@pytest.mark.parametrize("suffix", ["obj", "ply"])
@pytest.mark.parametrize("quads", [None, True, False])
def test_trimesh_reads_what_was_written(textured: Face, suffix, quads, tmp_path: Path) -> None:
    pdeface.export(textured, tmp_path / f"a.{suffix}", mesh=SIZE, quads=quads)
    mesh, truth = read_back(tmp_path / f"a.{suffix}"), textured.mesh(*SIZE)
    np.testing.assert_allclose(mesh.vertices, truth.vertices, rtol=1e-6, atol=1e-8)
    np.testing.assert_allclose(mesh.vertex_normals, truth.normals, atol=1e-6)
    np.testing.assert_allclose(mesh.visual.uv, truth.texcoords * [1, -1] + [0, 1], atol=1e-6)
    triangles = {tuple(np.roll(t, -t.argmin())) for t in mesh.faces}
    assert triangles == {tuple(np.roll(t, -t.argmin())) for t in truth.triangles}


@pytest.mark.parametrize("suffix", ["obj", "ply"])
def test_texture_is_the_right_way_up(
    textured: Face, suffix, tmp_path: Path, check_quarters
) -> None:
    pdeface.export(textured, tmp_path / f"a.{suffix}", mesh=(28, 41))
    mesh = read_back(tmp_path / f"a.{suffix}")
    check_quarters(mesh.vertices, mesh.visual.to_color().vertex_colors)


@pytest.mark.parametrize("suffix", ["obj", "ply", "stl"])
def test_outside_is_outside(textured: Face, suffix, tmp_path: Path) -> None:
    pdeface.export(textured, tmp_path / f"a.{suffix}", mesh=(28, 41))
    mesh = read_back(tmp_path / f"a.{suffix}")
    assert len(mesh.faces) == len(textured.mesh(28, 41).triangles)
    assert ((mesh.face_normals * mesh.triangles_center * [1, 0, 1]).sum(axis=1) > 0).all()


@pytest.mark.parametrize("suffix", ["obj", "ply"])
@pytest.mark.parametrize(("quads", "corners"), [(True, 4), (False, 3)])
def test_vtk_reads_what_was_written(textured: Face, suffix, quads, corners, tmp_path: Path) -> None:
    pdeface.export(textured, tmp_path / f"a.{suffix}", mesh=SIZE, quads=quads)
    mesh, truth = pyvista.read(tmp_path / f"a.{suffix}"), textured.mesh(*SIZE)
    cells = mesh.faces.reshape(-1, corners + 1)[:, 1:]
    expected = truth.quads if quads else truth.triangles
    np.testing.assert_allclose(mesh.points[cells], truth.vertices[expected], atol=1e-7)
    normals, texcoords = mesh.active_normals[cells], mesh.active_texture_coordinates[cells]
    np.testing.assert_allclose(normals, truth.normals[expected], atol=1e-6)
    np.testing.assert_allclose(texcoords, (truth.texcoords * [1, -1] + [0, 1])[expected], atol=1e-6)


def test_quads_by_default_in_obj_alone(plain: Face, tmp_path: Path) -> None:
    for suffix, cells in (("obj", 88), ("ply", 176), ("stl", 176)):
        pdeface.export(plain, tmp_path / f"a.{suffix}", mesh=SIZE)
        assert pyvista.read(tmp_path / f"a.{suffix}").n_cells == cells


def test_stl_holds_the_triangles_and_their_normals(plain: Face, tmp_path: Path) -> None:
    pdeface.export(plain, tmp_path / "a.stl", mesh=SIZE)
    mesh, truth = read_back(tmp_path / "a.stl"), plain.mesh(*SIZE)
    np.testing.assert_allclose(mesh.triangles, truth.vertices[truth.triangles], atol=1e-8)
    facets = np.frombuffer((tmp_path / "a.stl").read_bytes()[84:], np.uint8).reshape(-1, 50)
    written = facets[:, :12].copy().view("<f4")
    computed = trimesh.triangles.normals(truth.vertices[truth.triangles])[0]
    np.testing.assert_allclose(written, computed, atol=1e-5)


def test_companions_of_a_textured_obj(textured: Face, quarters, tmp_path: Path) -> None:
    (tmp_path / "me.png").write_bytes(b"the photo")
    pdeface.export(textured, tmp_path / "me.obj")
    names = sorted(entry.name for entry in tmp_path.iterdir())
    assert names == ["me-texture.png", "me.mtl", "me.obj", "me.png"]
    assert (tmp_path / "me.png").read_bytes() == b"the photo"
    np.testing.assert_array_equal(np.asarray(Image.open(tmp_path / "me-texture.png")), quarters)


def test_white_space_in_a_name_does_not_split_it(
    textured: Face, tmp_path: Path, check_quarters
) -> None:
    for suffix in ("obj", "ply"):
        path = tmp_path / f"a face of\tmine.{suffix}"
        pdeface.export(textured, path, mesh=(28, 41))
        mesh = read_back(path)
        check_quarters(mesh.vertices, mesh.visual.to_color().vertex_colors)
    companions = {entry.name for entry in tmp_path.iterdir() if entry.suffix in (".mtl", ".png")}
    assert companions == {"a_face_of_mine.mtl", "a_face_of_mine-texture.png"}


def test_without_texture_there_is_a_grey_and_no_picture(plain: Face, tmp_path: Path) -> None:
    pdeface.export(plain, tmp_path / "a.obj")
    pdeface.export(plain, tmp_path / "b.ply")
    assert sorted(e.name for e in tmp_path.iterdir()) == ["a.mtl", "a.obj", "b.ply"]
    grey = read_back(tmp_path / "a.obj").visual.material.main_color[:3]
    assert 150 < grey.min() <= grey.max() < 220


@pytest.mark.parametrize("suffix", ["obj", "ply", "stl"])
def test_a_surface_without_area_is_written_all_the_same(suffix, tmp_path: Path) -> None:
    face = Face(BoundaryCurves(np.zeros((4, 8, 3))))
    pdeface.export(face, tmp_path / f"a.{suffix}")
    assert np.isfinite(read_back(tmp_path / f"a.{suffix}").vertices).all()
