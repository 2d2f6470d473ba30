"""A numbered OBJ a frame: same topology, head and face as they are then, all files or none."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import trimesh

import pdeface
from pdeface.controls.neck import PIVOT
from pdeface.errors import InputError
from pdeface.face import Face
from pdeface.formats import export_sequence
from pdeface.motion import Frames, Track

TRACK = Track(
    [0.0, 1.0], ("jawOpen",), [[0.0], [1.0]], head=[[0.0, 0.0, 0.0], [0.6, 0.0, 0.0]]
)  # fmt: skip


def lines(path: Path, kind: str) -> list[str]:
    return [line for line in path.read_text().split("\n") if line.startswith(f"{kind} ")]


def numbers(path: Path, kind: str) -> np.ndarray:
    return np.array([line.split()[1:] for line in lines(path, kind)], dtype=float)


def names(folder: Path) -> list[str]:
    return sorted(p.name for p in folder.iterdir())


@pytest.fixture
def frames(quarters: np.ndarray) -> Frames:
    return Frames(pdeface.random(1).with_texture(quarters), TRACK, rate=4)


def test_each_frame_is_the_face_and_the_head_at_its_time(frames, tmp_path: Path) -> None:
    written = export_sequence(frames, tmp_path / "ada.obj", mesh=(28, 41))
    assert [p.name for p in written] == [f"ada.000{n}.obj" for n in range(1, 6)]
    for number, path in enumerate(written):
        mesh = pdeface.random(1).set(jawOpen=number / 4).mesh(28, 41)
        c, s = np.cos(0.15 * number), np.sin(0.15 * number)
        left = np.array([[c, 0, s], [0, 1, 0], [-s, 0, c]])  # +Z turns to +X
        truth = (mesh.vertices - PIVOT) @ left.T + PIVOT
        np.testing.assert_allclose(numbers(path, "v"), truth, atol=1e-7)
        np.testing.assert_allclose(numbers(path, "vn"), mesh.normals @ left.T, atol=1e-6)


def test_topology_texture_and_material_are_shared(frames, tmp_path: Path) -> None:
    written = export_sequence(frames, tmp_path / "a b.obj", mesh=(9, 11))
    assert len({tuple(lines(path, "f")) for path in written}) == 1
    assert len({tuple(lines(path, "vt")) for path in written}) == 1
    others = {"a_b.mtl", "a_b-texture.png"}
    assert set(names(tmp_path)) == {path.name for path in written} | others
    mesh = trimesh.load_mesh(written[2], process=False)
    assert mesh.visual.material.image.size == (64, 64)


def test_quads_triangles_and_no_texture(tmp_path: Path) -> None:
    some = [(pdeface.neutral(), np.zeros(3))] * 2
    (one, _) = export_sequence(some, tmp_path / "q.obj", mesh=(9, 11))
    assert len(lines(one, "f")) == 80
    (one, _) = export_sequence(some, tmp_path / "t.obj", mesh=(9, 11), quads=False)
    assert len(lines(one, "f")) == 160
    assert not list(tmp_path.glob("*.png"))


def test_it_replaces_itself_and_ignores_strangers(frames, tmp_path: Path) -> None:
    for name in ("a.12.obj", "ab.0099.obj", "a.0099.ply", "a.obj"):
        (tmp_path / name).write_text("old")
    for _ in range(2):
        export_sequence(frames, tmp_path / "a.obj", mesh=(9, 11))
    assert (tmp_path / "a.obj").read_text() == "old"
    assert (tmp_path / "a.0005.obj").read_text().startswith("# pdeface")


def test_frames_of_a_longer_sequence_are_not_mixed_in(frames, tmp_path: Path) -> None:
    (tmp_path / "a.0006.obj").write_text("old")
    with pytest.raises(InputError, match=r"a\.0006\.obj of another sequence.* 5 frames"):
        export_sequence(frames, tmp_path / "a.obj", mesh=(9, 11))
    assert names(tmp_path) == ["a.0006.obj"]


def test_a_failure_midway_leaves_nothing_new(frames, tmp_path: Path) -> None:
    (tmp_path / "a.0001.obj").write_text("old")

    def stop(number: int) -> None:
        if number == 4:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        export_sequence(frames, tmp_path / "a.obj", mesh=(9, 11), progress=stop)
    assert names(tmp_path) == ["a.0001.obj"]
    assert (tmp_path / "a.0001.obj").read_text() == "old"


@pytest.mark.parametrize(
    ("name", "change", "message"),
    [
        ("a.ply", {}, "written as .obj, got 'a.ply'"),
        ("a.obj", {"frames": []}, "a frame at least, got none"),
        ("a.obj", {"mesh": (1, 1)}, "at least 2 rows"),
        ("no/a.obj", {}, "does not exist"),
    ],
)
def test_bad_input_leaves_nothing(name, change, message, tmp_path: Path) -> None:
    wanted = {"frames": [(pdeface.neutral(), np.zeros(3))], "mesh": (9, 11), **change}
    with pytest.raises(InputError, match=message):
        export_sequence(wanted.pop("frames"), tmp_path / name, **wanted)
    assert names(tmp_path) == []


def test_a_face_that_cannot_move_is_refused_before_a_file_appears(
    plain: Face, tmp_path: Path
) -> None:
    still = Face(plain.curves.__class__(plain.curves.points[:27]))
    with pytest.raises(InputError, match="27 n"):
        export_sequence(Frames(still, TRACK, 4), tmp_path / "a.obj")
    assert names(tmp_path) == []
