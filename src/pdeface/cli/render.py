"""``pdeface render``: a picture of a face."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from pdeface.cli.moves import parse_weights, with_weights
from pdeface.cli.options import (
    ClampOption,
    FacePath,
    JoinOption,
    OpeningsOption,
    QuietOption,
    SetOption,
    check_outputs,
    parse_mesh,
    parse_size,
)
from pdeface.cli.report import Report

__all__ = ["render"]


def render(
    face: FacePath,
    out: Annotated[
        Path,
        typer.Option("-o", "--out", metavar="OUT", help="File to write: .png, .jpg or .webp."),
    ],
    view: Annotated[
        str,
        typer.Option(
            "--view",
            metavar="front|three-quarter|profile|AZIMUTH",
            help="Where to look from: a name, degrees towards the subject's left (-35), or "
            "azimuth and elevation (35,10).",
        ),
    ] = "front",
    style: Annotated[
        str | None,
        typer.Option(
            "--style",
            metavar="textured|shaded|curves|uvmesh|curvature",
            help="What to show; by default the texture, or the shaded surface of a face that "
            "has none.",
        ),
    ] = None,
    size: Annotated[
        str, typer.Option("--size", metavar="WIDTHxHEIGHT", help="Pixels of the picture.")
    ] = "800x1000",
    mesh: Annotated[
        str | None,
        typer.Option(
            "--mesh", metavar="ROWSxCOLUMNS", help="Size of the uv mesh; each style has its own."
        ),
    ] = None,
    join: JoinOption = "smooth",
    openings: OpeningsOption = "cut",
    light: Annotated[
        str | None,
        typer.Option(
            "--light",
            metavar="studio|soft|raking",
            help="Each style has its own; raking light shows how fair a surface is.",
        ),
    ] = None,
    background: Annotated[
        str, typer.Option("--background", metavar="COLOUR", help="studio, a name or #rrggbb.")
    ] = "studio",
    transparent: Annotated[
        bool, typer.Option("--transparent", help="No background (.png, .webp).")
    ] = False,
    loops: Annotated[
        bool, typer.Option("--loops", help="Style curves: the whole closed curves.")
    ] = False,
    set_: SetOption = None,
    clamp: ClampOption = False,
    quiet: QuietOption = False,
) -> None:
    """Draw a face.

    \b
    Examples:
      pdeface render face.pdeface -o face.png
      pdeface render face.pdeface -o side.png --view profile --style shaded
      pdeface render face.pdeface -o curves.png --view -35 --style curves
      pdeface render face.pdeface -o big.png --size 1600x2000 --transparent
      pdeface render face.pdeface -o wink.png --set eyeBlinkRight=1,mouthSmileRight=0.5
    """
    pixels = parse_size(size)
    grid = parse_mesh(mesh) if mesh else None
    weights = parse_weights(set_)
    report = Report(quiet)
    import pdeface
    from pdeface.pictures.image_file import FORMATS

    value = with_weights(pdeface.load(face), weights, clamp)
    check_outputs([out], [face], list(FORMATS))
    with report.step(f"drawing {out}"):
        pdeface.render(
            value,
            out,
            view=view,
            style=style,
            mesh=grid,
            join=join,
            openings=openings,
            size=pixels,
            background=background,
            transparent=transparent,
            light=light,
            loops=loops,
        )
    report.wrote(out)
