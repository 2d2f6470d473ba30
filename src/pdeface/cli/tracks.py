"""The motion that a command was given: read, turned into an animation, and what is lost of it."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from pdeface.errors import InputError

if TYPE_CHECKING:
    from pdeface.formats import Animation
    from pdeface.motion import Track

__all__ = ["animation_of", "remarks", "track_of"]

# Names in one line of a report.
_MOST_NAMES = 6


def track_of(motion: str, fps: float | None, drop_frame: bool, clamp: bool, degrees: bool) -> Track:
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


def animation_of(name: str, track: Track) -> Animation:
    """The track as what a file can hold; what it should have had and lacks is 0."""
    from pdeface.formats import Animation
    from pdeface.motion import ARKIT_NAMES

    lacking = tuple(name for name in track.missing if name in ARKIT_NAMES)
    names = tuple(dict.fromkeys((*track.names, *lacking)))
    weights = dict(zip(names, track.weights_of(names).T, strict=True))
    return Animation(name, track.times, weights, track.head if track.head.any() else None)


def remarks(track: Track, moving: Sequence[str]) -> list[str]:
    """What the file lacks of the motion, and the motion of what was asked for; a line each."""
    weights = zip(track.names, track.weights.T, strict=True)
    lost = [name for name, weight in weights if name not in moving and weight.any()]
    told = [*track.notes]
    for names, what in (
        (track.missing, "not in the motion, and so 0"),
        (track.ignored, "in the motion, but not known and ignored"),
        (lost, "in the motion, but no expression of the file and left out"),
    ):
        if names:
            shown = ", ".join(names[:_MOST_NAMES])
            more = len(names) - _MOST_NAMES
            told.append(f"{what}: {shown}{f' and {more} more' if more > 0 else ''}")
    return told
