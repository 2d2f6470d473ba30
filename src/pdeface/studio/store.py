"""Faces, photos and geometries that the server keeps by id. All of it can be sent anew."""

from __future__ import annotations

import hashlib
import threading
from collections import OrderedDict
from typing import Generic, TypeVar

import numpy as np

from pdeface.errors import InputError
from pdeface.face import Face
from pdeface.pde import Join
from pdeface.studio.geometry import Geometry
from pdeface.studio.schema import FaceInfo

__all__ = ["FaceStore", "Kept", "describe", "face_id"]

Value = TypeVar("Value")

_FACES, _GEOMETRIES = 64, 3


class Kept(Generic[Value]):
    """The values used last, by key; safe between threads.

    Args:
        most: how many are kept.
        what: what messages call one.
    """

    def __init__(self, most: int, what: str) -> None:
        self._values: OrderedDict[str, Value] = OrderedDict()
        self._most, self._what, self._lock = most, what, threading.Lock()

    def put(self, key: str, value: Value) -> None:
        """Keep a value, and forget the one that was not used for longest if there are too many."""
        with self._lock:
            self._values[key] = value
            self._values.move_to_end(key)
            while len(self._values) > self._most:
                self._values.popitem(last=False)

    def get(self, key: str) -> Value:
        """The value of a key.

        Raises:
            InputError: none is kept.
        """
        with self._lock:
            if key not in self._values:
                raise InputError(f"the server knows no {self._what} {key[:32]!r}; send it again")
            self._values.move_to_end(key)
            return self._values[key]

    def __contains__(self, key: str) -> bool:
        return key in self._values


class FaceStore:
    """Faces by the hash of what they are, and their geometry on the uv meshes in use."""

    def __init__(self) -> None:
        self._faces: Kept[Face] = Kept(_FACES, "face")
        self._geometries: Kept[Geometry] = Kept(_GEOMETRIES, "mesh")

    def put(self, face: Face) -> FaceInfo:
        """Keep a face and describe it."""
        info = describe(face)
        self._faces.put(info.id, face)
        return info

    def get(self, key: str) -> Face:
        """The face of an id.

        Raises:
            InputError: the server does not know it (any more).
        """
        return self._faces.get(key)

    def __contains__(self, key: str) -> bool:
        return key in self._faces

    def geometry(self, key: str, rows: int, columns: int, join: Join = "smooth") -> Geometry:
        """The geometry of a face on a uv mesh.

        Raises:
            InputError: an unknown face, or a mesh that is too fine.
        """
        name = f"{key}/{rows}x{columns}/{join}"
        if name not in self._geometries:
            self._geometries.put(name, Geometry(self.get(key), rows, columns, join))
        return self._geometries.get(name)


def face_id(face: Face) -> str:
    """Sixteen digits that differ with the curves, the texture and how they make a surface."""
    digest = hashlib.sha256(face.curves.points.tobytes())
    digest.update(f"{face.curves.mirror_z}/{face.a}/{face.modes}".encode())
    digest.update(_texture_id(face).encode())
    return digest.hexdigest()[:16]


def _texture_id(face: Face) -> str:
    if face.texture is None:
        return ""
    digest = hashlib.sha256(repr(face.texture.shape).encode())
    digest.update(np.ascontiguousarray(face.texture).tobytes())
    return digest.hexdigest()[:16]


def describe(face: Face) -> FaceInfo:
    """What the page is told of a face."""
    curves, points = face.curves.shape
    return FaceInfo(
        face_id(face),
        face.name,
        dict(face.weights),
        _texture_id(face),
        curves,
        points,
    )
