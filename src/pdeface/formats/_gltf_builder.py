"""A glTF document under construction: one buffer, accessors into it, and the JSON around them.

Our own rather than pygltflib's: of a GLB it would write the 28 bytes of framing and turn
dataclasses into the JSON that are plain dictionaries here, for four more dependencies and 0.15 s
of import. What takes thought, the buffer and its accessors, it leaves to its caller.
"""

from __future__ import annotations

import base64
import json
import struct
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from pdeface.errors import InputError

__all__ = ["GltfBuilder"]

Target = Literal["vertices", "indices"]
Json = dict[str, Any]

_TARGETS = {"vertices": 34962, "indices": 34963}
_COMPONENTS = {"uint8": 5121, "uint16": 5123, "uint32": 5125, "float32": 5126}
_INDEX_TYPES = (np.uint8, np.uint16, np.uint32)
_SHAPES = {(): "SCALAR", (2,): "VEC2", (3,): "VEC3", (4,): "VEC4", (4, 4): "MAT4"}
_LARGEST_GLB = 0xFFFFFFFF


class GltfBuilder:
    """Collects the objects of a glTF 2.0 file; each ``add`` returns the index of its object.

    Attributes:
        asset: what the file says of itself.
        extensions: what it says beyond glTF, by name of the extension.
    """

    def __init__(self, generator: str) -> None:
        self.asset: Json = {"version": "2.0", "generator": generator}
        self.extensions: Json = {}
        self._lists: dict[str, list[Json]] = {}
        self._chunks: list[bytes] = []
        self._length = 0
        self._zeros: dict[int, int] = {}

    def add(self, kind: str, **properties: Any) -> int:
        """Add an object to a top-level list, such as ``add("nodes", name="face", mesh=0)``.

        Properties that are None are left out.
        """
        objects = self._lists.setdefault(kind, [])
        objects.append({key: value for key, value in properties.items() if value is not None})
        return len(objects) - 1

    def add_view(
        self, data: bytes, target: Target | None = None, *, stride: int | None = None
    ) -> int:
        """Add bytes to the buffer, at a multiple of 4 as every accessor wants.

        Args:
            data: what to add.
            target: what a graphics card does with it.
            stride: bytes from one vertex to the next, for a view that several accessors share.
        """
        view = self.add(
            "bufferViews",
            buffer=0,
            byteOffset=self._length,
            byteLength=len(data),
            byteStride=stride,
            target=_TARGETS[target] if target else None,
        )
        padding = bytes(-len(data) % 4)
        self._chunks += [data, padding]
        self._length += len(data) + len(padding)
        return view

    def add_accessor(
        self, values: NDArray[Any], target: Target | None = None, *, bounds: bool = False
    ) -> int:
        """Add an array: (n,) scalars, (n, 2..4) vectors or (n, 4, 4) matrices (transposed).

        Args:
            values: float32, or an unsigned integer type.
            target: what a graphics card does with it.
            bounds: state minimum and maximum, as glTF demands of positions and of times.
        """
        view = self.add_view(_bytes(values), target)
        return self.add("accessors", bufferView=view, **_described(values, bounds))

    def add_differences(
        self, values: NDArray[np.float32], nothing: float, *, bounds: bool = False
    ) -> int:
        """Add (n, 3) differences, most of them perhaps too small to matter.

        Only those that matter are stored (glTF's sparse accessor, the others being 0), unless
        all of them take fewer bytes.

        Args:
            values: vectors.
            nothing: a vector up to this length may become 0.
            bounds: state minimum and maximum.
        """
        kept = np.flatnonzero(np.einsum("ij,ij->i", values, values) > nothing * nothing)
        index_type = next(t for t in _INDEX_TYPES if len(values) - 1 <= np.iinfo(t).max)
        if len(kept) * (values.itemsize * 3 + index_type().itemsize) >= values.nbytes:
            return self.add_accessor(values, "vertices", bounds=bounds)
        stored = values[kept]
        # The bounds are those of all values, of which one at least became 0.
        with_zero = np.concatenate([stored, np.zeros((1, 3), values.dtype)])
        described = {**_described(with_zero, bounds), "count": len(values)}
        sparse = self._sparse(kept.astype(index_type), stored) if len(kept) else None
        zeros = self._view_of_zeros(len(values))
        return self.add("accessors", bufferView=zeros, **described, sparse=sparse)

    def _sparse(self, indices: NDArray[Any], values: NDArray[Any]) -> Json:
        """Values, and after them their indices, in one view: each view costs 60 bytes of text."""
        view = self.add_view(_bytes(values) + _bytes(indices))
        return {
            "count": len(indices),
            "indices": {
                "bufferView": view,
                "byteOffset": values.nbytes,
                "componentType": _COMPONENTS[indices.dtype.name],
            },
            # An offset of 0 goes without saying, but VTK wants it said.
            "values": {"bufferView": view, "byteOffset": 0},
        }

    def _view_of_zeros(self, count: int) -> int:
        """``count`` vectors of 0. A reader would have to think of them itself if they were left
        out, as they may be, and some do not."""
        if count not in self._zeros:
            self._zeros[count] = self.add_view(bytes(12 * count), "vertices", stride=12)
        return self._zeros[count]

    def add_indices(self, triangles: NDArray[Any], vertex_count: int) -> int:
        """Add (T, 3) indices in the smallest type that graphics cards like."""
        # 65535 itself restarts a strip on some hardware and may not be an index.
        kind = np.uint16 if vertex_count <= 65535 else np.uint32
        return self.add_accessor(triangles.ravel().astype(kind), "indices")

    def to_glb(self) -> bytes:
        """The document as one binary file."""
        body = b"".join(self._chunks)
        text = self._json({"byteLength": len(body)})
        text += b" " * (-len(text) % 4)
        total = 12 + 8 + len(text) + 8 + len(body)
        if total > _LARGEST_GLB:
            raise InputError(
                f"a GLB has at most 4 GiB, this one would have {total / 2**30:.1f}; "
                "choose a coarser mesh"
            )
        header = struct.pack("<4sII", b"glTF", 2, total)
        json_head = struct.pack("<I4s", len(text), b"JSON")
        body_head = struct.pack("<I4s", len(body), b"BIN\0")
        return b"".join([header, json_head, text, body_head, body])

    def to_gltf(self) -> bytes:
        """The document as JSON text with the buffer inside it."""
        body = b"".join(self._chunks)
        uri = "data:application/octet-stream;base64," + base64.b64encode(body).decode("ascii")
        return self._json({"byteLength": len(body), "uri": uri})

    def _json(self, buffer: Json) -> bytes:
        document = {"asset": self.asset, "scene": 0, **self._lists, "buffers": [buffer]}
        if self.extensions:
            document |= {"extensionsUsed": [*self.extensions], "extensions": self.extensions}
        return json.dumps(document, separators=(",", ":"), allow_nan=False).encode("ascii")


def _bytes(values: NDArray[Any]) -> bytes:
    return values.astype(values.dtype.newbyteorder("<"), copy=False).tobytes()


def _described(values: NDArray[Any], bounds: bool) -> Json:
    """What an accessor says of its values."""
    return {
        "componentType": _COMPONENTS[values.dtype.name],
        "count": len(values),
        "type": _SHAPES[values.shape[1:]],
        "min": _numbers(values.min(axis=0)) if bounds else None,
        "max": _numbers(values.max(axis=0)) if bounds else None,
    }


def _numbers(values: NDArray[Any]) -> list[float]:
    """Numbers in as few digits as tell them from others of their precision."""
    return [float(str(value)) for value in np.atleast_1d(values)]
