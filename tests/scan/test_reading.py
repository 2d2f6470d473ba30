"""Every format in; every broken file one clear line."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from pdeface.errors import InputError
from pdeface.scan import make_scan, read_scan

trimesh = pytest.importorskip("trimesh", reason="needs the extra 'scan'")


@pytest.fixture(scope="module")
def ball():
    return trimesh.creation.icosphere(subdivisions=3)


@pytest.mark.parametrize("suffix", [".obj", ".ply", ".stl", ".glb", ".off"])
def test_a_mesh_comes_back(ball, suffix: str, tmp_path: Path) -> None:
    path = tmp_path / f"ball{suffix.upper() if suffix == '.obj' else suffix}"
    path.write_bytes(_bytes(ball.export(file_type=suffix[1:])))
    scan = read_scan(path)
    assert len(scan.triangles) == len(ball.faces)
    np.testing.assert_allclose(np.linalg.norm(scan.vertices, axis=1), 1.0, atol=1e-5)


def test_normals_point_outwards(ball) -> None:
    scan = make_scan(ball.vertices, ball.faces)
    assert (scan.normals * ball.vertices).sum(axis=1).min() > 0.99


def test_a_cloud_comes_back_with_its_colours(ball, tmp_path: Path) -> None:
    colors = np.random.default_rng(0).integers(0, 255, (len(ball.vertices), 4), np.uint8)
    path = tmp_path / "cloud.ply"
    trimesh.PointCloud(ball.vertices, colors).export(path)
    scan = read_scan(path)
    assert scan.is_cloud
    np.testing.assert_array_equal(scan.colors, colors[:, :3])
    # A cloud's normals have a direction, but no side.
    assert np.abs((scan.normals * scan.vertices).sum(axis=1)).min() > 0.97


def test_places_that_are_no_numbers_are_left_out(ball) -> None:
    vertices = ball.vertices.copy()
    vertices[7] = np.nan
    scan = make_scan(vertices, ball.faces)
    assert np.isfinite(scan.vertices).all()
    assert len(scan.vertices) == len(vertices) - 1
    assert len(scan.triangles) == len(ball.faces) - (ball.faces == 7).any(axis=1).sum()


@pytest.mark.parametrize("suffix", [".obj", ".ply", ".stl", ".glb", ".gltf", ".off"])
@pytest.mark.parametrize("content", [b"", b"\x00\xff not a scan", b"ply\nformat ascii 1.0\nend"])
def test_what_is_no_scan_is_refused_in_one_line(content: bytes, suffix: str, tmp_path) -> None:
    path = tmp_path / f"broken{suffix}"
    path.write_bytes(content)
    with pytest.raises(InputError) as caught:
        read_scan(path)
    assert "\n" not in str(caught.value)
    assert path.name in str(caught.value)


@pytest.mark.parametrize("suffix", [".ply", ".glb", ".stl"])
def test_a_file_cut_short_is_refused(ball, suffix: str, tmp_path: Path) -> None:
    path = tmp_path / f"short{suffix}"
    data = _bytes(ball.export(file_type=suffix[1:]))
    path.write_bytes(data[: len(data) // 2])
    with pytest.raises(InputError, match="again") as caught:
        read_scan(path)
    assert "\n" not in str(caught.value)


def test_too_few_vertices_and_other_suffixes_and_no_file(tmp_path: Path) -> None:
    cube = tmp_path / "cube.ply"
    trimesh.creation.box().export(cube)
    with pytest.raises(InputError, match="at least 200 vertices"):
        read_scan(cube)
    with pytest.raises(InputError, match=r"one of \.obj"):
        read_scan(tmp_path / "head.fbx")
    with pytest.raises(InputError, match="found no file"):
        read_scan(tmp_path / "head.ply")


def test_triangles_of_vertices_that_there_are_not(ball) -> None:
    with pytest.raises(InputError, match="triangles need vertices"):
        make_scan(ball.vertices, ball.faces + 1)


def _bytes(data) -> bytes:
    return data.encode() if isinstance(data, str) else data
