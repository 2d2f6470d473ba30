"""What a ``.pdeface`` file says: its JSON description, its curves and its texture.

Documented in docs/file-format.md so that anyone can write a reader. This module packs and
unpacks values and knows nothing of surfaces or pixels; :mod:`pdeface.face` builds on it.
"""

from __future__ import annotations

import io
import json
import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, NoReturn

import numpy as np
from numpy.typing import NDArray

from pdeface import __version__
from pdeface.archive.container import damaged, read_members, write_members
from pdeface.curves import BoundaryCurves
from pdeface.errors import FileFormatError
from pdeface.images import media_type

__all__ = ["VERSION", "FaceRecord", "pack", "unpack"]

VERSION = 1
"""Raised only when an older reader would misread the file; additions do not raise it."""

_CURVES = "curves.npy"
_TEXTURES = {"image/png": "texture.png", "image/jpeg": "texture.jpg"}


@dataclass(frozen=True, eq=False)
class FaceRecord:
    """What a file holds: the values of a :class:`pdeface.Face`, its texture still encoded."""

    curves: BoundaryCurves
    a: float = 1.0
    modes: int = 6
    name: str = ""
    notes: Mapping[str, str] = field(default_factory=dict)
    texture: bytes | None = None
    weights: Mapping[str, float] = field(default_factory=dict)


def pack(record: FaceRecord) -> bytes:
    """The bytes of a ``.pdeface`` file; the same record gives the same bytes.

    Raises:
        InputError: more curves or notes than a reader would accept.
    """
    mirrored = record.curves.is_mirrored
    points = record.curves.half if mirrored else record.curves.points
    members = {"face.json": _describe(record, mirrored), _CURVES: _npy(points)}
    if record.texture is not None:
        members[_TEXTURES[media_type(record.texture)]] = record.texture
    return write_members(members)


def unpack(data: bytes) -> FaceRecord:
    """The record in the bytes of a ``.pdeface`` file.

    Unknown members of the ZIP and unknown keys of the JSON are ignored.

    Raises:
        FileFormatError: damaged, not such a file, or of a newer version.
    """
    members = read_members(data)
    header = _read_header(_member(members, "face.json"))
    try:
        return _record(header, members)
    except FileFormatError:
        raise
    except KeyError as error:
        raise damaged(f"face.json has no {error}") from error
    except (TypeError, AttributeError, ValueError, OverflowError) as error:
        raise damaged(str(error)) from error


def _record(header: Mapping[str, Any], members: Mapping[str, bytes]) -> FaceRecord:
    entry, surface, texture = header["curves"], header["surface"], header.get("texture")
    points = _read_npy(_member(members, entry["file"]))
    mirror_z = _number(entry["mirror_z"])
    if entry["stored"] == "half":
        curves = BoundaryCurves.from_half(points, mirror_z)
    elif entry["stored"] == "closed":
        curves = BoundaryCurves(points, mirror_z)
    else:
        raise ValueError(f"curves are stored as {entry['stored']!r}")
    if curves.shape != (entry["count"], entry["points"]):
        raise ValueError(f"face.json and {_CURVES} differ in the number of curves or points")
    return FaceRecord(
        curves=curves,
        a=_number(surface["a"]),
        modes=_whole(surface["modes"]),
        name=_text(header.get("name", "")),
        notes={key: _text(value) for key, value in header.get("notes", {}).items()},
        texture=None if texture is None else _member(members, texture["file"]),
        weights={key: _number(value) for key, value in header.get("weights", {}).items()},
    )


def _describe(record: FaceRecord, mirrored: bool) -> bytes:
    count, points = record.curves.shape
    members = {
        "face.json": "this description",
        _CURVES: "data points of the boundary curves, metres; half: those of 0 < v < pi alone",
    }
    texture = None
    if record.texture is not None:
        kind = media_type(record.texture)
        texture = {"file": _TEXTURES[kind], "media_type": kind}
        members[_TEXTURES[kind]] = "texture over v / pi (to the right) and u (downwards)"
    header = {
        "format": "pdeface",
        "version": VERSION,
        "generator": f"pdeface {__version__}",
        "name": record.name,
        "notes": dict(record.notes),
        "units": "metres",
        "axes": "+X the subject's left, +Y up, +Z forward",
        "curves": {
            "file": _CURVES,
            "count": count,
            "points": points,
            "stored": "half" if mirrored else "closed",
            "mirror_z": record.curves.mirror_z,
        },
        "surface": {"a": float(record.a), "modes": int(record.modes)},
        "weights": dict(record.weights),
        "texture": texture,
        "members": members,
    }
    return json.dumps(header, indent=2, allow_nan=False).encode("ascii")


def _npy(points: NDArray[np.float64]) -> bytes:
    stream = io.BytesIO()
    array = np.ascontiguousarray(points, dtype="<f8")
    np.lib.format.write_array(stream, array, version=(1, 0), allow_pickle=False)
    return stream.getvalue()


def _read_header(data: bytes) -> Mapping[str, Any]:
    try:
        header = json.loads(data, parse_constant=_refuse_constant)
    except (ValueError, RecursionError) as error:
        raise damaged(f"face.json is not JSON: {error}") from error
    if not isinstance(header, dict) or header.get("format") != "pdeface":
        raise damaged("face.json is not the description of a face")
    version = header.get("version")
    if not isinstance(version, int) or isinstance(version, bool) or version < 1:
        raise damaged(f"its version is {version!r}")
    if version > VERSION:
        raise FileFormatError(
            f"expected a .pdeface file of version {VERSION}, got version {version}; "
            "update pdeface to read it"
        )
    return header


def _read_npy(data: bytes) -> NDArray[np.float64]:
    """The array, by its header alone: ``np.load`` would first make room for what that claims."""
    stream = io.BytesIO(data)
    try:
        if np.lib.format.read_magic(stream) != (1, 0):
            raise ValueError("unknown version")
        shape, fortran, dtype = np.lib.format.read_array_header_1_0(stream)
        if dtype.kind != "f" or dtype.itemsize not in (4, 8):
            raise ValueError(f"expected float64, got {dtype}")
        if len(shape) != 3:
            raise ValueError(f"expected (curves, points, 3), got {shape}")
        if dtype.itemsize * math.prod(shape) != len(data) - stream.tell():
            raise ValueError(f"expected {shape} numbers, got {len(data) - stream.tell()} bytes")
        array = np.frombuffer(data, dtype, offset=stream.tell())
        return array.reshape(shape, order="F" if fortran else "C").astype(np.float64)
    except Exception as error:  # the parser of the header raises nearly anything
        raise damaged(f"{_CURVES} is not an array of curves: {error}") from error


def _member(members: Mapping[str, bytes], name: str) -> bytes:
    if name not in members:
        raise damaged(f"it has no {name}")
    return members[name]


def _number(value: Any) -> float:
    if isinstance(value, bool) or not isinstance(value, int | float) or not math.isfinite(value):
        raise ValueError(f"expected a number in face.json, got {value!r}")
    return float(value)


def _whole(value: Any) -> int:
    if isinstance(value, bool) or not isinstance(value, int):
        raise ValueError(f"expected a whole number in face.json, got {value!r}")
    return value


def _text(value: Any) -> str:
    if not isinstance(value, str):
        raise ValueError(f"expected text in face.json, got {value!r}")
    return value


def _refuse_constant(name: str) -> NoReturn:
    raise ValueError(f"{name} is not a number")
