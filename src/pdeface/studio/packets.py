"""Arrays as bytes: a JSON header that names them, then float32 and int32, little-endian."""

from __future__ import annotations

import dataclasses
import json
import struct
from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pdeface.studio.schema import ArrayInfo

__all__ = ["pack_arrays", "packed"]


def pack_arrays(arrays: Mapping[str, NDArray[Any]], **facts: Any) -> bytes:
    """Bytes of arrays by name: 4 of the header's length, the header, and the arrays in turn.

    Args:
        arrays: integers become int32, all else float32.
        facts: more for the header, as JSON.
    """
    return b"".join(packed(arrays, **facts))


def packed(arrays: Mapping[str, NDArray[Any]], **facts: Any) -> list[bytes | memoryview]:
    """The same in pieces, large arrays of the right type not copied."""
    infos, chunks, offset = [], [], 0
    for name, array in arrays.items():
        whole = np.issubdtype(array.dtype, np.integer)
        data = np.ascontiguousarray(array, "<i4" if whole else "<f4")
        kind = "int32" if whole else "float32"
        infos.append(dataclasses.asdict(ArrayInfo(name, kind, list(array.shape), offset)))
        chunks.append(data.reshape(-1).view(np.uint8).data)
        offset += data.nbytes
    header = json.dumps({"arrays": infos, **facts}, separators=(",", ":")).encode()
    header += b" " * (-len(header) % 4)
    return [struct.pack("<I", len(header)) + header, *chunks]
