"""``pdeface controls``: what can be changed on a face, and how it stands."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal

import typer

if TYPE_CHECKING:
    from pdeface.controls import Control

__all__ = ["controls"]

_HEAD = ("name", "group", "range", "value", "description")


def controls(
    face: Annotated[
        Path | None,
        typer.Argument(metavar="FACE", help="A .pdeface file; without it, the neutral face."),
    ] = None,
    kind: Annotated[
        Literal["shape", "identity", "expression"] | None,
        typer.Option("--kind", help="Only what shapes a face by name, by statistics, or moves it."),
    ] = None,
    as_json: Annotated[bool, typer.Option("--json", help="As JSON, for programs.")] = False,
) -> None:
    """List the controls of a face: what --set of the other commands takes.

    A control is 0 at rest. Left and right are the subject's.

    \b
    Examples:
      pdeface controls
      pdeface controls --kind expression
      pdeface controls face.pdeface --json
    """
    import pdeface

    value = pdeface.load(face) if face else pdeface.neutral()
    listed = [(control, now) for control, now in value.controls if kind in (None, control.kind)]
    if as_json:
        import dataclasses
        import json

        facts = [{**dataclasses.asdict(control), "value": now} for control, now in listed]
        typer.echo(json.dumps(facts, indent=2))
        return
    for line in _lines([_HEAD, *(_row(control, now) for control, now in listed)]):
        typer.echo(line)


def _row(control: Control, value: float) -> tuple[str, ...]:
    limits = f"{control.low:g}..{control.high:g}"
    return control.name, control.group, limits, f"{value:.4g}", control.description


def _lines(rows: Sequence[Sequence[str]]) -> list[str]:
    """One line a row with its columns aligned: for the eye, and for `grep`."""
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    return [
        "  ".join(cell.ljust(width) for cell, width in zip(row, widths, strict=True)).rstrip()
        for row in rows
    ]
