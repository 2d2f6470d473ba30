"""``pdeface make``: a textured face from a portrait."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from pdeface.cli.landmarks import face_in
from pdeface.cli.moves import chosen_expressions, parse_weights, speaking, with_weights
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
from pdeface.errors import InputError

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from pdeface import Face
    from pdeface.photo import PhotoFace
    from pdeface.texture import FeaturePoints

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
        typer.Argument(metavar="PHOTO", help="A portrait from the front. Without it, the "
                       "bundled one."),
    ] = None,
    points: Annotated[
        Path | None,
        typer.Option("--points", metavar="FILE", help="JSON file of the 25 feature points in "
                     "PHOTO (docs/points.md). Without it they are found by MediaPipe."),
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
    them. Points that are not given are found on this machine, and the person's shape with them;
    the photo is sent nowhere. With --points, and without PHOTO, the face has the shape of the
    neutral one; --random and --set change it.

    \b
    Examples:
      pdeface make -o face.glb
      pdeface make -o face.pdeface -o face.glb -o face.png
      pdeface make me.jpg -o me.glb
      pdeface make me.jpg --points me.json -o me.glb
      pdeface make --level 28x46 --mesh 28x41 -o paper.obj
      pdeface make --random 7 --set jawOpen=0.3 -o someone.png
    """
    size, weights = parse_mesh(mesh), parse_weights(set_)
    if photo is None and points is not None:
        raise InputError("--points also needs PHOTO; give both, or none for the bundled one")
    import pdeface
    from pdeface.formats import SUFFIXES
    from pdeface.pictures.image_file import FORMATS as PICTURES

    shape = with_weights(_shape(person, level), weights, clamp)
    moving = chosen_expressions(shape, expressions, out)
    talking = speaking(visemes, shape, out)
    check_outputs(out, [photo, points, model], [*SUFFIXES, *PICTURES])
    report = Report(quiet)
    image, places, found = _photo(photo, points, face_number, model, report)
    if found is not None and person is None and not neutral_shape:
        with report.step("fitting the person's shape"):
            shape = _fitted(shape, found)
    with report.step("warping the photo onto the uv mesh"):
        face = _textured(shape, photo, image, places)
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


def _photo(
    photo: Path | None, points: Path | None, number: int, model: Path | None, report: Report
) -> tuple[NDArray[np.uint8], FeaturePoints, PhotoFace | None]:
    """The photo, its feature points (bundled, given or found), and the face if it was found."""
    from pdeface.texture import FeaturePoints, portrait, read_photo

    if photo is None:
        return *portrait(), None
    if points is None:
        image = read_photo(photo)
        from pdeface.photo import feature_points

        found = face_in(photo, image, number, model, report)
        return image, feature_points(found), found
    # The points first: they are read in no time, and a mistake in them is likelier.
    places = FeaturePoints.load(points)
    return read_photo(photo), places, None


def _fitted(face: Face, found: PhotoFace) -> Face:
    """The face with the identity of the person found; weights that were set stay."""
    from pdeface.photo import fit_shape

    return face.with_weights({**fit_shape(found).identity, **face.weights})


def _textured(
    face: Face, photo: Path | None, image: NDArray[np.uint8], places: FeaturePoints
) -> Face:
    from pdeface.texture import uv_texture

    if photo is None:
        face = face.with_notes({"photo": "Eileen Collins; NASA, public domain"})
    else:
        face = face.with_name(photo.stem)
    return face.with_texture(uv_texture(image, places).image)
