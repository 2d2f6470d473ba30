"""Faces in few bytes: the option of the commands that write them, and how they are written."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from pdeface.cli.report import Report
from pdeface.errors import InputError

if TYPE_CHECKING:
    from pdeface import Face

__all__ = ["CompactOption", "check_compact", "is_face", "write_compact"]

CompactOption = Annotated[
    float | None,
    typer.Option(
        "--compact",
        metavar="MM",
        help="Write .pdeface files of a few hundred bytes and the texture, whose curves are off by "
        "so many millimetres, root mean square; 0.1 is less than a scanner sees.",
    ),
]


def is_face(path: Path) -> bool:
    """Whether a file is written as a face, by its suffix."""
    return path.suffix.lower() == ".pdeface"


def check_compact(compact: float | None, out: Sequence[Path]) -> None:
    """Refuse the option where nothing is written that it could make small.

    Raises:
        InputError: no output is a .pdeface file.
    """
    if compact is not None and not any(map(is_face, out)):
        raise InputError(
            "--compact needs an output that ends in .pdeface; add one, or leave it out"
        )


def write_compact(face: Face, path: Path, millimetres: float, report: Report) -> None:
    """Write a face to within an error, and tell its bytes and the error made."""
    from pdeface.files import atomic_write

    with report.step(f"writing {path}"):
        made = face.compact(1e-3 * millimetres)
        atomic_write(path, made.data)
    report.wrote(path)
    report.say(
        f"shape: {made.shape_bytes} bytes, off by {1e3 * made.rms:.3f} mm (root mean square), "
        f"at most {1e3 * made.largest:.2f} mm"
    )
