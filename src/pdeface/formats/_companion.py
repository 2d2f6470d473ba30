"""Files written beside an exported file: its texture, its materials."""

from __future__ import annotations

import re
from pathlib import Path

from pdeface.face import Face
from pdeface.files import PathLike, atomic_write
from pdeface.images import media_type

__all__ = ["name_beside", "texture_beside", "write_beside", "write_texture_beside"]

_SUFFIXES = {"image/png": ".png", "image/jpeg": ".jpg"}


def name_beside(path: PathLike, ending: str) -> str:
    """The name of a file beside ``path``: the stem and ``ending``.

    It has no white space, at which readers of OBJ and PLY would split it.
    """
    return re.sub(r"\s+", "_", Path(path).stem) + ending


def texture_beside(path: PathLike, face: Face) -> tuple[str, bytes] | None:
    """Name and content of the file for the face's texture beside ``path``, if it has one.

    ``me.obj`` gets ``me-texture.png``: a ``me.png`` there may be the photo that it came from.
    """
    data = face.texture_file()
    if data is None:
        return None
    return name_beside(path, f"-texture{_SUFFIXES[media_type(data)]}"), data


def write_beside(path: PathLike, name: str, data: bytes) -> str:
    """Write ``data`` under this name beside ``path``, and return the name."""
    atomic_write(Path(path).with_name(name), data)
    return name


def write_texture_beside(path: PathLike, face: Face) -> str | None:
    """Write the face's texture beside ``path``, if it has one, and return the file's name."""
    texture = texture_beside(path, face)
    return None if texture is None else write_beside(path, *texture)
