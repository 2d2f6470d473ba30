"""``pdeface animate``: a face that moves as a recording or a built-in clip does."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from pdeface.cli.moves import chosen_expressions
from pdeface.cli.options import (
    DEFAULT_MESH,
    ExpressionsOption,
    FacePath,
    MeshOption,
    QuietOption,
    check_outputs,
    parse_mesh,
)
from pdeface.cli.report import Report
from pdeface.errors import InputError

if TYPE_CHECKING:
    from pdeface.formats import Animation
    from pdeface.motion import Track

__all__ = ["animate"]

# Names in one line of a report.
_MOST_NAMES = 6


def animate(
    face: FacePath,
    motion: Annotated[
        str,
        typer.Argument(metavar="MOTION", help="A .csv of Live Link Face, a track in .json or "
                       ".npz, or a built-in clip: blink, smile, look or talk."),
    ],
    out: Annotated[
        Path, typer.Option("-o", "--out", metavar="OUT", help="File to write, .glb or .gltf.")
    ],
    mesh: MeshOption = DEFAULT_MESH,
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
    quiet: QuietOption = False,
) -> None:  # fmt: skip
    """Write a face with an animation, which any viewer of glTF plays at the recorded times.

    Expressions are weights of morph targets; the head turns about a point in the neck. Eyes follow
    the eyeLook weights; their angles are not used. What the motion lacks, and what it has that
    the face cannot do, is said on stderr.

    \b
    Examples:
      pdeface animate face.pdeface talk -o talk.glb
      pdeface animate face.pdeface take.csv -o take.glb
      pdeface animate face.pdeface take.csv -o take.glb --fps 29.97 --drop-frame
      pdeface animate face.pdeface blink -o web.glb --mesh 28x41 --expressions eyeBlinkLeft
    """
    size = parse_mesh(mesh)
    if out.suffix.lower() == ".mp4":
        raise InputError(f"a video such as '{out}' cannot be written yet; write a .glb and play it")
    report = Report(quiet)
    import pdeface
    from pdeface.formats import SUFFIXES_THAT_PLAY

    check_outputs([out], [face, Path(motion)], SUFFIXES_THAT_PLAY)
    value = pdeface.load(face)
    moving = chosen_expressions(value, expressions, [out])[out]
    track = _track(motion, fps, drop_frame, clamp, degrees)
    with report.step(f"writing {out}"):
        animation = _animation(Path(motion).stem, track)
        pdeface.export(value, out, mesh=size, expressions=moving, animation=animation)
    if not quiet:
        for remark in _remarks(track, moving):
            typer.echo(f"note: {remark}", err=True)
    report.wrote(out)


def _track(motion: str, fps: float | None, drop_frame: bool, clamp: bool, degrees: bool) -> Track:
    """The track in a file, or a built-in clip.

    Raises:
        InputError: neither of them, or an option that does not fit it.
    """
    from pdeface.motion import CLIPS, SUFFIXES, clip, read

    if motion not in CLIPS:
        if not Path(motion).exists() and Path(motion).suffix.lower() not in SUFFIXES:
            raise InputError(
                f"expected a file of motion ({', '.join(SUFFIXES)}) or a clip "
                f"({', '.join(CLIPS)}), got '{motion}', which is neither"
            )
        # Without the option the timecode says itself whether it drops numbers.
        return read(motion, fps, drop_frame or None, clamp, degrees)
    if drop_frame or degrees:
        raise InputError(
            f"--drop-frame and --degrees are for a .csv, got the clip '{motion}'; leave them out"
        )
    return clip(motion) if fps is None else clip(motion, fps)


def _animation(name: str, track: Track) -> Animation:
    """The track as what a file can hold; what it should have had and lacks is 0."""
    from pdeface.formats import Animation
    from pdeface.motion import ARKIT_NAMES

    lacking = tuple(name for name in track.missing if name in ARKIT_NAMES)
    names = tuple(dict.fromkeys((*track.names, *lacking)))
    weights = dict(zip(names, track.weights_of(names).T, strict=True))
    return Animation(name, track.times, weights, track.head if track.head.any() else None)


def _remarks(track: Track, moving: Sequence[str]) -> list[str]:
    """What the file lacks of the motion, and the motion of what was asked for; a line each."""
    weights = zip(track.names, track.weights.T, strict=True)
    lost = [name for name, weight in weights if name not in moving and weight.any()]
    remarks = [*track.notes]
    for names, what in (
        (track.missing, "not in the motion, and so 0"),
        (track.ignored, "in the motion, but not known and ignored"),
        (lost, "in the motion, but no expression of the file and left out"),
    ):
        if names:
            shown = ", ".join(names[:_MOST_NAMES])
            more = len(names) - _MOST_NAMES
            remarks.append(f"{what}: {shown}{f' and {more} more' if more > 0 else ''}")
    return remarks
