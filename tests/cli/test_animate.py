"""``pdeface animate``: recordings and clips as animations of a file."""

from __future__ import annotations

import json
import struct
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import pdeface
from pdeface.controls.neck import PIVOT, rotations
from pdeface.motion import CLIPS, Track, clip, write

# Five frames at 60 a second; the third is the one with the eyes shut.
FRAMES = [f"14:25:36:{20 + n}.000" for n in range(5)]
SHUT = 2


@pytest.fixture
def face_file(tmp_path: Path) -> Path:
    path = tmp_path / "someone.pdeface"
    pdeface.random(1).save(path)
    return path


@pytest.fixture
def blink_file(tmp_path: Path) -> Path:
    """A recording of a blink of the left eye with a turn of the head."""
    path = tmp_path / "take.csv"
    titles = "Timecode,BlendshapeCount,EyeBlinkLeft,TongueOut,HeadYaw,Mood"
    rows = [
        f"{code},61,{1.0 if frame == SHUT else 0.1},0.5,{0.1 * frame},7"
        for frame, code in enumerate(FRAMES)
    ]
    path.write_text("\n".join([titles, *rows]) + "\n", encoding="utf-8")
    return path


def played(path: Path) -> tuple[str, np.ndarray, dict[str, np.ndarray]]:
    """Name of the animation, its times, and at these the weights by name and the rotation."""
    data = path.read_bytes()
    (length,) = struct.unpack_from("<I", data, 12)
    document: dict[str, Any] = json.loads(data[20 : 20 + length])
    body = data[28 + length :]
    (animation,) = document["animations"]

    def values(index: int) -> np.ndarray:
        accessor = document["accessors"][index]
        start = document["bufferViews"][accessor["bufferView"]]["byteOffset"]
        size = {"SCALAR": 1, "VEC4": 4}[accessor["type"]]
        return np.frombuffer(body, "<f4", size * accessor["count"], start)

    (shared,) = {sampler["input"] for sampler in animation["samplers"]}
    times = values(shared)
    found: dict[str, np.ndarray] = {}
    for channel in animation["channels"]:
        table = values(animation["samplers"][channel["sampler"]]["output"])
        table = table.reshape(len(times), -1)
        if channel["target"]["path"] == "weights":
            names = document["meshes"][0]["extras"]["targetNames"]
            found.update(zip(names, table.T, strict=True))
        else:
            found["rotation"] = table
    return animation["name"], times, found


def test_a_blink_of_a_recording_closes_the_eye_at_its_frame(
    pdeface_command, face_file, blink_file, tmp_path
) -> None:
    out = tmp_path / "take.glb"
    outcome = pdeface_command("animate", face_file, blink_file, "-o", out, "--fps", "60")
    assert (outcome.status, outcome.out.startswith(f"wrote {out}")) == (0, True)
    name, times, found = played(out)
    assert name == "take"
    np.testing.assert_allclose(times, np.arange(5) / 60.0, atol=1e-7)
    np.testing.assert_allclose(found["eyeBlinkLeft"], [0.1, 0.1, 1.0, 0.1, 0.1], atol=1e-7)
    assert not found["eyeBlinkRight"].any()
    half = 0.05 * np.arange(5)
    zero = np.zeros(5)
    truth = np.stack([zero, np.sin(half), zero, np.cos(half)], axis=1)
    np.testing.assert_allclose(found["rotation"], truth, atol=1e-7)


def test_what_is_lost_is_said_once_each(pdeface_command, face_file, blink_file, tmp_path) -> None:
    words = ["animate", face_file, blink_file, "-o", tmp_path / "a.glb", "--fps", "60"]
    lines = pdeface_command(*words).err.splitlines()
    assert all(line.startswith("note: ") for line in lines)
    (missing,) = (line for line in lines if "not in the motion, and so 0" in line)
    assert missing.endswith("more")
    assert next(line for line in lines if "ignored" in line).endswith(": Mood")
    assert not any("left out" in line for line in lines)
    quiet = pdeface_command(*words, "--quiet")
    assert (quiet.status, quiet.out, quiet.err) == (0, "", "")


@pytest.mark.parametrize("name", CLIPS)
def test_a_clip_plays_as_it_is(pdeface_command, face_file, tmp_path, name: str) -> None:
    out, track = tmp_path / "a.glb", clip(name, 30)
    words = ["animate", face_file, name, "-o", out, "--mesh", "9x11", "--fps", "30"]
    assert pdeface_command(*words).status == 0
    title, times, found = played(out)
    assert title == name
    np.testing.assert_allclose(times, track.times, atol=1e-6)
    for column, each in enumerate(track.names):
        np.testing.assert_allclose(found[each], track.weights[:, column], atol=1e-7)
    assert ("rotation" in found) == track.head.any()


@pytest.mark.parametrize("suffix", ["json", "npz"])
def test_a_track_and_some_expressions(pdeface_command, tmp_path, suffix: str) -> None:
    pdeface.neutral().set(jawOpen=0.5, mouthPucker=0.2).save(tmp_path / "f.pdeface")
    track = Track([0.0, 1.0], ("eyeBlinkLeft", "jawOpen"), [[0.0, 0.0], [1.0, 0.5]])
    write(track, tmp_path / f"nod.{suffix}")
    out = tmp_path / "a.glb"
    outcome = pdeface_command(
        "animate", tmp_path / "f.pdeface", tmp_path / f"nod.{suffix}", "-o", out,
        "--expressions", "mouthPucker,eyeBlinkLeft",
    )  # fmt: skip
    assert outcome.status == 0
    assert outcome.err.splitlines() == [
        "note: in the motion, but no expression of the file and left out: jawOpen"
    ]
    _, _, found = played(out)
    assert list(found) == ["mouthPucker", "eyeBlinkLeft"]
    np.testing.assert_allclose(found["mouthPucker"], [0.2, 0.2], atol=1e-7)


def test_clamp_and_degrees(pdeface_command, face_file, tmp_path) -> None:
    path, out = tmp_path / "loud.csv", tmp_path / "a.glb"
    rows = [f"{code},61,1.5,{90 * (n == 1)}" for n, code in enumerate(FRAMES)]
    path.write_text("\n".join(["Timecode,BlendshapeCount,JawOpen,HeadYaw", *rows]) + "\n")
    words = ["animate", face_file, path, "-o", out, "--fps", "60", "--mesh", "9x11"]
    assert pdeface_command(*words, "--degrees").status == 2
    assert pdeface_command(*words, "--clamp").status == 2
    assert not out.exists()
    assert pdeface_command(*words, "--clamp", "--degrees").status == 0
    _, _, found = played(out)
    np.testing.assert_array_equal(found["jawOpen"], 1.0)
    np.testing.assert_allclose(found["rotation"][1], [0, 0.5**0.5, 0, 0.5**0.5], atol=1e-7)


@pytest.mark.parametrize(("options", "skipped"), [([], 0), (["--drop-frame"], 2)])
def test_drop_frame_timecode_skips_two_numbers_a_minute(
    pdeface_command, face_file, tmp_path, options, skipped: int
) -> None:
    path, out = tmp_path / "take.csv", tmp_path / "a.glb"
    codes = ["00:00:59:28", "00:00:59:29", "00:01:00:02"]
    rows = [f"{code},61,0.5" for code in codes]
    path.write_text("\n".join(["Timecode,BlendshapeCount,JawOpen", *rows]) + "\n")
    words = ["animate", face_file, path, "-o", out, "--fps", "29.97", "--mesh", "9x11", *options]
    assert pdeface_command(*words).status == 0
    _, times, _ = played(out)
    frames = np.array([0, 1, 4 - skipped])
    np.testing.assert_allclose(times, frames * 1001 / 30000, rtol=0.002)


@pytest.mark.parametrize(
    ("motion", "out", "options", "message"),
    [
        ("blnk", "a.glb", [], "or a clip (blink, smile, look, talk), got 'blnk'"),
        ("none.csv", "a.glb", [], "none.csv"),
        ("blink", "a.vrm", [], "must be one of .glb, .gltf, .mp4, .obj"),
        ("blink", "a.glb", ["--rate", "24"], "keeps the times of the motion"),
        ("blink", "a.glb", ["--view", "front"], "--view is for a film"),
        ("blink", "a.obj", ["--style", "shaded"], "--style is for a film"),
        ("blink", "a.obj", ["--rate", "0"], "more than 0 frames a second"),
        ("blink", "a.obj", ["--expressions", "jawOpen"], "--expressions needs an output"),
        ("blink", "a.mp4", ["--size", "99"], "--size needs WIDTHxHEIGHT"),
        ("blink", "a.mp4", ["--size", "101x100"], "even"),
        ("blink", "a.mp4", ["--style", "curves"], "style of a film"),
        ("blink", "a.mp4", ["--rate", "nan"], "a finite number"),
        ("blink", "a.glb", ["--degrees"], "are for a .csv, got the clip 'blink'"),
        ("blink", "a.glb", ["--drop-frame"], "are for a .csv, got the clip 'blink'"),
        ("blink", "a.glb", ["--fps", "0"], "more than 0 frames a second"),
        ("blink", "a.glb", ["--mesh", "1x1"], "--mesh needs at least 2 rows"),
        ("blink", "a.glb", ["--expressions", "jawOpn"], "did you mean jawOpen"),
        ("blink", "a.glb", ["--expressions", "none"], "moves nothing that the file has"),
    ],
)
def test_bad_input_is_one_line(
    pdeface_command, face_file, tmp_path, monkeypatch, motion, out, options, message
) -> None:
    monkeypatch.chdir(tmp_path)
    outcome = pdeface_command("animate", face_file, motion, "-o", out, *options)
    assert (outcome.status, outcome.out) == (2, "")
    (line,) = outcome.err.splitlines()
    assert line.startswith("error: ")
    assert message in line
    assert not Path(out).exists()


def test_a_mesh_for_each_frame(pdeface_command, face_file, blink_file, tmp_path) -> None:
    out = tmp_path / "new" / "face.obj"
    words = ["animate", face_file, blink_file, "-o", out, "--fps", "60", "--rate", "60"]
    outcome = pdeface_command(*words, "--mesh", "28x41")
    assert outcome.status == 0
    assert outcome.out.startswith(f"wrote {out.with_name('face.0001.obj')} to face.0005.obj (5 ")

    def vertices(number: int) -> np.ndarray:
        text = out.with_name(f"face.{number:04d}.obj").read_text(encoding="utf-8")
        rows = [line.split()[1:] for line in text.splitlines() if line.startswith("v ")]
        return np.array(rows, dtype=float)

    shut = pdeface.random(1).set(eyeBlinkLeft=1.0).mesh(28, 41)
    truth = shut.turned(rotations(np.array([0.1 * SHUT, 0.0, 0.0])), PIVOT)
    np.testing.assert_allclose(vertices(SHUT + 1), truth.vertices, atol=1e-7)
    assert not (out.parent / "face.obj").exists()


def test_a_film(pdeface_command, ffmpeg, face_file, tmp_path) -> None:
    out = tmp_path / "a.mp4"
    words = ["animate", face_file, "blink", "-o", out, "--rate", "4", "--mesh", "28x41"]
    outcome = pdeface_command(*words, "--size", "64x80", "--view", "35", "--style", "uvmesh")
    assert (outcome.status, outcome.out.startswith(f"wrote {out}")) == (0, True)
    assert out.read_bytes()[4:8] == b"ftyp"


def test_a_film_without_its_extra_names_it(
    pdeface_command, face_file, tmp_path, monkeypatch
) -> None:
    monkeypatch.setitem(sys.modules, "imageio_ffmpeg", None)
    outcome = pdeface_command("animate", face_file, "blink", "-o", tmp_path / "a.mp4")
    assert outcome.status == 1
    assert "pip install 'pdeface[video]'" in outcome.err
    assert not (tmp_path / "a.mp4").exists()


def test_a_truncated_row_is_named_and_nothing_is_written(
    pdeface_command, face_file, blink_file, tmp_path
) -> None:
    text = blink_file.read_text(encoding="utf-8").splitlines()
    blink_file.write_text("\n".join([*text[:3], text[3][:20]]) + "\n", encoding="utf-8")
    outcome = pdeface_command("animate", face_file, blink_file, "-o", tmp_path / "a.glb")
    assert outcome.status == 2
    assert "row 4" in outcome.err
    assert not (tmp_path / "a.glb").exists()
