"""``pdeface animate``: a face that moves as a recording or a built-in clip does."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from pdeface.cli.moves import chosen_expressions
from pdeface.cli.options import (
    DEFAULT_MESH,
    ExpressionsOption,
    FacePath,
    QuietOption,
    check_outputs,
    parse_mesh,
    parse_size,
)
from pdeface.cli.playing import FILM, MESHES, SUFFIXES, check_options, write_film, write_meshes
from pdeface.cli.report import Report
from pdeface.cli.tracks import animation_of, remarks, track_of

__all__ = ["animate"]


def animate(
    face: FacePath,
    motion: Annotated[
        str,
        typer.Argument(metavar="MOTION", help="A .csv of Live Link Face, a track in .json or "
                       ".npz, or a built-in clip: blink, smile, look or talk."),
    ],
    out: Annotated[
        Path,
        typer.Option("-o", "--out", metavar="OUT", help="What to write: .glb or .gltf, with an "
                     "animation; .mp4, a film; or .obj, a numbered file for each frame."),
    ],
    mesh: Annotated[
        str | None,
        typer.Option("--mesh", metavar="ROWSxCOLUMNS", help=f"Size of the uv mesh; by default "
                     f"{DEFAULT_MESH}, and finer in a film."),
    ] = None,
    expressions: ExpressionsOption = None,
    fps: Annotated[
        float | None,
        typer.Option("--fps", help="Frames a second: the rate at which the timecode of a .csv "
                     "counts, by default what it shows; or samples of a clip, by default 60."),
    ] = None,
    drop_frame: Annotated[
        bool, typer.Option("--drop-frame", help="The timecode of a .csv is drop-frame.")
    ] = False,
    clamp: Annotated[
        bool, typer.Option("--clamp", help="Bring weights of MOTION into 0..1.")
    ] = False,
    degrees: Annotated[
        bool, typer.Option("--degrees", help="The angles of a .csv are degrees.")
    ] = False,
    rate: Annotated[
        float | None,
        typer.Option("--rate", help="Frames a second of a film or of numbered files, by default "
                     "30; an animation keeps the times of MOTION."),
    ] = None,
    view: Annotated[
        str | None,
        typer.Option("--view", metavar="front|three-quarter|profile|AZIMUTH", help="Where a film "
                     "is taken from, by default the front; see 'pdeface render --help'."),
    ] = None,
    style: Annotated[
        str | None,
        typer.Option("--style", metavar="textured|shaded|uvmesh", help="What a film shows; by "
                     "default the texture, or the shaded surface of a face that has none."),
    ] = None,
    size: Annotated[
        str | None,
        typer.Option("--size", metavar="WIDTHxHEIGHT", help="Pixels of a film, both even; by "
                     "default 720x900."),
    ] = None,
    quiet: QuietOption = False,
) -> None:  # fmt: skip
    """Write a face that moves: an animation that viewers of glTF play, a film, or meshes.

    In a .glb, expressions are weights of morph targets and the head turns about a point in the
    neck. face.obj stands for face.0001.obj, face.0002.obj and so on, all of them or none, with the
    same vertices in the same order. Eyes follow the eyeLook weights; their angles are not used.
    What the motion lacks, and what it has that the face cannot do, is said on stderr.

    \b
    Examples:
      pdeface animate face.pdeface talk -o talk.glb
      pdeface animate face.pdeface take.csv -o take.glb
      pdeface animate face.pdeface take.csv -o take.glb --fps 29.97 --drop-frame
      pdeface animate face.pdeface blink -o web.glb --mesh 28x41 --expressions eyeBlinkLeft
      pdeface animate face.pdeface talk -o talk.mp4 --view three-quarter
      pdeface animate face.pdeface take.csv -o frames/face.obj --rate 24
    """
    grid = parse_mesh(mesh) if mesh else None
    film = {"view": view, "style": style, "size": parse_size(size) if size else None}
    check_options(out, film, rate)
    report = Report(quiet)
    import pdeface

    check_outputs([out], [face, Path(motion)], SUFFIXES)
    value = pdeface.load(face)
    moving = chosen_expressions(value, expressions, [out])[out]
    track = track_of(motion, fps, drop_frame, clamp, degrees)
    if out.suffix.lower() == FILM:
        written, moving = write_film(value, track, out, rate, grid, film, report)
    elif out.suffix.lower() == MESHES:
        written, moving = write_meshes(value, track, out, rate, grid, report)
    else:
        written = [out]
        with report.step(f"writing {out}"):
            grid = grid or parse_mesh(DEFAULT_MESH)
            clip = animation_of(Path(motion).stem, track)
            pdeface.export(value, out, mesh=grid, expressions=moving, animation=clip)
    if not quiet:
        for remark in remarks(track, moving):
            typer.echo(f"note: {remark}", err=True)
    report.wrote(*written)
