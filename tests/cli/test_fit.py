"""``pdeface fit``: a scan's file in, a face's file and a picture out."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

import pdeface
from pdeface.scan.landmark_file import known_places

trimesh = pytest.importorskip("trimesh", reason="needs the extra 'scan'")


@pytest.fixture(scope="module")
def files(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, Path]:
    """A scan of a random person in millimetres, and points on it."""
    folder = tmp_path_factory.mktemp("scan")
    face = pdeface.random(3, "55x92")
    mesh = face.mesh(109, 101, openings="none")
    trimesh.Trimesh(1e3 * mesh.vertices, mesh.triangles, process=False).export(folder / "head.ply")
    surface = face.surface()
    points = {name: (1e3 * surface(u, v)).tolist() for name, (u, v, _) in known_places().items()}
    (folder / "points.json").write_text(json.dumps(points))
    return folder / "head.ply", folder / "points.json"


def test_a_scan_becomes_a_face(files, tmp_path: Path, pdeface_command) -> None:
    scan, points = files
    out, picture = tmp_path / "face.pdeface", tmp_path / "fit.png"
    done = pdeface_command(
        "fit", scan, "--landmarks", points, "-o", out, "--level", "28x46", "--report", picture
    )
    assert done.status == 0, done.err
    assert "RMS" in done.out
    assert "coverage 100.0 %" in done.out
    face = pdeface.load(out)
    assert face.curves.shape == (28, 46)
    assert face.name == "head"
    assert picture.stat().st_size > 100_000


@pytest.mark.parametrize(("words", "said"), [([], True), (["--no-round"], False)])
def test_coarse_triangles_are_told_of(words, said, files, tmp_path, pdeface_command) -> None:
    mesh = pdeface.random(3, "55x92").mesh(37, 34, openings="none")
    scan = tmp_path / "coarse.ply"
    trimesh.Trimesh(1e3 * mesh.vertices, mesh.triangles, process=False).export(scan)
    out = tmp_path / "face.pdeface"
    done = pdeface_command("fit", scan, "--landmarks", files[1], "-o", out, *words)
    assert done.status == 0, done.err
    assert ("mm wide: fitted the curved surface" in done.out) == said


@pytest.mark.parametrize(
    ("words", "says"),
    [
        (["SCAN", "-o", "a.png"], "suffix of the output"),
        (["SCAN", "-o", "a.pdeface", "--level", "29x46"], "27 n"),
        (["SCAN", "-o", "a.pdeface", "--level", "fine"], "--level needs"),
        (["SCAN", "-o", "a.pdeface", "--report", "a.txt"], "suffix of the output"),
        (["SCAN", "-o", "a.pdeface", "--landmarks", "none.json"], "found no file"),
        (["none.ply", "-o", "a.pdeface"], "found no file"),
        (["POINTS", "-o", "a.pdeface"], "a scan is one of"),
        (["SCAN", "-o", "a.pdeface", "--landmarks", "POINTS", "--units", "m"], "no face's"),
    ],
)
def test_bad_input_is_one_line(words, says, files, tmp_path, monkeypatch, pdeface_command) -> None:
    monkeypatch.chdir(tmp_path)
    places = {"SCAN": files[0], "POINTS": files[1]}
    done = pdeface_command("fit", *(places.get(word, word) for word in words))
    assert done.status == 2
    assert says in done.err
    assert len(done.err.splitlines()) == 1
    assert not list(tmp_path.iterdir())


def test_a_compact_face(files, tmp_path: Path, pdeface_command) -> None:
    scan, points = files
    out = tmp_path / "small.pdeface"
    words = ["--landmarks", points, "-o", out, "--level", "28x46", "--compact", "0.1"]
    done = pdeface_command("fit", scan, *words)
    assert done.status == 0, done.err
    assert "bytes, off by 0.100 mm" in done.out or "bytes, off by 0.099 mm" in done.out
    assert out.stat().st_size < 700
    assert pdeface.load(out).curves.shape == (28, 46)
    refused = pdeface_command("fit", scan, "-o", tmp_path / "a.glb", "--compact", "0.1")
    assert refused.status == 2
    assert "--compact needs" in refused.err


def test_a_folder_of_scans_becomes_a_folder_of_faces(
    files, shared_data: Path, tmp_path: Path, monkeypatch, pdeface_command
) -> None:
    monkeypatch.setenv("PDEFACE_MODEL", str(shared_data / "models" / "face_landmarker.task"))
    pytest.importorskip("mediapipe", reason="needs the extra 'photo'", exc_type=ImportError)
    scans, faces = tmp_path / "scans", tmp_path / "faces"
    scans.mkdir()
    (scans / "good.ply").write_bytes(files[0].read_bytes())
    (scans / "short.ply").write_bytes(files[0].read_bytes()[:5000])
    (scans / "text.txt").write_text("not a scan")
    done = pdeface_command("fit", scans, "-o", faces, "--jobs", "2", "--level", "28x46")
    assert done.status == 1
    assert "1 made, 0 kept, 1 failed" in done.out
    assert "short.ply" in done.err
    assert [path.name for path in faces.iterdir()] == ["good.pdeface"]
    made = (faces / "good.pdeface").stat().st_mtime_ns
    (scans / "short.ply").unlink()
    again = pdeface_command("fit", scans, "-o", faces, "--level", "28x46")
    assert again.status == 0
    assert "0 made, 1 kept, 0 failed" in again.out
    assert (faces / "good.pdeface").stat().st_mtime_ns == made


@pytest.mark.parametrize(
    ("words", "says"),
    [
        (["FOLDER", "-o", "a.pdeface"], "one folder of faces"),
        (["FOLDER", "-o", "faces", "--report", "a.png"], "of one scan"),
        (["FOLDER", "-o", "faces", "--landmarks", "b.json"], "of one scan"),
        (["FOLDER", "-o", "faces", "--formats", "png"], "--formats takes"),
        (["EMPTY", "-o", "faces"], "found none"),
    ],
)
def test_folders_that_cannot_be_fitted(words, says, files, tmp_path, pdeface_command) -> None:
    places = {"FOLDER": files[0].parent, "EMPTY": tmp_path}
    done = pdeface_command("fit", *(places.get(word, word) for word in words))
    assert done.status == 2
    assert says in done.err
