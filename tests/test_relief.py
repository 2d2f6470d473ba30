"""Heights over a face: sampled, raised, kept in a picture."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import pdeface
from pdeface.errors import FileFormatError, InputError
from pdeface.relief import Relief, load_relief, save_relief


@pytest.fixture(scope="module")
def bumpy() -> Relief:
    u, v = np.meshgrid(np.linspace(0, 1, 80), np.linspace(0, 1, 60), indexing="ij")
    return Relief(1.5e-3 * np.sin(9.0 * u) * np.cos(7.0 * v))


def test_heights_between_texels_are_linear() -> None:
    heights = np.arange(12.0).reshape(3, 4) * 1e-3
    relief = Relief(heights)
    middles = np.stack(np.meshgrid((np.arange(4) + 0.5) / 4, (np.arange(3) + 0.5) / 3), -1)
    np.testing.assert_allclose(relief.at(middles.reshape(-1, 2)), heights.ravel(), atol=1e-15)
    np.testing.assert_allclose(relief.at(np.array([[0.25, 0.5]])), [4.5e-3], atol=1e-15)
    np.testing.assert_allclose(relief.at(np.array([[0.0, 0.0], [1.0, 1.0]])), [0.0, 11e-3])


def test_a_single_texel_is_the_same_everywhere() -> None:
    places = np.random.default_rng(0).random((20, 2))
    np.testing.assert_allclose(Relief(np.full((1, 1), 2e-3)).at(places), 2e-3)


def test_a_constant_height_moves_along_the_normals() -> None:
    mesh = pdeface.neutral().mesh(60, 60, openings="none")
    raised = Relief(np.full((4, 4), 1e-3)).raised(mesh)
    np.testing.assert_allclose(raised.vertices, mesh.vertices + 1e-3 * mesh.normals, atol=1e-12)
    turned = (raised.normals * mesh.normals).sum(axis=1)
    assert np.median(turned) > 0.9999  # what is parallel has the same normals


def test_normals_turn_with_the_relief(bumpy: Relief) -> None:
    """Against the triangles of a fine mesh, which need no analytic normals."""
    mesh = bumpy.raised(pdeface.neutral("55x92").mesh(217, 241, openings="none"))
    a, b, c = (mesh.vertices[corner] for corner in mesh.triangles.T)
    facing = np.cross(b - a, c - a)
    facing /= np.linalg.norm(facing, axis=1, keepdims=True)
    middle = mesh.normals[mesh.triangles].mean(axis=1)
    middle /= np.linalg.norm(middle, axis=1, keepdims=True)
    assert np.degrees(np.arccos((facing * middle).sum(axis=1).clip(-1, 1))).mean() < 1.0


def test_a_relief_survives_its_picture(bumpy: Relief, tmp_path: Path) -> None:
    pytest.importorskip("PIL", reason="needs the extra 'texture'")
    path = tmp_path / "relief.png"
    save_relief(path, bumpy)
    step = np.abs(bumpy.heights).max() / 32767
    np.testing.assert_allclose(load_relief(path).heights, bumpy.heights, atol=0.51 * step)
    save_relief(path, Relief(np.zeros((3, 3))))
    assert not load_relief(path).heights.any()


def test_what_is_no_relief_is_one_line(tmp_path: Path) -> None:
    image = pytest.importorskip("PIL.Image", reason="needs the extra 'texture'")
    path = tmp_path / "relief.png"
    with pytest.raises(InputError, match="found no file"):
        load_relief(path)
    image.fromarray(np.zeros((4, 4, 3), np.uint8)).save(path)
    for content in (path.read_bytes(), path.read_bytes()[:60], b"", b"solid"):
        path.write_bytes(content)
        with pytest.raises(FileFormatError, match="expected a relief") as caught:
            load_relief(path)
        assert "\n" not in str(caught.value)
    with pytest.raises(InputError, match="ends|name it so"):
        save_relief(tmp_path / "relief.jpg", Relief(np.zeros((2, 2))))


@pytest.mark.parametrize(
    "heights", [np.zeros(3), np.zeros((0, 3)), np.full((2, 2), np.nan), np.full((2, 2), 3.0)]
)
def test_heights_that_no_face_has(heights: np.ndarray) -> None:
    with pytest.raises(InputError):
        Relief(heights)


def test_files_show_the_relief(bumpy: Relief, tmp_path: Path) -> None:
    trimesh = pytest.importorskip("trimesh", reason="needs the extra 'test'")
    face = pdeface.neutral()
    expected = bumpy.raised(face.mesh(28, 41, openings="none")).vertices
    for suffix in (".ply", ".glb"):
        path = tmp_path / f"face{suffix}"
        pdeface.export(face, path, openings="none", relief=bumpy)
        read = trimesh.load(path, process=False, force="mesh").vertices[: len(expected)]
        np.testing.assert_allclose(read, expected, atol=1e-6)
    with pytest.raises(InputError, match="a relief can be written to"):
        pdeface.export(face, tmp_path / "face.pdeface", relief=bumpy)
