"""``pdeface make``: a textured face from a portrait."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from pdeface.cli.moves import chosen_expressions, parse_weights, speaking, with_weights
from pdeface.cli.options import (
    DEFAULT_MESH,
    ClampOption,
    ExpressionsOption,
    JoinOption,
    MeshOption,
    OpeningsOption,
    QuietOption,
    SetOption,
    VisemesOption,
    check_outputs,
    parse_mesh,
)
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
            ".gltf, .vrm, .obj, .ply, .stl, or .png for a sheet of pictures from three sides.",
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
    person: Annotated[
        int | None,
        typer.Option("--random", metavar="SEED", min=0, help="The shape of a random person "
                     "instead of the neutral face; the same number gives the same person."),
    ] = None,
    set_: SetOption = None,
    clamp: ClampOption = False,
    expressions: ExpressionsOption = None,
    visemes: VisemesOption = False,
    mesh: MeshOption = DEFAULT_MESH,
    join: JoinOption = "smooth",
    openings: OpeningsOption = "cut",
    quiet: QuietOption = False,
) -> None:  # fmt: skip
    """Make a textured face from a portrait.

    The photo is warped onto the uv mesh so that its 25 feature points fall where the face has
    them; the face has the shape of the neutral one unless --random or --set say otherwise.

    \b
    Examples:
      pdeface make -o face.glb
      pdeface make -o face.pdeface -o face.glb -o face.png
      pdeface make me.jpg --points me.json -o me.glb
      pdeface make --level 28x46 --mesh 28x41 -o paper.obj
      pdeface make --random 7 --set jawOpen=0.3 -o someone.png
    """
    size, weights = parse_mesh(mesh), parse_weights(set_)
    if (photo is None) != (points is None):
        given, missing = ("PHOTO", "--points FILE") if points is None else ("--points", "PHOTO")
        raise InputError(f"{given} also needs {missing}; give both, or none for the bundled one")
    import pdeface
    from pdeface.formats import SUFFIXES
    from pdeface.pictures.image_file import FORMATS as PICTURES

    shape = with_weights(_shape(person, level), weights, clamp)
    moving = chosen_expressions(shape, expressions, out)
    talking = speaking(visemes, shape, out)
    check_outputs(out, [photo, points], [*SUFFIXES, *PICTURES])
    report = Report(quiet)
    with report.step("warping the photo onto the uv mesh"):
        face = _textured(shape, photo, points)
    for path in out:
        with report.step(f"writing {path}") as progress:
            if path.suffix.lower() in PICTURES:
                from pdeface.pictures import demo_sheet

                demo_sheet(face, path, progress=progress)
            else:
                pdeface.export(
                    face,
                    path,
                    mesh=size,
                    join=join,
                    expressions=moving[path],
                    openings=openings,
                    visemes=path in talking,
                )
        report.wrote(path)


def _shape(person: int | None, level: str | None) -> Face:
    import pdeface

    levels = {"level": level} if level else {}
    if person is None:
        return pdeface.neutral(**levels).with_name("portrait")
    return pdeface.random(person, **levels)


def _textured(face: Face, photo: Path | None, points: Path | None) -> Face:
    from pdeface.texture import FeaturePoints, portrait, read_photo, uv_texture

    if photo is None or points is None:
        image, places = portrait()
        face = face.with_notes({"photo": "Eileen Collins; NASA, public domain"})
    else:
        # The points first: they are read in no time, and a mistake in them is likelier.
        places, image = FeaturePoints.load(points), read_photo(photo)
        face = face.with_name(photo.stem)
    return face.with_texture(uv_texture(image, places).image)
