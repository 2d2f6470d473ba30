"""Options that several commands share: how they are declared, read and checked."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Annotated, Literal

import typer

from pdeface.errors import InputError

__all__ = [
    "DEFAULT_MESH",
    "ClampOption",
    "ExpressionsOption",
    "FaceNumberOption",
    "FacePath",
    "Join",
    "JoinOption",
    "MeshOption",
    "ModelOption",
    "OpeningsOption",
    "QuietOption",
    "SetOption",
    "VisemesOption",
    "check_outputs",
    "parse_level",
    "parse_mesh",
    "parse_size",
]

MOST_VERTICES = 10_000_000
PIXELS = range(16, 8193)
DEFAULT_MESH = "55x81"
"""As many vertices as a head of an avatar has: with every expression a GLB of a few megabytes."""

Join = Literal["smooth", "patchwise"]
FacePath = Annotated[Path, typer.Argument(metavar="FACE", help="A .pdeface file.")]
MeshOption = Annotated[
    str, typer.Option("--mesh", metavar="ROWSxCOLUMNS", help="Size of the uv mesh.")
]
JoinOption = Annotated[
    Join, typer.Option("--join", help="How patches meet: C2, or with the paper's creases.")
]
SetOption = Annotated[
    list[str] | None,
    typer.Option(
        "--set",
        metavar="NAME=VALUE",
        help="Value of a control, or of several: noseLength=0.4,jawOpen=1; may be repeated. "
        "'pdeface controls' lists them.",
    ),
]
ClampOption = Annotated[
    bool, typer.Option("--clamp", help="Bring values of --set into their range.")
]
ExpressionsOption = Annotated[
    str | None,
    typer.Option(
        "--expressions",
        metavar="all|none|NAME,...",
        help="Which expressions a .glb, .gltf or .vrm can make, as morph targets; by default all "
        "that the face can.",
    ),
]
VisemesOption = Annotated[
    bool,
    typer.Option(
        "--visemes",
        help="The fifteen visemes of speech, viseme_sil to viseme_U, as further morph targets.",
    ),
]
Openings = Literal["cut", "none"]
OpeningsOption = Annotated[
    Openings,
    typer.Option("--openings", help="Eyes and mouth that open, or the paper's closed surface."),
]
FaceNumberOption = Annotated[
    int,
    typer.Option(
        "--face",
        metavar="NUMBER",
        min=1,
        help="Which face of a photo of several, counted from the largest.",
    ),
]
ModelOption = Annotated[
    Path | None,
    typer.Option(
        "--model",
        metavar="FILE",
        help="MediaPipe's face_landmarker.task; by default the file that PDEFACE_MODEL names, or "
        "else one that is downloaded once.",
    ),
]
QuietOption = Annotated[bool, typer.Option("--quiet", "-q", help="Say nothing but errors.")]


def parse_mesh(text: str) -> tuple[int, int]:
    """(rows, columns) of ``"109x161"``.

    Raises:
        InputError: not two numbers, fewer than 2, or more than ten million vertices.
    """
    rows, columns = _two_numbers(text, "--mesh", "ROWSxCOLUMNS", "109x161")
    if rows < 2 or columns < 2:
        raise InputError(f"--mesh needs at least 2 rows and 2 columns, got {text}; try 28x41")
    if rows * columns > MOST_VERTICES:
        raise InputError(
            f"--mesh may have {MOST_VERTICES:,} vertices at most, got {text}; try 1081x641"
        )
    return rows, columns


def parse_level(text: str) -> tuple[int, int]:
    """(curves, points on each) of ``"28x46"``.

    Raises:
        InputError: not two numbers.
    """
    return _two_numbers(text, "--level", "CURVESxPOINTS", "55x92")


def parse_size(text: str) -> tuple[int, int]:
    """(width, height) in pixels of ``"800x1000"``.

    Raises:
        InputError: not two numbers between 16 and 8192.
    """
    width, height = _two_numbers(text, "--size", "WIDTHxHEIGHT", "800x1000")
    if width not in PIXELS or height not in PIXELS:
        raise InputError(
            f"--size needs {PIXELS.start} to {PIXELS.stop - 1} pixels each way, got {text}; "
            "try 800x1000"
        )
    return width, height


def check_outputs(
    outputs: Sequence[Path], inputs: Iterable[Path | None], suffixes: Sequence[str]
) -> None:
    """Refuse, before any work is done, what could not be written or would be a loss.

    Folders that do not exist yet are made.

    Raises:
        InputError: a suffix that is none of ``suffixes``, a folder's name, or an input's.
    """
    for out in outputs:
        if out.suffix.lower() not in suffixes:
            raise InputError(
                f"the suffix of the output must be one of {', '.join(suffixes)}, got '{out}'"
            )
        if out.is_dir():
            raise InputError(f"'{out}' is a folder; name a file to write")
        for source in inputs:
            if source is not None and _would_replace(out, source):
                raise InputError(f"'{out}' would replace the input '{source}'; use another name")
    for out in outputs:
        try:
            out.parent.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise InputError(
                f"cannot make the folder '{out.parent}': {error.strerror}; choose another place"
            ) from error


def _would_replace(out: Path, source: Path) -> bool:
    """Whether writing ``out`` would write to ``source``, itself or as a file beside it."""
    if not source.exists():
        return False
    if out.exists() and out.samefile(source):
        return True
    # Formats that name a texture instead of holding it have it written beside them.
    texture = "_".join(out.stem.split()) + "-texture"
    beside = out.suffix.lower() in (".obj", ".ply") and source.stem == texture
    return beside and out.parent.is_dir() and out.parent.samefile(source.parent)


def _two_numbers(text: str, option: str, form: str, example: str) -> tuple[int, int]:
    match = re.fullmatch(r"(\d{1,9})[xX](\d{1,9})", text, re.ASCII)
    if match is None:
        raise InputError(f"{option} needs {form}, got '{text}'; for example {example}")
    return int(match[1]), int(match[2])
