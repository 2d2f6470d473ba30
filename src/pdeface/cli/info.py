"""``pdeface info``: what a face is made of."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated

import typer

from pdeface.cli.options import FacePath
from pdeface.cli.report import size_in_words

if TYPE_CHECKING:
    from pathlib import Path

    from pdeface import Face

__all__ = ["info"]


def info(
    face: FacePath,
    as_json: Annotated[bool, typer.Option("--json", help="As JSON, for programs.")] = False,
) -> None:
    """Show what a face is made of: curves, values of controls, texture, size.

    \b
    Examples:
      pdeface info face.pdeface
      pdeface info face.pdeface --json
    """
    import pdeface

    value = pdeface.load(face)
    if as_json:
        import json

        typer.echo(json.dumps(_facts(face, value), indent=2))
        return
    from rich.console import Console
    from rich.table import Table
    from rich.text import Text

    table = Table(show_header=False, title=Text(str(face)), title_justify="left")
    for topic, text in _rows(face, value):
        table.add_row(Text(topic), Text(text))
    Console().print(table)


def _facts(path: Path, face: Face) -> dict[str, object]:
    curves, points = face.curves.shape
    texture = None
    if face.texture is not None:
        height, width, channels = face.texture.shape
        encoded = len(face.texture_file() or b"")
        texture = {"width": width, "height": height, "channels": channels, "bytes": encoded}
    return {
        "name": face.name,
        "curves": curves,
        "points": points,
        "mirrored": face.curves.is_mirrored,
        "a": face.a,
        "modes": face.modes,
        "weights": dict(face.weights),
        "size_mm": _size_mm(face),
        "texture": texture,
        "bytes": path.stat().st_size,
        "notes": dict(face.notes),
    }


def _rows(path: Path, face: Face) -> list[tuple[str, str]]:
    facts = _facts(path, face)
    mirrored = "; the back mirrors the face" if facts["mirrored"] else ""
    width, height, depth = _size_mm(face)
    rows = [
        ("name", face.name or "-"),
        ("boundary curves", f"{facts['curves']} of {facts['points']} points{mirrored}"),
        ("equation", f"a = {face.a:g}, {face.modes} Fourier modes and the remainder"),
        *_weights(face),
        ("size", f"{width:.0f} mm wide, {height:.0f} mm high, {depth:.0f} mm deep"),
        ("texture", _texture(face)),
        ("file", size_in_words(path.stat().st_size)),
    ]
    return rows + [(f"note: {topic}", text) for topic, text in face.notes.items()]


def _weights(face: Face) -> list[tuple[str, str]]:
    """One row for each kind of control that is not 0."""
    by_kind: dict[str, list[str]] = {}
    for control, value in face.controls:
        if value != 0.0:
            by_kind.setdefault(control.kind, []).append(f"{control.name} {value:.3g}")
    return [(kind, ", ".join(values)) for kind, values in by_kind.items()]


def _texture(face: Face) -> str:
    if face.texture is None:
        return "none"
    height, width, channels = face.texture.shape
    kind = {3: "RGB", 4: "RGBA"}[channels]
    return f"{width} x {height} {kind}, {size_in_words(len(face.texture_file() or b''))}"


def _size_mm(face: Face) -> list[float]:
    """Extent of the face along x, y and z, to a tenth of a millimetre."""
    vertices = face.mesh(109, 161).vertices
    return [round(1000.0 * float(s), 1) for s in vertices.max(axis=0) - vertices.min(axis=0)]
