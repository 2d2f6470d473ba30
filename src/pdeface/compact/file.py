"""The compact ``.pdeface`` file: a short header, the code of the curves, and the rest.

Documented in docs/file-format.md. It holds what the ordinary file holds, its curves to within an
error that is asked for.
"""

from __future__ import annotations

import json
import struct
import zlib
from typing import Any, NamedTuple

import numpy as np

from pdeface.archive import FaceRecord
from pdeface.compact.codec import Predicted, decode, encode, predicted
from pdeface.curves import BoundaryCurves, mirror_points
from pdeface.errors import FileFormatError, InputError

__all__ = ["MAGIC", "Compact", "pack_compact", "unpack_compact"]

MAGIC = b"PDFc"
VERSION = 1

_HEADER = struct.Struct("<4sBBHHfffIII")
"""Magic, version, modes of the equation, curves, points, a, mirror_z, step, CRC-32 of all that
follows, and the lengths of the curves' code and of the texts."""

_MOST_CURVES, _MOST_POINTS, _MOST_TEXT = 1024, 2048, 1 << 24
_COARSEST, _FINEST = 2e-2, 1e-7
_ROUNDS = 24
_ROUNDING = 1e-9


class Compact(NamedTuple):
    """A face in few bytes.

    Attributes:
        data: the file.
        shape_bytes: of which the curves are so many.
        rms: root mean square distance of the curves' points from where they were, metres.
        largest: the largest distance, metres.
    """

    data: bytes
    shape_bytes: int
    rms: float
    largest: float


def pack_compact(record: FaceRecord, error: float) -> Compact:
    """The smallest code of a face whose curves stay within an error.

    Args:
        record: the face; its curves must be closed by reflection.
        error: root mean square distance allowed, metres.

    Raises:
        InputError: other curves, too many, or an error that is no length.
    """
    curves = record.curves
    if not _is_reflected(curves):
        raise InputError(
            "a compact file needs curves that are closed by reflection, got others; save the face "
            "without compact"
        )
    if curves.shape[0] > _MOST_CURVES or curves.shape[1] > _MOST_POINTS:
        raise InputError(
            f"a compact file holds at most {_MOST_CURVES} curves of {_MOST_POINTS} points, got "
            f"{curves.shape[0]} of {curves.shape[1]}; save the face without compact"
        )
    if not _FINEST <= error <= _COARSEST:
        raise InputError(
            f"the error of a compact file is a distance from {1e3 * _FINEST:g} to "
            f"{1e3 * _COARSEST:g} mm, got {1e3 * error:g}; try 0.1"
        )
    parts = predicted(_as_stored(curves))
    step = _coarsest(parts, error)
    code = encode(parts, step)
    restored = decode(code, curves.shape, float(np.float32(curves.mirror_z)), step)
    texts = _texts(record)
    body = code + texts + (record.texture or b"")
    header = _HEADER.pack(
        MAGIC, VERSION, record.modes, *curves.shape, record.a, curves.mirror_z, step,
        zlib.crc32(body), len(code), len(texts),
    )  # fmt: skip
    apart = np.linalg.norm(restored.points - curves.points, axis=-1)
    rms = float(np.sqrt((apart**2).mean()))
    return Compact(header + body, len(header) + len(code), rms, float(apart.max()))


def unpack_compact(data: bytes) -> FaceRecord:
    """The record in a compact file.

    Raises:
        FileFormatError: damaged, or of a newer version.
    """
    if len(data) < _HEADER.size:
        raise _damaged("it is cut short")
    magic, version, modes, count, points, a, mirror_z, step, crc, code, texts = _HEADER.unpack(
        data[: _HEADER.size]
    )
    if magic != MAGIC or version < 1:
        raise _damaged("it does not begin as one")
    if version > VERSION:
        raise FileFormatError(
            f"expected a compact .pdeface file of version {VERSION}, got version {version}; "
            "update pdeface to read it"
        )
    body = data[_HEADER.size :]
    if zlib.crc32(body) != crc or len(body) < code + texts:
        raise _damaged("its checksum does not hold")
    if not (2 <= count <= _MOST_CURVES and 4 <= points <= _MOST_POINTS) or points % 2:
        raise _damaged(f"it says {count} curves of {points} points")
    if not (0.0 < step < 1.0) or not np.isfinite([a, mirror_z]).all():
        raise _damaged("its numbers are none")
    described = _read_texts(body[code : code + texts])
    return FaceRecord(
        curves=decode(body[:code], (count, points), mirror_z, step),
        a=float(a),
        modes=modes,
        texture=body[code + texts :] or None,
        **described,
    )


def _as_stored(curves: BoundaryCurves) -> BoundaryCurves:
    """The curves with the plane of reflection as the header can hold it."""
    mirror_z = float(np.float32(curves.mirror_z))
    return BoundaryCurves.from_half(curves.half, mirror_z)


def _is_reflected(curves: BoundaryCurves) -> bool:
    """Whether curves are closed by reflection, but for rounding."""
    if curves.shape[1] % 2:
        return False
    closed = mirror_points(curves.half, curves.mirror_z)
    return bool(np.abs(curves.points - closed).max() < _ROUNDING)


def _coarsest(curves: Predicted, error: float) -> float:
    """The coarsest step whose error is within the limit, by bisection."""
    # A step of the error itself leaves less than it: the lower end always holds.
    low, high = float(np.log(error)), float(np.log(200.0 * error))
    for _ in range(_ROUNDS):
        middle = 0.5 * (low + high)
        if curves.error(float(np.float32(np.exp(middle)))) <= error:
            low = middle
        else:
            high = middle
    return float(np.float32(np.exp(low)))


def _texts(record: FaceRecord) -> bytes:
    """Name, notes and weights; nothing where there are none."""
    described = {
        "name": record.name,
        "notes": dict(record.notes),
        "weights": {name: float(f"{value:.4g}") for name, value in record.weights.items()},
    }
    kept = {key: value for key, value in described.items() if value}
    if not kept:
        return b""
    text = json.dumps(kept, ensure_ascii=False, separators=(",", ":")).encode("utf-8")
    packed = zlib.compress(text, 9, wbits=-15)
    return b"\0" + text if len(text) <= len(packed) else b"\1" + packed


def _read_texts(data: bytes) -> dict[str, Any]:
    if not data:
        return {}
    try:
        text = data[1:]
        if data[0] == 1:
            text = zlib.decompressobj(-15).decompress(text, _MOST_TEXT)
        read = json.loads(text)
        return {
            "name": str(read.get("name", "")),
            "notes": {str(k): str(v) for k, v in read.get("notes", {}).items()},
            "weights": {str(k): float(v) for k, v in read.get("weights", {}).items()},
        }
    except Exception as error:  # whatever bytes may hold
        raise _damaged(str(error) or repr(error)) from error


def _damaged(reason: str) -> FileFormatError:
    return FileFormatError(
        "expected a compact .pdeface file, got one that is damaged "
        f"({' '.join(reason.split())}); take it from a backup or make it again"
    )
