"""Write a face as a file that other programs read: one format a module, chosen by the suffix."""

from __future__ import annotations

from pathlib import Path

from pdeface.errors import InputError
from pdeface.face import Face
from pdeface.files import PathLike
from pdeface.formats._sample import sample
from pdeface.formats.gltf import write_glb, write_gltf
from pdeface.formats.obj import write_obj
from pdeface.formats.ply import write_ply
from pdeface.formats.stl import write_stl
from pdeface.pde import Join

__all__ = ["SUFFIXES", "export"]

_MESHES = (".glb", ".gltf", ".obj", ".ply", ".stl")
_WITH_QUADS = (".obj", ".ply")

SUFFIXES = (*_MESHES, ".pdeface")
"""Suffixes that :func:`export` knows."""


def export(
    face: Face,
    path: PathLike,
    mesh: tuple[int, int] = (28, 41),
    join: Join = "smooth",
    quads: bool | None = None,
) -> None:
    """Write ``face`` to ``path`` in the format that its suffix names.

    Metres, +Y up, +Z forward, with the normals of the analytic surface. ``.glb`` and ``.gltf``
    hold their texture; ``.obj`` and ``.ply`` get theirs beside them, ``me-texture.png`` for
    ``me.obj``, and ``.obj`` a ``.mtl``; ``.stl`` has none. ``.pdeface`` is :meth:`Face.save`,
    which no mesh concerns.

    Args:
        face: the face.
        path: the file to write. It appears last and whole, or stays as it was if anything fails.
        mesh: (rows, columns) of the uv mesh: samples from forehead to chin and ear to ear.
        join: ``"smooth"`` (C2) or ``"patchwise"`` (the paper's).
        quads: quads or triangles. By default OBJ has quads and PLY, whose quads many readers
            refuse, triangles; the other formats have triangles only.

    Raises:
        InputError: an unknown suffix, a mesh or join that the face cannot have, quads in a
            format without them, or a place that cannot be written.
        MissingExtraError: the face has a texture and Pillow is not installed.

    Example:
        >>> export(face, "me.glb", mesh=(109, 161))  # doctest: +SKIP
    """
    suffix = Path(path).suffix.lower()
    if suffix not in SUFFIXES:
        raise InputError(
            f"expected a file name that ends in {', '.join(SUFFIXES)}, got {Path(path).name!r}; "
            "the suffix picks the format"
        )
    if suffix == ".pdeface":
        face.save(path)
        return
    if quads and suffix not in _WITH_QUADS:
        raise InputError(
            f"quads can be written to {' and '.join(_WITH_QUADS)}, not to {suffix}; "
            "leave quads out for triangles"
        )
    surface = sample(face, mesh, join)
    if suffix == ".glb":
        write_glb(face, surface, path)
    elif suffix == ".gltf":
        write_gltf(face, surface, path)
    elif suffix == ".obj":
        write_obj(face, surface, path, quads=quads is not False)
    elif suffix == ".ply":
        write_ply(face, surface, path, quads=bool(quads))
    else:
        write_stl(surface, path)
