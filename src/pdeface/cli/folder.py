"""``pdeface make`` of a folder: many portraits, one face each."""

from __future__ import annotations

import functools
from collections.abc import Sequence
from pathlib import Path

from pdeface.cli.batch import planned, work_through
from pdeface.cli.making import made_from, write_all
from pdeface.cli.moves import chosen_expressions, speaking
from pdeface.cli.report import Report
from pdeface.cli.wishes import Wishes
from pdeface.errors import InputError

__all__ = ["make_folder"]

PHOTOS = (
    ".avif", ".bmp", ".gif", ".heic", ".heif", ".jp2", ".jpeg", ".jpg", ".png", ".tga", ".tif",
    ".tiff", ".webp",
)  # fmt: skip


def make_folder(
    sources: Sequence[Path],
    out: Sequence[Path],
    formats: str,
    jobs: int,
    wishes: Wishes,
    picture: Path | None,
    report: Report,
) -> None:
    """Make a face of every photo in a folder, with a table of what became of each.

    Raises:
        InputError: options that are not for folders, or nothing to do.
        typer.Exit: with status 1, if some photos failed.
    """
    folder, target = _folders(sources, out)
    if wishes.points is not None or picture is not None:
        raise InputError("--points and --report are for one person; leave them out for a folder")
    suffixes = _suffixes(formats)
    photos = sorted(p for p in folder.iterdir() if p.suffix.lower() in PHOTOS and p.is_file())
    if not photos:
        raise InputError(f"expected photos in '{folder}', found none; name another folder")
    plan = planned(photos, target, suffixes)
    example = plan[photos[0]]
    start = wishes.start()
    chosen_expressions(start, wishes.expressions, example)
    speaking(wishes.visemes, start, example)
    target.mkdir(parents=True, exist_ok=True)
    work_through(plan, functools.partial(_one, wishes=wishes), jobs, report, "photo")


def _folders(sources: Sequence[Path], out: Sequence[Path]) -> tuple[Path, Path]:
    if len(sources) != 1 or len(out) != 1:
        raise InputError(
            f"a folder of photos makes one folder of faces, got {len(sources)} inputs and "
            f"{len(out)} outputs; name one of each"
        )
    if out[0].suffix or out[0].is_file():
        raise InputError(f"a folder of photos makes a folder of faces, got '{out[0]}'; name one")
    return sources[0], out[0]


def _suffixes(formats: str) -> list[str]:
    from pdeface.formats import SUFFIXES
    from pdeface.pictures.image_file import FORMATS as PICTURES

    suffixes = [f".{name.strip().lstrip('.').lower()}" for name in formats.split(",")]
    known = [*SUFFIXES, *PICTURES]
    for suffix in suffixes:
        if suffix not in known:
            raise InputError(f"--formats takes {', '.join(known)}, got '{suffix}'")
    return suffixes


def _one(photo: Path, outputs: list[Path], wishes: Wishes) -> str:
    quiet = Report(quiet=True)
    face, _ = made_from([photo], wishes, wishes.start(), quiet)
    write_all(face, outputs, wishes, quiet)
    return ""
