"""``pdeface export``: a face in a format that other programs read."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from pdeface.cli.compact import CompactOption, check_compact, is_face, write_compact
from pdeface.cli.moves import chosen_expressions, parse_weights, speaking, with_weights
from pdeface.cli.options import (
    DEFAULT_MESH,
    ClampOption,
    ExpressionsOption,
    FacePath,
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

if TYPE_CHECKING:
    pass

__all__ = ["export"]


def export(
    face: FacePath,
    out: Annotated[
        list[Path],
        typer.Option("-o", "--out", metavar="OUT", help="File to write; may be repeated. The "
                     "suffix picks the format: .glb, .gltf, .vrm, .obj, .ply, .stl or .pdeface."),
    ],
    mesh: MeshOption = DEFAULT_MESH,
    join: JoinOption = "smooth",
    openings: OpeningsOption = "cut",
    quads: Annotated[
        bool | None,
        typer.Option("--quads/--triangles", help="Quads (.obj, .ply) or triangles; by default "
                     "quads in .obj, triangles elsewhere."),
    ] = None,
    displace: Annotated[
        Path | None,
        typer.Option("--displace", metavar="PICTURE", help="Heights to raise on the surface: what "
                     "pdeface fit --displacement wrote."),
    ] = None,
    compact: CompactOption = None,
    set_: SetOption = None,
    clamp: ClampOption = False,
    expressions: ExpressionsOption = None,
    visemes: VisemesOption = False,
    quiet: QuietOption = False,
) -> None:  # fmt: skip
    """Write a face as a mesh that other programs read.

    The face is sampled afresh at any size: the surface has no resolution of its own. Units are
    metres, +Y up, +Z forward. In .glb, .gltf and .vrm, expressions are morph targets by ARKit's
    names, and those that --set turns on are at that weight to begin with; in the other formats they
    are part of the mesh. A .vrm is an avatar, with the expressions that VRM 1.0 names.

    \b
    Examples:
      pdeface export face.pdeface -o face.glb
      pdeface export face.pdeface -o face.obj --mesh 28x41
      pdeface export face.pdeface -o fine.stl --mesh 541x321
      pdeface export face.pdeface -o paper.ply --join patchwise
      pdeface export face.pdeface -o smile.obj --set mouthSmileLeft=0.8,mouthSmileRight=0.8
      pdeface export face.pdeface -o blink.glb --expressions eyeBlinkLeft,eyeBlinkRight
      pdeface export face.pdeface -o still.glb --expressions none
      pdeface export face.pdeface -o avatar.vrm
      pdeface export face.pdeface -o talks.glb --visemes
      pdeface export face.pdeface -o head.obj --mesh 541x481 --displace relief.png
      pdeface export face.pdeface -o small.pdeface --compact 0.1
    """
    size, weights = parse_mesh(mesh), parse_weights(set_)
    report = Report(quiet)
    import pdeface
    from pdeface.formats import SUFFIXES
    from pdeface.relief import load_relief

    value = with_weights(pdeface.load(face), weights, clamp)
    moving = chosen_expressions(value, expressions, out)
    talking = speaking(visemes, value, out)
    relief = None if displace is None else load_relief(displace)
    check_outputs(out, [face, displace], SUFFIXES)
    check_compact(compact, out)
    for path in out:
        if compact is not None and is_face(path):
            write_compact(value, path, compact, report)
            continue
        with report.step(f"writing {path}"):
            pdeface.export(
                value,
                path,
                mesh=size,
                join=join,
                quads=quads,
                expressions=moving[path],
                openings=openings,
                visemes=path in talking,
                relief=relief,
            )
        report.wrote(path)
