"""``pdeface make``: a textured face from a portrait."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from pdeface.cli.options import JoinOption, MeshOption, QuietOption, check_outputs, parse_mesh
from pdeface.cli.report import Report
from pdeface.errors import InputError

if TYPE_CHECKING:
    from pdeface import Face

__all__ = ["make"]


def make(
    out: Annotated[
        list[Path],
        typer.Option(
            "-o",
            "--out",
            metavar="OUT",
            help="File to write; may be repeated. The suffix picks the format: .pdeface, .glb, "
            ".gltf, .obj, .ply, .stl, or .png for a sheet of pictures from three sides.",
        ),
    ],
    photo: Annotated[
        Path | None,
        typer.Argument(metavar="PHOTO", help="A portrait from the front; needs --points. "
                       "Without it, the bundled one."),
    ] = None,
    points: Annotated[
        Path | None,
        typer.Option("--points", metavar="FILE", help="JSON file of the 25 feature points in "
                     "PHOTO (docs/points.md)."),
    ] = None,
    level: Annotated[
        str | None,
        typer.Option(
            "--level",
            metavar="CURVESxPOINTS",
            help="Boundary curves of the neutral face: 28x46, the paper's and the default, or "
            "the finer 55x92 and 109x184.",
        ),
    ] = None,
    mesh: MeshOption = "109x161",
    join: JoinOption = "smooth",
    quiet: QuietOption = False,
) -> None:  # fmt: skip
    """Make a textured face from a portrait.

    The photo is warped onto the uv mesh so that its 25 feature points fall where the face has
    them; the face keeps the shape of the neutral one.

    \b
    Examples:
      pdeface make -o face.glb
      pdeface make -o face.pdeface -o face.glb -o face.png
      pdeface make me.jpg --points me.json -o me.glb
      pdeface make --level 28x46 --mesh 28x41 -o paper.obj
    """
    size = parse_mesh(mesh)
    if (photo is None) != (points is None):
        given, missing = ("PHOTO", "--points FILE") if points is None else ("--points", "PHOTO")
        raise InputError(f"{given} also needs {missing}; give both, or none for the bundled one")
    import pdeface
    from pdeface.formats import SUFFIXES
    from pdeface.pictures.image_file import FORMATS as PICTURES

    check_outputs(out, [photo, points], [*SUFFIXES, *PICTURES])
    report = Report(quiet)
    with report.step("warping the photo onto the uv mesh"):
        face = _textured(pdeface.neutral(level) if level else pdeface.neutral(), photo, points)
    for path in out:
        with report.step(f"writing {path}") as progress:
            if path.suffix.lower() in PICTURES:
                from pdeface.pictures import demo_sheet

                demo_sheet(face, path, progress=progress)
            else:
                pdeface.export(face, path, mesh=size, join=join)
        report.wrote(path)


def _textured(face: Face, photo: Path | None, points: Path | None) -> Face:
    from pdeface.texture import FeaturePoints, portrait, read_photo, uv_texture

    if photo is None or points is None:
        image, places = portrait()
        face = face.with_name("portrait").with_notes(
            {"photo": "Eileen Collins; NASA, public domain"}
        )
    else:
        # The points first: they are read in no time, and a mistake in them is likelier.
        places, image = FeaturePoints.load(points), read_photo(photo)
        face = face.with_name(photo.stem)
    return face.with_texture(uv_texture(image, places).image)
