"""A track as JSON, for people and other programs to write; docs/motion.md describes it."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pdeface import files
from pdeface.errors import FileFormatError
from pdeface.motion._input import read_bytes
from pdeface.motion._stored import FORMAT, VERSION, check_version, make_track
from pdeface.motion.track import Track

__all__ = ["read_json", "write_json"]

_PARTS = {"head": "head", "leftEye": "left_eye", "rightEye": "right_eye"}
_ANGLES = ("yaw", "pitch", "roll")


def read_json(path: files.PathLike, clamp: bool = False) -> Track:
    """The track in a JSON file; keys that are not known are ignored.

    Raises:
        InputError: the file cannot be read.
        FileFormatError: it is no track, is damaged, or is newer than this library.
    """
    try:
        text = read_bytes(path).decode("utf-8-sig")
        content = json.loads(text, object_pairs_hook=_no_repeats)
    except (ValueError, RecursionError) as error:
        if isinstance(error, FileFormatError):
            raise
        raise FileFormatError(
            f"{path} is not a track: expected JSON ({error}); mend it or write it anew"
        ) from error
    if not isinstance(content, dict) or content.get("format") != FORMAT:
        raise FileFormatError(
            f'{path}: expected a JSON object with "format": "{FORMAT}"; see docs/motion.md'
        )
    check_version(path, content.get("version"))
    return _track(path, content, clamp)


def write_json(track: Track, path: files.PathLike) -> None:
    """Write a track, one channel a line; all of it or nothing. Reading it gives it back exactly.

    Raises:
        InputError: the file cannot be written.
    """
    channels = dict(zip(track.names, track.weights.T.tolist(), strict=True))
    parts = {
        key: dict(zip(_ANGLES, angles.T.tolist(), strict=True))
        for key, part in _PARTS.items()
        if (angles := getattr(track, part)).any()
    }
    texts = {key: list(getattr(track, key)) for key in ("missing", "ignored", "notes")}
    entries = [
        f'"format": "{FORMAT}"',
        f'"version": {VERSION}',
        f'"fps": {json.dumps(track.fps)}',
        f'"times": {json.dumps(track.times.tolist())}',
        f'"weights": {_lines(channels)}',
        *(f'"{key}": {_lines(angles)}' for key, angles in parts.items()),
        *(f'"{key}": {json.dumps(value)}' for key, value in texts.items() if value),
    ]
    files.atomic_write(path, ("{\n  " + ",\n  ".join(entries) + "\n}\n").encode())


def _lines(channels: Mapping[str, Any]) -> str:
    lines = [f"{json.dumps(name)}: {json.dumps(values)}" for name, values in channels.items()]
    return "{\n    " + ",\n    ".join(lines) + "\n  }" if lines else "{}"


def _track(path: files.PathLike, content: Mapping[str, Any], clamp: bool) -> Track:
    times, weights = content.get("times"), content.get("weights")
    if not isinstance(times, list) or not isinstance(weights, dict):
        raise FileFormatError(
            f'{path}: expected the list "times" and the object "weights" (a list for each name); '
            "see docs/motion.md"
        )
    others: dict[str, Any] = {"fps": content.get("fps")}
    for key, part in _PARTS.items():
        if key in content:
            others[part] = _angles(path, key, content[key], len(times))
    for key in ("missing", "ignored", "notes"):
        if isinstance(content.get(key), list):
            others[key] = tuple(content[key])
    channels = [_channel(path, name, values, len(times)) for name, values in weights.items()]
    table = np.stack(channels, axis=1) if channels else np.zeros((len(times), 0))
    return make_track(path, _numbers(path, "times", times), tuple(weights), table, clamp, others)


def _angles(path: files.PathLike, part: str, value: Any, samples: int) -> NDArray[np.float64]:
    if not isinstance(value, dict) or not set(value) <= set(_ANGLES):
        raise FileFormatError(
            f'{path}: expected "{part}" to be an object of "yaw", "pitch" and "roll", radians; '
            "see docs/motion.md"
        )
    angles = np.zeros((samples, 3))
    for name, values in value.items():
        angles[:, _ANGLES.index(name)] = _channel(path, f"{part} {name}", values, samples)
    return angles


def _channel(path: files.PathLike, name: str, values: Any, samples: int) -> NDArray[np.float64]:
    if not isinstance(values, list) or len(values) != samples:
        got = f"{len(values)} numbers" if isinstance(values, list) else type(values).__name__
        raise FileFormatError(
            f"{path}: expected {samples} numbers for {name}, one for each time, got {got}; "
            "give as many"
        )
    return _numbers(path, name, values)


def _numbers(path: files.PathLike, name: str, values: Sequence[Any]) -> NDArray[np.float64]:
    for place, value in enumerate(values):
        if isinstance(value, bool) or not isinstance(value, int | float):
            raise FileFormatError(
                f"{path}: expected numbers for {name}, got {json.dumps(value)[:40]} at sample "
                f"{place}; mend it"
            )
    try:
        return np.array(values, dtype=np.float64)
    except OverflowError as error:
        raise FileFormatError(f"{path}: {name} has a number that is too large; mend it") from error


def _no_repeats(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    """A JSON object's content; a name given twice is an error, not a choice of the second."""
    content = dict(pairs)
    if len(content) < len(pairs):
        names = [name for name, _ in pairs]
        twice = next(name for name in names if names.count(name) > 1)
        raise ValueError(f"{twice!r} twice")
    return content
