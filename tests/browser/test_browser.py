"""Exported files in a real browser: three.js finds every target, and pixels move."""

from __future__ import annotations

import json
import os
import shutil
import struct
import subprocess
from pathlib import Path
from typing import Any

import pytest

import pdeface
from pdeface.__main__ import main

HERE = Path(__file__).parent
PROGRAMS = ("chromium", "chromium-browser", "google-chrome")

# The tongue is seen only where the mouth is open.
BEFORE = {"tongueOut": {"jawOpen": 1.0}}

# Of 512 x 640 pixels, in which the face fills a half; the smallest expression changes 586.
FEWEST = 100

# Frames of the recording, and the one with the left eye shut.
FRAMES, SHUT = 5, 2


def missing() -> str | None:
    """What is not there to run a browser, and how to get it."""
    if shutil.which("node") is None:
        return "Node.js is not installed"
    if not all((HERE / "node_modules" / name).is_dir() for name in ("three", "playwright-core")):
        return "three.js is not installed; run: npm ci --prefix tests/browser"
    if not any(map(shutil.which, PROGRAMS)):
        return f"no browser is installed; one of {', '.join(PROGRAMS)} is needed"
    return None


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A face that can make every expression, and a recording of a blink played by it."""
    folder = tmp_path_factory.mktemp("browser")
    face = pdeface.neutral()
    pdeface.export(face, folder / "face.glb", mesh=(28, 41))
    face.save(folder / "face.pdeface")
    codes = [f"00:00:01:{frame:02d}.000,61,{float(frame == SHUT)}" for frame in range(FRAMES)]
    lines = ["Timecode,BlendshapeCount,EyeBlinkLeft", *codes]
    (folder / "take.csv").write_text("\n".join(lines) + "\n", encoding="utf-8")
    source, out = [str(folder / name) for name in ("face.pdeface", "take.csv")], folder / "take.glb"
    words = ["animate", *source, "-o", str(out), "--mesh", "28x41", "--fps", "60", "--quiet"]
    assert main(words) == 0
    (folder / "before.json").write_text(json.dumps(BEFORE), encoding="utf-8")
    return folder


@pytest.fixture(scope="module")
def report(folder: Path) -> dict[str, Any]:
    """What the one start of the browser found."""
    if reason := missing():
        if os.environ.get("CI", "").lower() == "true":
            pytest.fail(reason)
        pytest.skip(reason)
    browser = next(filter(None, map(shutil.which, PROGRAMS)))
    command = ["node", str(HERE / "check.mjs"), browser, str(folder)]
    answer = subprocess.run(command, capture_output=True, text=True, check=False, timeout=300)
    assert answer.returncode == 0, answer.stderr
    found: dict[str, Any] = json.loads(answer.stdout)
    return found


def mesh_of(path: Path) -> dict[str, Any]:
    data = path.read_bytes()
    (length,) = struct.unpack_from("<I", data, 12)
    (mesh,) = json.loads(data[20 : 20 + length])["meshes"]
    return mesh


def test_nothing_is_complained_of_and_nothing_asked_of_the_network(report) -> None:
    assert report["complaints"] == []


def test_every_primitive_has_every_target_by_its_name(report, folder: Path) -> None:
    mesh = mesh_of(folder / "face.glb")
    names, primitives = mesh["extras"]["targetNames"], len(mesh["primitives"])
    assert len(names) > 50
    assert report["targets"]["names"] == [names] * primitives
    assert report["targets"]["influences"] == [len(names)] * primitives


def test_every_target_is_seen(report) -> None:
    targets = report["targets"]
    assert targets["size"] > 100_000
    assert targets["back"] == 0
    unseen = {name: count for name, count in targets["changes"].items() if count < FEWEST}
    assert targets["changes"]
    assert unseen == {}


def test_a_recorded_blink_is_seen_at_its_eye_and_its_frame_alone(report) -> None:
    take = report["take"]
    assert take["times"] == pytest.approx([frame / 60 for frame in range(FRAMES)], abs=1e-6)
    assert take["left"][SHUT] > 1000
    assert take["right"][SHUT] < 0.05 * take["left"][SHUT]
    assert [count for frame, count in enumerate(take["all"]) if frame != SHUT] == [0] * 4
