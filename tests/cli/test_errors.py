"""Bad input is one line on stderr and status 2; nothing ever shows a traceback by itself."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest

import pdeface

HUGE = "99999999x99999999"
WRONG_USE = [
    ["nonsense"],
    ["--nonsense"],
    ["export"],
    ["export", "BUST"],
    ["export", "BUST", "-o"],
    ["export", "BUST", "-o", "a.xyz"],
    ["export", "BUST", "-o", "a"],
    ["export", "BUST", "-o", "a.png"],
    ["export", "BUST", "-o", "."],
    ["export", "BUST", "-o", "BUST/a.glb"],
    ["export", "BUST", "-o", "a.glb", "--join", "sewn"],
    ["export", "BUST", "-o", "a.glb", "--quads"],
    ["export", "missing.pdeface", "-o", "a.glb"],
    ["export", ".", "-o", "a.glb"],
    *(
        ["export", "BUST", "-o", "a.glb", "--mesh", mesh]
        for mesh in ("0x5", "1x1", "3x", "x3", "", "-3x4", "3 x 4", "axb", "28", "2x2x2", HUGE)
    ),
    *(
        ["export", "BUST", "-o", "a.glb", "--set", value]
        for value in (
            *("jawOpen", "jawOpen=", "=1", "", "jawOpen=wide", "jawOpen=nan", "jawOpen=inf"),
            *("jawOpen=1.01", "jawOpn=1", "jawOpen=1,,", "jawOpen=1;eyeBlinkLeft=1"),
            *("jawOpen=1", "identity01=-4"),  # a bust of 7 curves has no lips to part
        )
    ),
    ["export", "BUST", "-o", "a.pdeface", "--set", "jawOpen=1"],
    ["export", "BUST", "-o", "a.glb", "--clamp", "--set", "jawOpn=1"],
    ["export", "BUST", "-o", "a.glb", "--expressions", "all"],
    ["export", "BUST", "-o", "a.glb", "--expressions", "jawOpn"],
    ["make", "-o", "a.glb", "--expressions", "tongueUp"],
    ["make", "-o", "a.glb", "--expressions", "jawOpen,"],
    ["make", "-o", "a.obj", "--expressions", "all"],
    ["make", "-o", "a.glb", "--set", "noseLenght=1"],
    ["make", "-o", "a.glb", "--random", "-1"],
    ["make", "-o", "a.glb", "--random", "someone"],
    ["controls", "missing.pdeface"],
    ["controls", "TEXT"],
    ["controls", "--kind", "mood"],
    ["render", "BUST", "-o", "a.png", "--set", "jawOpn=1"],
    ["render", "BUST"],
    ["render", "BUST", "-o", "a.glb"],
    ["render", "BUST", "-o", "a.png", "--view", "upside-down"],
    ["render", "BUST", "-o", "a.png", "--view", "nan"],
    ["render", "BUST", "-o", "a.png", "--style", "cubist"],
    ["render", "BUST", "-o", "a.png", "--light", "none"],
    ["render", "BUST", "-o", "a.png", "--background", "nosuchcolour"],
    ["render", "BUST", "-o", "a.jpg", "--transparent"],
    *(
        ["render", "BUST", "-o", "a.png", "--size", size]
        for size in ("0x0", "800", "100x", "-1x5", HUGE)
    ),
    ["info"],
    ["info", "missing.pdeface"],
    ["info", "."],
    ["info", "TEXT"],
    ["info", "EMPTY"],
    ["make"],
    ["make", "-o", "a.xyz"],
    ["make", "-o", "a.glb", "--level", "3x4"],
    ["make", "-o", "a.glb", "--level", "fine"],
    ["make", "photo.jpg", "-o", "a.glb"],
    ["make", "-o", "a.glb", "--points", "points.json"],
    ["make", "missing.jpg", "--points", "TEXT", "-o", "a.glb"],
    ["make", "TEXT", "--points", "TEXT", "-o", "a.glb"],
    ["make", "-o", "a.glb", "-o", "b.xyz"],
    ["paper"],
    ["paper", "-o", "TEXT"],
]


@pytest.fixture
def here(bust_file: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "text").write_text("not a face\n")
    (tmp_path / "empty").touch()
    return tmp_path


@pytest.mark.parametrize("words", WRONG_USE, ids=" ".join)
def test_bad_input_is_one_line_and_status_2(here, pdeface_command, words) -> None:
    before = sorted(here.iterdir())
    places = {"BUST": "bust.pdeface", "TEXT": "text", "EMPTY": "empty"}
    for name, place in places.items():
        words = [word.replace(name, place) for word in words]
    outcome = pdeface_command(*words)
    assert outcome.status == 2
    assert outcome.err.startswith("error: ")
    assert outcome.err.count("\n") == 1
    assert outcome.out == ""
    assert sorted(here.iterdir()) == before


def test_the_nearest_names_are_offered(here, pdeface_command) -> None:
    for option in ("--set", "--expressions"):
        word = "jawOpn=1" if option == "--set" else "jawOpn"
        outcome = pdeface_command("make", "-o", "a.glb", option, word)
        assert "did you mean jawOpen" in outcome.err


@pytest.mark.parametrize("text", ["", "PK\x03\x04", "{}", "\x00" * 100])
def test_a_damaged_face_is_named(here, pdeface_command, text) -> None:
    (here / "damaged.pdeface").write_text(text)
    outcome = pdeface_command("info", "damaged.pdeface")
    assert outcome.status == 2
    assert "damaged.pdeface" in outcome.err


def test_an_input_is_never_overwritten(here, pdeface_command) -> None:
    before = (here / "bust.pdeface").read_bytes()
    os.link(here / "bust.pdeface", here / "alias.pdeface")
    for out in ("bust.pdeface", "./bust.pdeface", here / "bust.pdeface", "alias.pdeface"):
        outcome = pdeface_command("export", "bust.pdeface", "-o", out)
        assert outcome.status == 2
        assert "would replace the input" in outcome.err
    assert (here / "bust.pdeface").read_bytes() == before


def test_a_photo_is_not_overwritten_by_the_texture_beside_an_obj(here, pdeface_command) -> None:
    photo = here / "my_face-texture.png"
    photo.write_bytes(b"a photo")
    outcome = pdeface_command("make", photo, "--points", "text", "-o", here / "my face.obj")
    assert outcome.status == 2
    assert "would replace the input" in outcome.err
    assert photo.read_bytes() == b"a photo"


def raising(error: BaseException):
    def load(path: object) -> None:
        raise error

    return load


def test_an_unexpected_error_is_one_line_and_status_1(here, pdeface_command, monkeypatch) -> None:
    monkeypatch.setattr(pdeface, "load", raising(ZeroDivisionError("two\nlines")))
    outcome = pdeface_command("info", "bust.pdeface")
    assert outcome.status == 1
    assert outcome.err.startswith("error: unexpected ZeroDivisionError: two lines")
    assert outcome.err.count("\n") == 1


def test_debug_shows_where(here, pdeface_command, monkeypatch) -> None:
    monkeypatch.setattr(pdeface, "load", raising(ZeroDivisionError("nought")))
    with pytest.raises(ZeroDivisionError, match="nought"):
        pdeface_command("--debug", "info", "bust.pdeface")


@pytest.mark.parametrize("words", [["info"], ["--debug", "info"]])
def test_an_interrupt_is_status_130_and_says_nothing(
    here, pdeface_command, monkeypatch, words
) -> None:
    monkeypatch.setattr(pdeface, "load", raising(KeyboardInterrupt()))
    outcome = pdeface_command(*words, "bust.pdeface")
    assert (outcome.status, outcome.out, outcome.err) == (130, "", "")


@pytest.mark.skipif(sys.platform == "win32", reason="signals are POSIX's")
def test_control_c_in_the_middle_of_work(here) -> None:
    """A real signal in a real process, once it says that it is at work."""
    program = """
import sys, time
import pdeface.cli.app as app, pdeface

def load(path):
    print("at work", flush=True)
    time.sleep(60)

pdeface.load = load
sys.exit(app.run(["info", "bust.pdeface"]))
"""
    process = subprocess.Popen(
        [sys.executable, "-c", program],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        # A shell that runs the tests in the background has its children ignore the signal.
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),
    )
    assert process.stdout is not None
    assert process.stdout.readline() == "at work\n"
    process.send_signal(signal.SIGINT)
    out, err = process.communicate(timeout=30)
    assert (process.returncode, out, err) == (130, "", "")


@pytest.mark.skipif(sys.platform == "win32", reason="pipes are POSIX's")
def test_a_reader_that_had_enough_is_no_error(here) -> None:
    read, write = os.pipe()
    os.close(read)
    result = subprocess.run(
        [sys.executable, "-m", "pdeface", "info", "bust.pdeface"],
        stdout=write,
        stderr=subprocess.PIPE,
        text=True,
        check=False,
    )
    os.close(write)
    assert result.stderr == ""
    assert result.returncode == 1
