"""``pdeface fit``: a face from a scan."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal

import typer

from pdeface.cli.compact import CompactOption, check_compact
from pdeface.cli.options import (
    DEFAULT_MESH,
    MeshOption,
    ModelOption,
    QuietOption,
    check_outputs,
    parse_level,
    parse_mesh,
)
from pdeface.cli.report import Report
from pdeface.cli.scanning import Fitting, fit_file, fit_folder
from pdeface.errors import InputError

if TYPE_CHECKING:
    from pdeface.scan import Measures, ScanFit

__all__ = ["fit"]


def fit(
    scan: Annotated[
        Path,
        typer.Argument(metavar="SCAN", help="A head or face: .obj, .ply, .stl, .glb, .gltf or "
                       ".off; a mesh or a cloud of points. Or a folder of them."),
    ],
    out: Annotated[
        list[Path],
        typer.Option("-o", "--out", metavar="OUT", help="File to write; may be repeated. The "
                     "suffix picks the format: .pdeface, .glb, .gltf, .vrm, .obj, .ply or .stl. "
                     "For a folder of scans, a folder."),
    ],
    level: Annotated[
        str,
        typer.Option("--level", metavar="CURVESxPOINTS", help="Boundary curves: 28x46 (the "
                     "paper's), 55x92, 109x184 or any other of 27 n + 1 curves."),
    ] = "55x92",
    units: Annotated[
        Literal["m", "cm", "mm"] | None,
        typer.Option("--units", help="Unit of the scan; without it the one in which its eyes are "
                     "as far apart as a person's."),
    ] = None,
    landmarks: Annotated[
        Path | None,
        typer.Option("--landmarks", metavar="FILE", help="JSON file of points on the scan "
                     "(docs/scans.md). Without it they are found by MediaPipe."),
    ] = None,
    report_picture: Annotated[
        Path | None,
        typer.Option("--report", metavar="PICTURE", help="Picture of scan, fit and how far they "
                     "differ to write, ending in .png."),
    ] = None,
    displacement: Annotated[
        Path | None,
        typer.Option("--displacement", metavar="PICTURE", help="What the curves leave out, as "
                     "heights along the normals, to write: a .png of 16 bits (docs/scans.md)."),
    ] = None,
    rounded: Annotated[
        bool | None,
        typer.Option("--round/--no-round", show_default="for triangles of 4 mm and more",
                     help="Fit the curved surface that a scan's triangles stand for, not their "
                     "flat faces."),
    ] = None,
    model: ModelOption = None,
    texture: Annotated[
        bool, typer.Option("--texture/--no-texture", help="Carry the scan's colours over."),
    ] = True,
    mesh: MeshOption = DEFAULT_MESH,
    compact: CompactOption = None,
    formats: Annotated[
        str,
        typer.Option("--formats", metavar="NAME,...", help="For a folder of scans: the files to "
                     "write for each, by their suffixes."),
    ] = "pdeface",
    jobs: Annotated[
        int,
        typer.Option("--jobs", metavar="N", min=1, help="For a folder of scans: how many to work "
                     "on at once."),
    ] = 1,
    cluster: Annotated[
        str | None,
        typer.Option("--dask", metavar="ADDRESS", help="For a folder of scans: a Dask scheduler, "
                     "such as tcp://127.0.0.1:8786, whose workers fit them; they must see the same "
                     "files."),
    ] = None,
    quiet: QuietOption = False,
) -> None:  # fmt: skip
    """Fit a face to a scan.

    The scan may have any scale, any orientation, holes, hair and shoulders. Its face is found on
    this machine; it is sent nowhere. What comes out is a face like any other: it can be set,
    animated and exported. A coarser level is the best fit at that level.

    A folder of scans makes a folder of faces. One bad scan does not stop the rest (the exit
    status is then 1), and faces that are newer than their scans are not made again.

    \b
    Examples:
      pdeface fit head.ply -o face.pdeface
      pdeface fit head.obj -o face.pdeface --report fit.png
      pdeface fit head.stl --units mm --level 109x184 -o face.glb
      pdeface fit cloud.ply --landmarks points.json -o face.pdeface
      pdeface fit head.ply -o small.pdeface --no-texture --compact 0.1
      pdeface fit head.ply --level 28x46 -o face.pdeface --displacement relief.png
      pdeface fit scans/ -o faces/ --jobs 2
      pdeface fit scans/ -o faces/ --dask tcp://127.0.0.1:8786
    """
    how = Fitting(
        parse_level(level), units, landmarks, rounded, model, texture, parse_mesh(mesh), compact
    )
    from pdeface.formats import SUFFIXES
    from pdeface.pictures.image_file import FORMATS as PICTURES
    from pdeface.scan.levels import check_level

    check_level(how.level)
    report = Report(quiet)
    if scan.is_dir():
        if report_picture is not None:
            raise InputError("--report is of one scan; leave it out for a folder")
        if displacement is not None:
            raise InputError("--displacement is of one scan; leave it out for a folder")
        fit_folder(scan, out, formats, jobs, how, report, cluster)
        return
    if cluster is not None:
        raise InputError("--dask is for a folder of scans, got one scan; leave it out")
    inputs = [scan, landmarks, model]
    check_compact(compact, out)
    check_outputs(out, inputs, SUFFIXES)
    check_outputs([report_picture] if report_picture else [], [*inputs, *out], [*PICTURES])
    check_outputs(
        [displacement] if displacement else [],
        [*inputs, *out, *([report_picture] if report_picture else [])],
        [".png"],
    )
    found, measures = fit_file(scan, out, how, report)
    _tell(report, found, measures)
    if displacement is not None:
        _write_relief(report, found, displacement)
    if report_picture is not None:
        from pdeface.scan.report import report_sheet

        with report.step(f"drawing {report_picture}"):
            report_sheet(found, measures, report_picture)
        report.wrote(report_picture)


def _write_relief(report: Report, found: ScanFit, path: Path) -> None:
    from pdeface.relief import save_relief
    from pdeface.scan import relief_of

    with report.step("measuring what the curves leave out"):
        save_relief(path, relief_of(found))
    report.wrote(path)


def _tell(report: Report, found: ScanFit, measures: Measures) -> None:
    """How near the fit is, over the front of the face."""
    there, back = measures.to_scan, measures.to_face
    report.say(
        f"fit to scan: RMS {there.rms:.3f} mm, median {there.median:.3f}, 95 % {there.p95:.2f}, "
        f"largest {there.largest:.2f}; normals {measures.normal:.1f} degrees"
    )
    report.say(
        f"scan to fit: RMS {back.rms:.3f} mm, median {back.median:.3f}, 95 % {back.p95:.2f}, "
        f"largest {back.largest:.2f}; coverage {100 * measures.coverage:.1f} %"
    )
