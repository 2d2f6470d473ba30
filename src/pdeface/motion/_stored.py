"""What the two file formats of a track have in common: their marks, a track from their parts."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pdeface import files
from pdeface.errors import FileFormatError, InputError
from pdeface.motion.track import Track

__all__ = ["FORMAT", "VERSION", "check_version", "make_track"]

FORMAT = "pdeface-track"
VERSION = 1
"""Raised only when an older reader would misread a file; additions do not raise it."""


def check_version(path: files.PathLike, version: Any) -> None:
    """Refuse a file of a newer version, or of none."""
    if isinstance(version, bool) or not isinstance(version, int) or version < 1:
        raise FileFormatError(
            f"{path}: expected version {VERSION} of a track file, got {version!r}; mend it"
        )
    if version > VERSION:
        raise FileFormatError(
            f"{path}: this is version {version} of the format, this library reads {VERSION}; "
            "install a newer pdeface"
        )


def make_track(
    path: files.PathLike,
    times: Any,
    names: Sequence[str],
    weights: Any,
    clamp: bool,
    others: Mapping[str, Any],
) -> Track:
    """The track that a file describes, or a FileFormatError that says what is wrong with it.

    Args:
        path: the file, for messages.
        times: (T,) as the file has it, unchecked, like all that follows.
        names: (N,) names.
        weights: (T, N) weights.
        clamp: put weights out of 0..1 to the nearer end.
        others: further arguments of :class:`Track`.
    """
    try:
        if clamp:
            weights, others = _clamped(weights, others)
        return Track(times, tuple(names), weights, **others)
    except InputError as error:
        raise FileFormatError(f"{path}: {error}") from error
    except (TypeError, ValueError) as error:
        reason = " ".join(str(error).split())
        raise FileFormatError(
            f"{path}: expected a track's times, names and weights ({reason}); see docs/motion.md"
        ) from error


def _clamped(weights: Any, others: Mapping[str, Any]) -> tuple[NDArray[Any], Mapping[str, Any]]:
    given = np.asarray(weights, dtype=np.float64)
    clamped = np.clip(given, 0.0, 1.0)
    changed = int(((given < 0) | (given > 1)).sum())
    if not changed:
        return given, others
    note = (
        f"{changed} weights clamped to 0..1, the furthest out by {abs(given - clamped).max():.3g}."
    )
    return clamped, {**others, "notes": (*others.get("notes", ()), note)}
