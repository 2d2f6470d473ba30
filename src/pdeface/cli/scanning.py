"""``pdeface fit``: one scan, or a folder of them."""

from __future__ import annotations

import functools
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Literal, NamedTuple

from pdeface.cli.batch import planned, work_through
from pdeface.cli.compact import check_compact, is_face, write_compact
from pdeface.cli.report import Report
from pdeface.errors import InputError

if TYPE_CHECKING:
    from pdeface.scan import Landmarks, Measures, ScanFit

__all__ = ["Fitting", "fit_file", "fit_folder"]


class Fitting(NamedTuple):
    """How scans are fitted, as the command line says."""

    level: tuple[int, int]
    units: Literal["m", "cm", "mm"] | None
    landmarks: Path | None
    rounded: bool | None
    model: Path | None
    texture: bool
    mesh: tuple[int, int]
    compact: float | None


def fit_file(
    scan: Path, out: Sequence[Path], how: Fitting, report: Report
) -> tuple[ScanFit, Measures]:
    """Fit a face to the scan in a file and write it."""
    import pdeface
    from pdeface.scan import fit_scan, measure, read_scan, texture_of

    points = _points(how.landmarks)
    with report.step(f"reading {scan}"):
        head = read_scan(scan)
    with report.step("fitting") as show:
        found = fit_scan(
            head,
            how.level,
            landmarks=points,
            units=how.units,
            rounded=how.rounded,
            model=how.model,
            progress=show,
        )
    if found.unit is None:
        report.warn("the scan's unit is none of m, cm and mm; took its eyes to be 63 mm apart")
    if found.rounded and how.rounded is None:
        report.say(
            f"the scan's triangles are {1e3 * found.scan.spacing:.0f} mm wide: fitted the curved "
            "surface that they stand for (--no-round fits their flat faces)"
        )
    with report.step("measuring the fit"):
        measures = measure(found)
    face = found.face.with_name(scan.stem)
    if how.texture:
        with report.step("carrying the colours over"):
            image = texture_of(found)
            face = face if image is None else face.with_texture(image)
    for path in out:
        if how.compact is not None and is_face(path):
            write_compact(face, path, how.compact, report)
            continue
        with report.step(f"writing {path}"):
            pdeface.export(face, path, mesh=how.mesh)
        report.wrote(path)
    return found, measures


def fit_folder(
    folder: Path,
    out: Sequence[Path],
    formats: str,
    jobs: int,
    how: Fitting,
    report: Report,
    cluster: str | None = None,
) -> None:
    """Fit a face to every scan in a folder, with a table of what became of each.

    Raises:
        InputError: nothing to do, or options that are not for folders.
        typer.Exit: with status 1, if some scans failed.
    """
    from pdeface.formats import SUFFIXES as FORMATS
    from pdeface.scan.reading import SUFFIXES

    if len(out) != 1 or out[0].suffix or out[0].is_file():
        raise InputError(
            f"a folder of scans makes one folder of faces, got {', '.join(map(str, out))}; name one"
        )
    if how.landmarks is not None:
        raise InputError("--landmarks are of one scan; leave them out for a folder")
    suffixes = [f".{name.strip().lstrip('.').lower()}" for name in formats.split(",")]
    for suffix in suffixes:
        if suffix not in FORMATS:
            raise InputError(f"--formats takes {', '.join(FORMATS)}, got '{suffix}'")
    check_compact(how.compact, [Path(f"face{suffix}") for suffix in suffixes])
    scans = sorted(p for p in folder.iterdir() if p.suffix.lower() in SUFFIXES and p.is_file())
    if not scans:
        raise InputError(f"expected scans in '{folder}', found none; name another folder")
    out[0].mkdir(parents=True, exist_ok=True)
    plan = planned(scans, out[0], suffixes)
    work_through(plan, functools.partial(_one, how=how), jobs, report, "scan", cluster)


def _one(scan: Path, outputs: list[Path], how: Fitting) -> str:
    _, measures = fit_file(scan, outputs, how, Report(quiet=True))
    there = measures.to_scan
    return f"RMS {there.rms:.3f} mm, median {there.median:.3f}, normals {measures.normal:.1f} deg"


def _points(path: Path | None) -> Landmarks | None:
    if path is None:
        return None
    from pdeface.scan import load_landmarks

    return load_landmarks(path)
