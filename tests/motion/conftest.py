"""Recordings as the app writes them, and tracks of any kind."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from pathlib import Path

import pytest

# The app's own first line, letter for letter; JawRight comes before JawLeft, MouthRight likewise.
HEADER = (
    "Timecode,BlendshapeCount,EyeBlinkLeft,EyeLookDownLeft,EyeLookInLeft,EyeLookOutLeft,"
    "EyeLookUpLeft,EyeSquintLeft,EyeWideLeft,EyeBlinkRight,EyeLookDownRight,EyeLookInRight,"
    "EyeLookOutRight,EyeLookUpRight,EyeSquintRight,EyeWideRight,JawForward,JawRight,JawLeft,"
    "JawOpen,MouthClose,MouthFunnel,MouthPucker,MouthRight,MouthLeft,MouthSmileLeft,"
    "MouthSmileRight,MouthFrownLeft,MouthFrownRight,MouthDimpleLeft,MouthDimpleRight,"
    "MouthStretchLeft,MouthStretchRight,MouthRollLower,MouthRollUpper,MouthShrugLower,"
    "MouthShrugUpper,MouthPressLeft,MouthPressRight,MouthLowerDownLeft,MouthLowerDownRight,"
    "MouthUpperUpLeft,MouthUpperUpRight,BrowDownLeft,BrowDownRight,BrowInnerUp,BrowOuterUpLeft,"
    "BrowOuterUpRight,CheekPuff,CheekSquintLeft,CheekSquintRight,NoseSneerLeft,NoseSneerRight,"
    "TongueOut,HeadYaw,HeadPitch,HeadRoll,LeftEyeYaw,LeftEyePitch,LeftEyeRoll,RightEyeYaw,"
    "RightEyePitch,RightEyeRoll"
)

Recording = Callable[..., Path]


def lines(
    timecodes: Iterable[str], columns: Sequence[str] = (), values: Iterable[dict[str, float]] = ()
) -> list[str]:
    """The lines of a recording; a value that is not given is 0."""
    titles = list(columns) or HEADER.split(",")
    rows = list(values)
    made = [",".join(titles)]
    for place, code in enumerate(timecodes):
        known = {"Timecode": code, "BlendshapeCount": "61"}
        given = rows[place] if place < len(rows) else {}
        cells = [known.get(title, f"{given.get(title, 0.0):.10f}") for title in titles]
        made.append(",".join(cells))
    return made


@pytest.fixture(scope="session")
def header() -> list[str]:
    return HEADER.split(",")


@pytest.fixture(scope="session")
def recorded() -> Callable[..., list[str]]:
    """Makes the lines of a recording."""
    return lines


@pytest.fixture
def recording(tmp_path: Path) -> Recording:
    """Writes lines to a CSV file and gives its path."""

    def write(rows: Sequence[str], ending: str = "\n", encoding: str = "utf-8") -> Path:
        path = tmp_path / "take.csv"
        path.write_bytes((ending.join(rows) + ending).encode(encoding))
        return path

    return write
