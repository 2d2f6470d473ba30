"""``pdeface make`` of a folder: many portraits, one face each."""

from __future__ import annotations

import concurrent.futures
import multiprocessing
import time
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Literal, NamedTuple

import typer

from pdeface.cli.making import made_from, write_all
from pdeface.cli.moves import chosen_expressions, speaking
from pdeface.cli.report import Report
from pdeface.cli.wishes import Wishes
from pdeface.errors import InputError, PDEFaceError

__all__ = ["make_folder"]

SOME_FAILED = 1
PHOTOS = (
    ".avif", ".bmp", ".gif", ".heic", ".heif", ".jp2", ".jpeg", ".jpg", ".png", ".tga", ".tif",
    ".tiff", ".webp",
)  # fmt: skip


class Outcome(NamedTuple):
    """What became of one photo."""

    photo: Path
    state: Literal["made", "kept", "failed"]
    seconds: float
    message: str


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
    plan = _plan(photos, target, suffixes)
    example = plan[photos[0]]
    start = wishes.start()
    chosen_expressions(start, wishes.expressions, example)
    speaking(wishes.visemes, start, example)
    target.mkdir(parents=True, exist_ok=True)
    outcomes = []
    for outcome in report.counted(_outcomes(plan, wishes, jobs), len(photos), "faces"):
        outcomes.append(outcome)
        if outcome.state == "failed":
            report.warn(f"{outcome.photo.name}: {outcome.message}")
    _tell(outcomes, report)
    if any(outcome.state == "failed" for outcome in outcomes):
        raise typer.Exit(SOME_FAILED)


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


def _plan(photos: list[Path], target: Path, suffixes: list[str]) -> dict[Path, list[Path]]:
    """The files of each photo; photos that differ in their suffix alone keep it in the name."""
    names = [photo.stem.casefold() for photo in photos]
    plan = {}
    for photo, name in zip(photos, names, strict=True):
        stem = photo.stem if names.count(name) == 1 else photo.name.replace(".", "-")
        plan[photo] = [target / f"{stem}{suffix}" for suffix in suffixes]
    return plan


def _outcomes(plan: dict[Path, list[Path]], wishes: Wishes, jobs: int) -> Iterator[Outcome]:
    """The outcome of every photo, as they come."""
    todo = {}
    for photo, outputs in plan.items():
        if _is_newer(outputs, photo):
            yield Outcome(photo, "kept", 0.0, "newer than its photo")
        else:
            todo[photo] = outputs
    if jobs == 1 or len(todo) < 2:
        for photo, outputs in todo.items():
            yield _one(photo, outputs, wishes)
        return
    # Fresh processes: MediaPipe's threads do not survive a fork.
    context = multiprocessing.get_context("spawn")
    with concurrent.futures.ProcessPoolExecutor(jobs, mp_context=context) as pool:
        running = {pool.submit(_one, p, outputs, wishes): p for p, outputs in todo.items()}
        try:
            for done in concurrent.futures.as_completed(running):
                yield _result(done, running[done])
        except (KeyboardInterrupt, GeneratorExit):
            pool.shutdown(wait=False, cancel_futures=True)
            raise


def _result(done: concurrent.futures.Future[Outcome], photo: Path) -> Outcome:
    try:
        return done.result()
    except Exception as error:  # a process that was killed takes its photo with it, no other
        return Outcome(photo, "failed", 0.0, f"{type(error).__name__}: {error}")


def _is_newer(outputs: list[Path], photo: Path) -> bool:
    """Whether all outputs are there and none is older than the photo: files come whole."""
    times = [output.stat().st_mtime for output in outputs if output.is_file()]
    return len(times) == len(outputs) and min(times) >= photo.stat().st_mtime


def _one(photo: Path, outputs: list[Path], wishes: Wishes) -> Outcome:
    began = time.monotonic()
    try:
        quiet = Report(quiet=True)
        face, _ = made_from([photo], wishes, wishes.start(), quiet)
        write_all(face, outputs, wishes, quiet)
    except PDEFaceError as error:
        return Outcome(photo, "failed", time.monotonic() - began, str(error))
    except Exception as error:  # one photo, whatever is wrong with it, does not stop the rest
        message = f"unexpected {type(error).__name__}: {error}"
        return Outcome(photo, "failed", time.monotonic() - began, message)
    return Outcome(photo, "made", time.monotonic() - began, "")


def _tell(outcomes: list[Outcome], report: Report) -> None:
    rows = [
        (o.photo.name, o.state, f"{o.seconds:.1f} s" if o.seconds else "", o.message)
        for o in sorted(outcomes)
    ]
    report.table(("photo", "face", "time", ""), rows)
    counts = {
        state: sum(o.state == state for o in outcomes) for state in ("made", "kept", "failed")
    }
    report.say(", ".join(f"{count} {state}" for state, count in counts.items()))
