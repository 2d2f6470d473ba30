"""What ``pdeface animate`` writes frame by frame: films and numbered meshes."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from pdeface.cli.options import DEFAULT_MESH, parse_mesh
from pdeface.cli.report import Report
from pdeface.errors import InputError

if TYPE_CHECKING:
    from pdeface import Face
    from pdeface.motion import Frames, Track

__all__ = ["FILM", "MESHES", "SUFFIXES", "check_options", "write_film", "write_meshes"]

FILM, MESHES = ".mp4", ".obj"
SUFFIXES = (".glb", ".gltf", FILM, MESHES)
"""Suffixes of the files that move."""

Written = tuple[list[Path], tuple[str, ...]]
"""The files, and the expressions that are seen in them."""

_RATE = 30.0


def check_options(out: Path, film: Mapping[str, object], rate: float | None) -> None:
    """Refuse options for which an output of this kind has no use.

    Raises:
        InputError: one of ``film`` without a film, or a rate without frames.
    """
    suffix = out.suffix.lower()
    for name, value in film.items():
        if value is not None and suffix != FILM:
            raise InputError(f"--{name} is for a film, got '{out}'; end its name in {FILM}")
    if rate is not None and suffix not in (FILM, MESHES):
        raise InputError(
            f"--rate is for a film ({FILM}) or numbered meshes ({MESHES}), got '{out}', which "
            "keeps the times of the motion; leave it out"
        )


def write_film(
    face: Face,
    track: Track,
    out: Path,
    rate: float | None,
    mesh: tuple[int, int] | None,
    film: Mapping[str, Any],
    report: Report,
) -> Written:
    """Draw the face in each frame; what is None in ``film`` is as it is by default."""
    from pdeface import pictures

    frames, rate = _frames(face, track, rate)
    look = {name: value for name, value in film.items() if value is not None}
    with report.step(f"drawing {out}") as tell:
        progress = _counted(tell, f"drawing {out}", len(frames))
        pictures.film(frames, out, rate, mesh=mesh, progress=progress, **look)
    return [out], frames.moving


def write_meshes(
    face: Face,
    track: Track,
    out: Path,
    rate: float | None,
    mesh: tuple[int, int] | None,
    report: Report,
) -> Written:
    """Write a numbered mesh for each frame."""
    from pdeface.formats import export_sequence

    frames, _ = _frames(face, track, rate)
    with report.step(f"writing {out}") as tell:
        progress = _counted(tell, f"writing {out}", len(frames))
        size = mesh or parse_mesh(DEFAULT_MESH)
        written = export_sequence(frames, out, size, progress=progress)
    return written, frames.moving


def _frames(face: Face, track: Track, rate: float | None) -> tuple[Frames, float]:
    from pdeface.motion import Frames

    rate = _RATE if rate is None else rate
    return Frames(face, track, rate), rate


def _counted(tell: Callable[[str], None], what: str, count: int) -> Callable[[int], None]:
    return lambda number: tell(f"{what}, frame {number} of {count}")
