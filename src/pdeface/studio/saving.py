"""A face as the bytes of a file, by way of a folder of the server's own."""

from __future__ import annotations

import io
import zipfile
from pathlib import Path
from tempfile import TemporaryDirectory

from pdeface.errors import InputError
from pdeface.face import Face
from pdeface.formats import SUFFIXES, SUFFIXES_THAT_MOVE, export
from pdeface.pde import Join

__all__ = ["MOST_EXPORTED", "exported", "saved"]

MOST_EXPORTED = 1_000_000
"""Vertices of an exported mesh, at most; the command line writes larger ones."""

_TYPES = {".glb": "model/gltf-binary", ".vrm": "model/gltf-binary"}


def saved(face: Face) -> bytes:
    """The bytes of the face's ``.pdeface`` file."""
    with TemporaryDirectory(prefix="pdeface-") as folder:
        path = Path(folder) / "face.pdeface"
        face.save(path)
        return path.read_bytes()


def exported(
    face: Face,
    suffix: str,
    mesh: tuple[int, int],
    join: Join,
    expressions: bool,
    visemes: bool,
) -> tuple[bytes, str]:
    """The bytes of an exported file and their media type; several files come as a ZIP.

    Args:
        face: the face.
        suffix: of the format, or ``".png"`` for the texture.
        mesh: (rows, columns).
        join: of the surface.
        expressions, visemes: whether they become morph targets, where the format has them.

    Raises:
        InputError: no such format, a mesh that is too fine, or no texture to write.
    """
    if suffix == ".png":
        return _texture(face), "image/png"
    if suffix not in SUFFIXES:
        raise InputError(f"a face is exported as {', '.join(SUFFIXES)}, got {suffix!r}; choose one")
    if suffix == ".pdeface":
        return saved(face), "application/octet-stream"
    if mesh[0] * mesh[1] > MOST_EXPORTED:
        raise InputError(
            f"the studio writes {MOST_EXPORTED:,} vertices at most, got {mesh[0]} x {mesh[1]}; "
            "use pdeface export"
        )
    moving = suffix in SUFFIXES_THAT_MOVE
    targets = (None if expressions else ()) if moving else None
    with TemporaryDirectory(prefix="pdeface-") as folder:
        path = Path(folder) / f"face{suffix}"
        export(face, path, mesh=mesh, join=join, expressions=targets, visemes=moving and visemes)
        files = sorted(Path(folder).iterdir())
        if len(files) == 1:
            return path.read_bytes(), _TYPES.get(suffix, "application/octet-stream")
        return _zipped(files), "application/zip"


def _texture(face: Face) -> bytes:
    from pdeface.images import encode_png

    if face.texture is None:
        raise InputError("this face has no texture to write; open a photo first")
    return encode_png(face.texture)


def _zipped(files: list[Path]) -> bytes:
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w", zipfile.ZIP_DEFLATED) as archive:
        for file in files:
            archive.write(file, file.name)
    return stream.getvalue()
