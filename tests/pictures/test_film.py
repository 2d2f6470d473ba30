"""Films, decoded by the ffmpeg that wrote them and compared with pictures."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import pdeface
from pdeface.controls.neck import PIVOT, rotations
from pdeface.errors import InputError, MissingExtraError
from pdeface.face import Face
from pdeface.motion import Frames, clip
from pdeface.pictures import film
from pdeface.pictures.encoder import Encoder
from pdeface.pictures.filming import _reach

SIZE = (96, 120)
STILL = np.zeros(3)


def decoded(ffmpeg: str, path: Path, size: tuple[int, int] = SIZE) -> np.ndarray:
    """(T, H, W, 3) the film's frames."""
    command = [ffmpeg, "-loglevel", "error", "-i", str(path), "-f", "rawvideo"]
    raw = subprocess.run(
        [*command, "-pix_fmt", "rgb24", "pipe:1"], capture_output=True, check=True
    ).stdout
    return np.frombuffer(raw, np.uint8).reshape(-1, size[1], size[0], 3)


def told(ffmpeg: str, path: Path) -> str:
    """What ffmpeg says of the film's picture stream."""
    text = subprocess.run([ffmpeg, "-i", str(path)], capture_output=True, check=False).stderr
    return next(line for line in text.decode().split("\n") if "Video:" in line)


def redness_at(image: np.ndarray) -> float:
    """Mean column of what is red, as a share of the width."""
    image = image.astype(float)
    red = image[..., 0] - image[..., 2] > 90
    return float(np.nonzero(red)[1].mean()) / image.shape[1]


def test_every_frame_is_a_picture_of_its_face(ffmpeg: str, tmp_path: Path) -> None:
    frames = Frames(pdeface.random(1), clip("smile"), rate=2)
    film(frames, tmp_path / "a.mp4", rate=2, size=SIZE, mesh=(28, 41), background="white")
    pictures = decoded(ffmpeg, tmp_path / "a.mp4")
    assert len(pictures) == len(frames) == 8
    smiles = [face.weights.get("mouthSmileLeft", 0.0) for face, _ in frames]
    rest, widest = pictures[0].astype(float), pictures[int(np.argmax(smiles))].astype(float)
    assert np.abs(widest - rest).max() > 40, "the smile is seen"
    # A lossy film is judged by its mean: at an edge one pixel may be off by many levels.
    smile, left = (np.abs(image - rest).mean() for image in (widest, pictures[-1]))
    assert left < 0.1 * smile, "and gone in the end, but for the coding"
    assert (pictures[:, :4, :4] > 250).all(), "the background is as asked for"


def test_what_is_said_of_it_is_what_players_need(ffmpeg: str, painted: Face, tmp_path) -> None:
    film([(painted, STILL)] * 3, tmp_path / "A.MP4", rate=29.97, size=SIZE, mesh=(9, 11))
    line = told(ffmpeg, tmp_path / "A.MP4")
    assert re.search(r"h264 .*yuv420p\(tv, bt709.* 96x120.* 29\.97 fps", line)
    data = (tmp_path / "A.MP4").read_bytes()
    assert data.index(b"moov") < data.index(b"mdat"), "it plays before all of it has come"


def test_the_head_turns_before_a_camera_that_stands(ffmpeg: str, painted: Face, tmp_path) -> None:
    frames = [(painted, np.array([yaw, 0.0, 0.0])) for yaw in (0.0, 0.6, -0.6)]
    film(frames, tmp_path / "a.mp4", size=SIZE, mesh=(28, 41))
    ahead, left, right = (redness_at(image) for image in decoded(ffmpeg, tmp_path / "a.mp4"))
    # The red cheek is the subject's left one, which turns away as the head turns to the left.
    assert right < ahead < left


def test_the_face_stays_in_the_picture(ffmpeg: str, head: Face, tmp_path: Path) -> None:
    angles = [(0.0, 0.0, 0.0), (0.8, 0.4, 0.5), (-0.8, -0.4, -0.5)]
    film(
        [(head, np.array(a)) for a in angles],
        tmp_path / "a.mp4", size=SIZE, mesh=(28, 41), background="white",
    )  # fmt: skip
    for image in decoded(ffmpeg, tmp_path / "a.mp4"):
        edge = [image[:2], image[-2:], image[:, :2].swapaxes(0, 1), image[:, -2:].swapaxes(0, 1)]
        assert min(part.min() for part in edge) > 240
        assert (image < 200).any()


def test_what_reaches_farthest_is_found(head: Face) -> None:
    frames = [(head, np.array([yaw, 0.0, 0.0])) for yaw in (0.0, 1.0, -0.5)]
    reached = _reach(frames)
    every = np.concatenate(
        [face.mesh().turned(rotations(angles), PIVOT).vertices for face, angles in frames]
    )
    directions = np.random.default_rng(0).normal(size=(50, 3))
    directions /= np.linalg.norm(directions, axis=1, keepdims=True)
    missed = (every @ directions.T).max(axis=0) - (reached @ directions.T).max(axis=0)
    assert missed.min() >= 0.0
    assert missed.max() < 0.003


def test_progress_counts_from_one(ffmpeg: str, painted: Face, tmp_path: Path) -> None:
    seen: list[int] = []
    frames = [(painted, STILL)] * 3
    film(frames, tmp_path / "a.mp4", size=(16, 16), mesh=(9, 11), progress=seen.append)
    assert seen == [1, 2, 3]


@pytest.mark.parametrize(
    ("name", "change", "message"),
    [
        ("a.avi", {}, "written as .mp4, got 'a.avi'"),
        ("a", {}, "written as .mp4, got 'a'"),
        ("a.mp4", {"frames": []}, "a frame at least, got none"),
        ("a.mp4", {"size": (97, 120)}, "even and 16 or more, got 97x120"),
        ("a.mp4", {"size": (8, 8)}, "even and 16 or more, got 8x8"),
        ("a.mp4", {"size": (0, 8)}, "whole numbers from 1"),
        ("a.mp4", {"rate": 0.0}, "more than 0 and at most 240 frames a second, got 0"),
        ("a.mp4", {"rate": float("nan")}, "got nan"),
        ("a.mp4", {"rate": 1000.0}, "got 1000"),
        ("a.mp4", {"style": "curves"}, "style of a film is one of textured, shaded, uvmesh"),
        ("a.mp4", {"style": "cubist"}, "style is one of"),
        ("a.mp4", {"view": "upside-down"}, "a view is a name"),
        ("a.mp4", {"light": "none"}, "light"),
        ("no/a.mp4", {}, "does not exist"),
    ],
)
def test_bad_input_leaves_nothing(ffmpeg: str, painted, tmp_path, name, change, message) -> None:
    wanted = {"frames": [(painted, STILL)], "size": SIZE, "mesh": (9, 11), **change}
    with pytest.raises(InputError, match=message):
        film(wanted.pop("frames"), tmp_path / name, **wanted)
    assert list(tmp_path.iterdir()) == []


def test_a_film_that_fails_midway_leaves_the_old_one(ffmpeg: str, painted, tmp_path) -> None:
    (tmp_path / "a.mp4").write_bytes(b"old")

    def stop(number: int) -> None:
        if number == 3:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        film([(painted, STILL)] * 5, tmp_path / "a.mp4", size=SIZE, mesh=(9, 11), progress=stop)
    assert [(p.name, p.read_bytes()) for p in tmp_path.iterdir()] == [("a.mp4", b"old")]


@pytest.mark.parametrize("count", [1, 500])
def test_what_ffmpeg_cannot_write_is_said_in_its_words(ffmpeg: str, tmp_path, count: int) -> None:
    """At once or, for few pictures, when it ends."""
    image = np.zeros((16, 16, 3), np.uint8)
    with (
        pytest.raises(InputError, match="ffmpeg cannot write the film: .*No such file"),
        Encoder(tmp_path / "no" / "a.mp4", (16, 16), 30.0) as encoder,
    ):
        for number in range(count):
            encoder.add(image, number)


def test_without_the_extra_it_is_named(painted, tmp_path, monkeypatch) -> None:
    monkeypatch.setitem(sys.modules, "imageio_ffmpeg", None)
    with pytest.raises(MissingExtraError, match=r"to write films .*'pdeface\[video\]'"):
        film([(painted, STILL)], tmp_path / "a.mp4", size=SIZE)
    assert list(tmp_path.iterdir()) == []
