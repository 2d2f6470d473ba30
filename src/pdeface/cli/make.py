"""``pdeface make``: a textured face from a portrait."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Literal

import typer

from pdeface.cli.folder import make_folder
from pdeface.cli.making import made_from, write_all
from pdeface.cli.moves import chosen_expressions, parse_weights, speaking
from pdeface.cli.options import (
    DEFAULT_MESH,
    ClampOption,
    ExpressionsOption,
    FaceNumberOption,
    JoinOption,
    MeshOption,
    ModelOption,
    OpeningsOption,
    QuietOption,
    SetOption,
    VisemesOption,
    check_outputs,
    parse_mesh,
)
from pdeface.cli.report import Report
from pdeface.cli.wishes import Wishes
from pdeface.errors import InputError

__all__ = ["make"]


def make(
    out: Annotated[
        list[Path],
        typer.Option(
            "-o",
            "--out",
            metavar="OUT",
            help="File to write; may be repeated. The suffix picks the format: .pdeface, .glb, "
            ".gltf, .vrm, .obj, .ply, .stl, or .png for a sheet of pictures from three sides. "
            "For a folder of photos, a folder.",
        ),
    ],
    photos: Annotated[
        list[Path] | None,
        typer.Argument(metavar="[PHOTO]...", help="A portrait, several photos of one person, or "
                       "a folder of portraits. Without it, the bundled one."),
    ] = None,
    points: Annotated[
        Path | None,
        typer.Option("--points", metavar="FILE", help="JSON file of the 25 feature points in "
                     "PHOTO (docs/points.md), for the paper's warp. Without it the face is found "
                     "by MediaPipe."),
    ] = None,
    texture: Annotated[
        Literal["project", "warp"] | None,
        typer.Option("--texture", help="Read the texture through the fitted face, or warp the "
                     "photo by the paper's five steps; by default project, with --points warp."),
    ] = None,
    delight: Annotated[
        bool,
        typer.Option("--delight", help="Divide the light on the face out of its texture, as far "
                     "as it can be told."),
    ] = False,
    picture: Annotated[
        Path | None,
        typer.Option("--report", metavar="FILE", help="Picture (.png, .jpg) of what was found in "
                     "the photo and what was made of it."),
    ] = None,
    face_number: FaceNumberOption = 1,
    model: ModelOption = None,
    neutral_shape: Annotated[
        bool,
        typer.Option("--neutral-shape", help="Keep the neutral face's shape instead of the shape "
                     "that the landmarks in PHOTO say."),
    ] = False,
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
                     "instead of the one in the photo; the same number gives the same person."),
    ] = None,
    set_: SetOption = None,
    clamp: ClampOption = False,
    expressions: ExpressionsOption = None,
    visemes: VisemesOption = False,
    mesh: MeshOption = DEFAULT_MESH,
    join: JoinOption = "smooth",
    openings: OpeningsOption = "cut",
    formats: Annotated[
        str,
        typer.Option("--formats", metavar="NAME,...", help="For a folder of photos: the files to "
                     "write for each, by their suffixes."),
    ] = "glb",
    jobs: Annotated[
        int,
        typer.Option("--jobs", metavar="N", min=1, help="For a folder of photos: how many to work "
                     "on at once."),
    ] = 1,
    quiet: QuietOption = False,
) -> None:  # fmt: skip
    """Make a textured face from a portrait.

    The face is found on this machine, and with it the person's shape, the camera and the expression
    in the photo; the photo is sent nowhere. Each texel is then read from the photo where the fitted
    face shows it, and what no photo shows is completed. The face that is made has no expression.
    Several photos of one person show more of it.

    A folder of photos makes a folder of faces. One bad photo does not stop the rest (the exit
    status is then 1), and faces that are newer than their photos are not made again.

    \b
    Examples:
      pdeface make -o face.glb
      pdeface make -o face.pdeface -o face.glb -o face.png
      pdeface make me.jpg -o me.glb --report me-report.png
      pdeface make front.jpg left.jpg right.jpg -o me.glb
      pdeface make me.jpg --points me.json -o me.glb
      pdeface make photos/ -o faces/ --formats glb,pdeface --jobs 2
      pdeface make --level 28x46 --mesh 28x41 -o paper.obj
      pdeface make --random 7 --set jawOpen=0.3 -o someone.png
    """
    wishes = Wishes(
        points=points, face_number=face_number, model=model, neutral_shape=neutral_shape,
        texture=texture, delight=delight, level=level, random=person,
        weights=parse_weights(set_), clamp=clamp, mesh=parse_mesh(mesh), join=join,
        openings=openings, visemes=visemes, expressions=expressions,
    )  # fmt: skip
    sources = list(photos or ())
    _check(sources, wishes, picture)
    start = wishes.start()
    if any(source.is_dir() for source in sources):
        make_folder(sources, out, formats, jobs, wishes, picture, Report(quiet))
        return
    from pdeface.formats import SUFFIXES
    from pdeface.pictures.image_file import FORMATS as PICTURES

    # All that can be wrong is found before any work is done.
    chosen_expressions(start, expressions, out)
    speaking(visemes, start, out)
    inputs = [*sources, points, model]
    check_outputs(out, inputs, [*SUFFIXES, *PICTURES])
    check_outputs([picture] if picture else [], [*inputs, *out], [*PICTURES])
    report = Report(quiet)
    face, views = made_from(sources, wishes, start, report)
    write_all(face, out, wishes, report)
    if picture is not None:
        with report.step("drawing the report"):
            from pdeface.photo import photo_report
            from pdeface.pictures.image_file import write_image

            write_image(picture, photo_report(face, views))
        report.wrote(picture)


def _check(sources: list[Path], wishes: Wishes, picture: Path | None) -> None:
    """Refuse options that do not go together."""
    if wishes.points is not None and len(sources) != 1:
        raise InputError(
            "--points also needs PHOTO, one, "
            f"got {len(sources)}; give both, or none for the bundled one"
        )
    if wishes.points is not None and (wishes.texture == "project" or wishes.delight or picture):
        raise InputError(
            "--points is for the paper's warp, which --texture project, --delight and --report "
            "have no part in; leave one of them out"
        )
    if wishes.texture == "warp" and wishes.delight:
        raise InputError("--delight is for --texture project; leave one of them out")
