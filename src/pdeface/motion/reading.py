"""Read and write motion in whatever format a file has."""

from __future__ import annotations

from pathlib import Path

from pdeface import files
from pdeface.errors import FileFormatError, InputError
from pdeface.motion._input import read_bytes
from pdeface.motion.livelink import read_livelink
from pdeface.motion.track import Track
from pdeface.motion.track_json import read_json, write_json
from pdeface.motion.track_npz import read_npz, write_npz

__all__ = ["SUFFIXES", "read", "write"]

SUFFIXES = (".csv", ".json", ".npz")
"""Suffixes of the motion files that :func:`read` knows."""

_KNOWN = ".csv of Live Link Face, .json with pdeface-track, or .npz with times, names and weights"


def read(
    path: files.PathLike,
    fps: float | None = None,
    drop_frame: bool | None = None,
    clamp: bool = False,
    degrees: bool = False,
) -> Track:
    """The track in a motion file: a CSV of Live Link Face, or a track as JSON or NumPy arrays.

    The suffix picks the format; where it is none of :data:`SUFFIXES`, the first bytes do.

    Args:
        path: the file.
        fps: for a CSV, the rate at which its timecode counts, if it is to be told.
        drop_frame: for a CSV, whether its timecode drops numbers, if it is to be told.
        clamp: put weights out of 0..1 to the nearer end, rather than refuse them.
        degrees: for a CSV, its angles are degrees.

    Raises:
        InputError: the file cannot be read, or an argument does not fit it.
        FileFormatError: it is none of these formats, or is damaged; the message says where.

    Example:
        >>> track = read("take.csv")  # doctest: +SKIP
        >>> track.at(0.5).weights["eyeBlinkLeft"]  # doctest: +SKIP
    """
    kind = Path(path).suffix.lower()
    if kind not in SUFFIXES:
        kind = _sniff(path)
    if kind == ".csv":
        return read_livelink(path, fps, drop_frame, clamp, degrees)
    if fps is not None or drop_frame is not None or degrees:
        raise InputError(
            f"expected fps, drop_frame and degrees for a .csv alone, got them for {path}, "
            "which has its own times and angles; leave them out"
        )
    return read_json(path, clamp) if kind == ".json" else read_npz(path, clamp)


def write(track: Track, path: files.PathLike) -> None:
    """Write a track as JSON or NumPy arrays, as the suffix says; all of it or nothing.

    Raises:
        InputError: another suffix, or the file cannot be written.
    """
    kind = Path(path).suffix.lower()
    if kind == ".json":
        write_json(track, path)
    elif kind == ".npz":
        write_npz(track, path)
    else:
        raise InputError(
            f"expected a file name that ends in .json or .npz, got {Path(path).name!r}; "
            "the suffix picks the format"
        )


def _sniff(path: files.PathLike) -> str:
    start = read_bytes(path)[:1024].removeprefix(b"\xef\xbb\xbf").lstrip()
    if start.startswith(b"PK\x03\x04"):
        return ".npz"
    if start.startswith(b"{"):
        return ".json"
    if b"timecode" in start.replace(b"\0", b"").lower():
        return ".csv"
    raise FileFormatError(f"{path} is no motion file that is known; expected a {_KNOWN}")
