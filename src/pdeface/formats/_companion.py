"""Files written beside an exported file: its texture, its materials."""

from __future__ import annotations

import re
from pathlib import Path

from pdeface.face import Face
from pdeface.files import PathLike, atomic_write
from pdeface.images import media_type

__all__ = ["write_beside", "write_texture_beside"]

_SUFFIXES = {"image/png": ".png", "image/jpeg": ".jpg"}


def write_beside(path: PathLike, ending: str, data: bytes) -> str:
    """Write ``data`` beside ``path`` and return the file's name: the stem and ``ending``.

    The name has no white space, at which readers of OBJ and PLY would split it.
    """
    name = re.sub(r"\s+", "_", Path(path).stem) + ending
    atomic_write(Path(path).with_name(name), data)
    return name


def write_texture_beside(path: PathLike, face: Face) -> str | None:
    """Write the face's texture beside ``path``, if it has one, and return the file's name.

    ``me.obj`` gets ``me-texture.png``: a ``me.png`` there may be the photo that it came from.
    """
    data = face.texture_file()
    if data is None:
        return None
    return write_beside(path, f"-texture{_SUFFIXES[media_type(data)]}", data)
