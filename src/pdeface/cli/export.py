"""``pdeface export``: a face in a format that other programs read."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from pdeface.cli.options import (
    FacePath,
    JoinOption,
    MeshOption,
    QuietOption,
    check_outputs,
    parse_mesh,
)
from pdeface.cli.report import Report

__all__ = ["export"]


def export(
    face: FacePath,
    out: Annotated[
        list[Path],
        typer.Option("-o", "--out", metavar="OUT", help="File to write; may be repeated. The "
                     "suffix picks the format: .glb, .gltf, .obj, .ply, .stl or .pdeface."),
    ],
    mesh: MeshOption = "109x161",
    join: JoinOption = "smooth",
    quads: Annotated[
        bool | None,
        typer.Option("--quads/--triangles", help="Quads (.obj, .ply) or triangles; by default "
                     "quads in .obj, triangles elsewhere."),
    ] = None,
    quiet: QuietOption = False,
) -> None:  # fmt: skip
    """Write a face as a mesh that other programs read.

    The face is sampled afresh at any size: the surface has no resolution of its own. Units are
    metres, +Y up, +Z forward.

    \b
    Examples:
      pdeface export face.pdeface -o face.glb
      pdeface export face.pdeface -o face.obj --mesh 28x41
      pdeface export face.pdeface -o fine.stl --mesh 541x321
      pdeface export face.pdeface -o paper.ply --join patchwise
    """
    size = parse_mesh(mesh)
    report = Report(quiet)
    import pdeface
    from pdeface.formats import SUFFIXES

    check_outputs(out, [face], SUFFIXES)
    value = pdeface.load(face)
    for path in out:
        with report.step(f"writing {path}"):
            pdeface.export(value, path, mesh=size, join=join, quads=quads)
        report.wrote(path)
