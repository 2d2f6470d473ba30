"""The JSON file of a photo's feature points; docs/points.md describes it."""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import Any

from pdeface import files
from pdeface.errors import FileFormatError, InputError

__all__ = ["read", "write"]

_FORMAT, _VERSION = "pdeface-points", 1
_CONVENTION = (
    "pixels: x to the right and y down from the top-left corner of the picture, "
    "so that the centre of the first pixel is at (0.5, 0.5); left and right are the subject's"
)

Positions = dict[str, Any]


def read(path: files.PathLike) -> tuple[Positions, Any]:
    """Positions by name and (width, height) of the photo, neither of them checked.

    Raises:
        InputError: the file cannot be opened.
        FileFormatError: it is not a points file, is damaged, or is newer than this library.
    """
    try:
        with open(path, encoding="utf-8-sig") as stream:
            content = json.load(stream, object_pairs_hook=_no_repeats)
    except OSError as error:
        raise InputError(
            f"cannot read the points file {path}: {error.strerror or error}; check its name"
        ) from error
    except (ValueError, RecursionError) as error:
        raise FileFormatError(
            f"{path} is not a points file: expected JSON, got {error}; mend it"
        ) from error
    try:
        return _parse(content)
    except FileFormatError as error:
        raise FileFormatError(f"{path}: {error}") from error


def write(
    path: files.PathLike, positions: Mapping[str, tuple[float, float]], size: tuple[int, int]
) -> None:
    """Write a points file, one point a line; all of it or nothing."""
    lines = ",\n".join(
        f"    {json.dumps(name)}: [{x:.10g}, {y:.10g}]" for name, (x, y) in positions.items()
    )
    text = (
        f'{{\n  "format": "{_FORMAT}",\n  "version": {_VERSION},\n'
        f'  "image": {{"width": {size[0]}, "height": {size[1]}}},\n'
        f'  "convention": {json.dumps(_CONVENTION)},\n'
        f'  "points": {{\n{lines}\n  }}\n}}\n'
    )
    files.atomic_write(path, text.encode())


def _no_repeats(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    """A JSON object's content; a name given twice is an error, not a choice of the second."""
    content = dict(pairs)
    if len(content) < len(pairs):
        names = [name for name, _ in pairs]
        twice = next(name for name in names if names.count(name) > 1)
        raise ValueError(f"{twice!r} twice")
    return content


def _parse(content: Any) -> tuple[Positions, Any]:
    """Positions and image size of a points file's content."""
    if not isinstance(content, dict) or content.get("format") != _FORMAT:
        raise FileFormatError(
            f'expected a JSON object with "format": "{_FORMAT}"; see docs/points.md'
        )
    version = content.get("version")
    if not isinstance(version, int) or isinstance(version, bool) or version < 1:
        raise FileFormatError(f'expected "version": {_VERSION}, got {version!r}')
    if version > _VERSION:
        raise FileFormatError(
            f"this is version {version} of the format, this library reads {_VERSION}; "
            "install a newer pdeface"
        )
    image, points = content.get("image"), content.get("points")
    if not isinstance(image, dict) or not isinstance(points, dict):
        raise FileFormatError(
            'expected the objects "image" (width and height) and "points" (25 of [x, y]); '
            "see docs/points.md"
        )
    return points, (image.get("width"), image.get("height"))
