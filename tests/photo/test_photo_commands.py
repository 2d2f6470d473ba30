"""`pdeface points` and `pdeface make` of a photo that came without points."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

import pdeface
from pdeface.__main__ import main
from pdeface.texture import FeaturePoints, uv_texture, write_image

# Counts what asks for a network in this process, in Python; C code is cut off by `unshare`.
WATCHED = """
import sys
asked = []
def watch(event, arguments):
    if event in ("socket.connect", "socket.getaddrinfo", "socket.gethostbyname", "socket.sendto"):
        asked.append((event, arguments[1:]))
        raise OSError("no network here")
sys.addaudithook(watch)
from pdeface.__main__ import main
status = main(sys.argv[1:])
assert not asked, asked
sys.exit(status)
"""


@pytest.fixture
def here(photo, model_named, tmp_path: Path, monkeypatch) -> Path:
    monkeypatch.chdir(tmp_path)
    write_image(np.repeat(np.repeat(photo, 2, axis=0), 2, axis=1), "me.png")
    return tmp_path


def test_points_writes_what_make_takes(here, capfd) -> None:
    assert main(["points", "me.png", "-o", "me.json"]) == 0
    assert main(["make", "me.png", "--points", "me.json", "-o", "by_points.pdeface"]) == 0
    assert main(["make", "me.png", "-o", "at_once.pdeface", "--texture", "warp"]) == 0
    out, err = capfd.readouterr()
    assert err == ""
    assert "wrote me.json" in out
    by_points, at_once = pdeface.load("by_points.pdeface"), pdeface.load("at_once.pdeface")
    np.testing.assert_array_equal(by_points.texture, at_once.texture)
    assert not by_points.weights
    assert set(at_once.weights) <= {f"identity{n:02d}" for n in range(1, 51)}
    assert at_once.name == "me"


def test_the_texture_is_that_of_the_points(here, photo) -> None:
    write_image(photo, "small.png")
    main(["points", "small.png", "-o", "small.json", "-q"])
    main(["make", "small.png", "-o", "small.pdeface", "-q", "--texture", "warp"])
    expected = uv_texture(photo, FeaturePoints.load("small.json")).image
    difference = np.abs(pdeface.load("small.pdeface").texture.astype(int) - expected)
    assert difference.mean() < 0.5  # the file's ten digits


def test_the_shape_is_the_persons_unless_another_is_asked_for(here) -> None:
    for words in ([], ["--neutral-shape"], ["--random", "7"], ["--set", "identity01=2"]):
        assert main(["make", "me.png", "-o", "a.pdeface", "-q", *words]) == 0
        weights = pdeface.load("a.pdeface").weights
        if "--random" in words:
            assert weights == pdeface.random(7).weights
        elif words[:1] == ["--neutral-shape"]:
            assert not weights
        else:
            assert len(weights) == 50
            assert (weights["identity01"] == 2.0) == bool(words)


def test_the_texture_is_projected_and_the_report_drawn(here, capfd) -> None:
    words = ["me.png", "-o", "me.pdeface", "--report", "report.png"]
    assert main(["make", *words]) == 0
    assert "wrote report.png" in capfd.readouterr().out
    with Image.open("report.png") as report:
        assert report.width > 2000 and report.height > 2000
    shown = pdeface.load("me.pdeface").texture
    assert main(["make", "me.png", "-o", "warped.pdeface", "--texture", "warp", "-q"]) == 0
    warped = pdeface.load("warped.pdeface").texture
    assert shown.shape != warped.shape or np.abs(shown.astype(int) - warped).mean() > 5.0


def test_several_photos_are_one_person(here, photo, capfd) -> None:
    write_image((photo * 0.7).astype(np.uint8), "darker.png")
    assert main(["make", "me.png", "darker.png", "-o", "two.pdeface", "-q"]) == 0
    assert main(["make", "me.png", "-o", "one.pdeface", "-q"]) == 0
    two, one = pdeface.load("two.pdeface"), pdeface.load("one.pdeface")
    assert two.name == "me"
    assert abs(two.texture.mean() - one.texture.mean()) < 25.0


@pytest.mark.parametrize("jobs", ["1", "2"])
def test_a_folder_makes_a_folder_and_one_bad_photo_does_not_stop_it(here, capfd, jobs) -> None:
    folder = Path("photos")
    folder.mkdir()
    for name in ("ann.png", "bob.png"):
        shutil.copy("me.png", folder / name)
    (folder / "cut.jpg").write_bytes(b"\xff\xd8\xff no photo")
    (folder / "notes.txt").write_text("no photo at all")
    words = ["make", "photos", "-o", "faces", "--formats", "pdeface,obj", "--mesh", "28x41"]
    assert main([*words, "--jobs", jobs]) == 1
    out, err = capfd.readouterr()
    assert "2 made, 0 kept, 1 failed" in out
    assert err.startswith("warning: cut.jpg: ") and err.count("\n") == 1
    made = sorted(path.name for path in Path("faces").iterdir())
    assert [name for name in made if name.endswith((".pdeface", ".obj"))] == [
        "ann.obj", "ann.pdeface", "bob.obj", "bob.pdeface"
    ]  # fmt: skip
    before = Path("faces/ann.obj").stat().st_mtime_ns
    (folder / "cut.jpg").unlink()
    Path("faces/bob.obj").unlink()
    assert main(words) == 0
    assert "1 made, 1 kept, 0 failed" in capfd.readouterr().out
    assert Path("faces/ann.obj").stat().st_mtime_ns == before


@pytest.mark.parametrize(
    "words",
    [
        ["photos", "-o", "a.glb"],
        ["photos", "me.png", "-o", "faces"],
        ["photos", "-o", "faces", "--formats", "doc"],
        ["photos", "-o", "faces", "--report", "r.png"],
        ["empty", "-o", "faces"],
        ["me.png", "-o", "a.glb", "--report", "a.pdf"],
        ["me.png", "-o", "a.glb", "--texture", "warp", "--delight"],
        ["me.png", "me.png", "-o", "a.glb", "--points", "p.json"],
        ["me.png", "-o", "a.glb", "--points", "p.json", "--texture", "project"],
    ],
    ids=" ".join,
)
def test_what_does_not_go_together_is_one_line(tmp_path, monkeypatch, capfd, words) -> None:
    monkeypatch.chdir(tmp_path)
    for folder in ("photos", "empty"):
        Path(folder).mkdir()
    write_image(np.full((20, 20, 3), 90, np.uint8), "me.png")
    shutil.copy("me.png", "photos/me.png")
    before = sorted(tmp_path.rglob("*"))
    assert main(["make", *words]) == 2
    err = capfd.readouterr().err
    assert err.startswith("error: ") and err.count("\n") == 1
    assert sorted(tmp_path.rglob("*")) == before


def test_several_faces_are_told_and_another_can_be_had(here, photo, capfd) -> None:
    wide = np.concatenate([photo, photo[::-1, ::-1], photo], axis=1)
    wide[:, 256:512] = 128
    write_image(wide, "us.png")
    assert main(["points", "us.png", "-o", "a.json"]) == 0
    note = capfd.readouterr().err.splitlines()[0]
    assert note.startswith("note: 2 faces found, took the largest")
    assert "--face 2" in note
    assert main(["points", "us.png", "-o", "b.json", "--face", "2", "-q"]) == 0
    assert capfd.readouterr().err == ""
    noses = [FeaturePoints.load(f).positions["nose_tip"][0] for f in ("a.json", "b.json")]
    assert abs(noses[0] - noses[1]) > 400
    assert main(["points", "us.png", "-o", "c.json", "--face", "3"]) == 2
    assert "from 1 to 2" in capfd.readouterr().err
    assert not Path("c.json").exists()


def test_a_photo_without_a_face_is_one_line(here, capfd) -> None:
    write_image(np.full((200, 300, 3), 90, np.uint8), "wall.png")
    assert main(["make", "wall.png", "-o", "wall.glb"]) == 2
    err = capfd.readouterr().err
    assert err.startswith("error: no face was found in wall.png")
    assert err.count("\n") == 1
    assert not Path("wall.glb").exists()


def test_a_poor_photo_is_warned_of(here, photo, capfd) -> None:
    write_image(photo, "small.png")
    assert main(["points", "small.png", "-o", "small.json"]) == 0
    assert capfd.readouterr().err.startswith("warning: the face is small")


def network_cut_off() -> list[str]:
    """The words that run a command without any network, where the system lets us."""
    words = ["unshare", "--map-root-user", "--net"]
    if shutil.which("unshare") is None:
        return []
    tried = subprocess.run([*words, "true"], capture_output=True, check=False)
    return [] if tried.returncode else words


def test_make_asks_for_no_network(here) -> None:
    command = [*network_cut_off(), sys.executable, "-c", WATCHED]
    result = subprocess.run(
        [*command, "make", "me.png", "-o", "me.glb"],
        capture_output=True, text=True, check=False, env=os.environ,
    )  # fmt: skip
    assert result.returncode == 0, result.stderr
    assert Path("me.glb").stat().st_size > 0


def test_the_watch_on_the_network_sees(here) -> None:
    """Without a model, the same watch catches the attempt to fetch one."""
    pytest.importorskip("pooch")
    environment = {n: v for n, v in os.environ.items() if n != "PDEFACE_MODEL"}
    environment |= {"XDG_CACHE_HOME": str(here), "HOME": str(here)}
    result = subprocess.run(
        [sys.executable, "-c", WATCHED, "make", "me.png", "-o", "me.glb"],
        capture_output=True, text=True, check=False, env=environment,
    )  # fmt: skip
    assert "AssertionError: [('socket." in result.stderr


def test_the_bundled_portrait_needs_neither_model_nor_mediapipe(tmp_path) -> None:
    program = """
import sys
sys.modules["mediapipe"] = sys.modules["pooch"] = None
from pdeface.__main__ import main
sys.exit(main(["make", "-o", sys.argv[1], "-q"]))
"""
    out = tmp_path / "a.pdeface"
    environment = os.environ | {"PDEFACE_MODEL": str(tmp_path / "nowhere")}
    result = subprocess.run(
        [sys.executable, "-c", program, out], capture_output=True, check=False, env=environment
    )
    assert (result.returncode, result.stderr) == (0, b"")
    assert out.stat().st_size > 0
