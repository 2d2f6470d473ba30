"""``pdeface paper``: the paper's figures, drawn anew."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from pdeface.cli.options import QuietOption
from pdeface.cli.report import Report

__all__ = ["paper"]


def paper(
    out: Annotated[
        Path, typer.Option("-o", "--out", metavar="DIR", help="Folder to write; made if need be.")
    ],
    quiet: QuietOption = False,
) -> None:
    """Redraw the figures of the paper with data of this project.

    Writes Figs 1 to 6, 8 and 9 as PNGs, and a page, README.md, that says point by point what
    agrees and what differs.

    \b
    Examples:
      pdeface paper -o paper
    """
    report = Report(quiet)
    from pdeface.pictures.paper import paper as draw

    with report.step("drawing the figures") as progress:
        written = draw(out, progress=progress)
    for path in written:
        report.wrote(path)
