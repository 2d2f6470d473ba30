"""Wavefront OBJ with its MTL and its texture: text that every 3D program reads."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from pdeface.face import Face
from pdeface.files import PathLike, atomic_write
from pdeface.formats._companion import name_beside, write_beside, write_texture_beside
from pdeface.formats._sample import Sample
from pdeface.formats._shared import GENERATOR, SKIN

__all__ = ["material", "obj_text", "write_obj"]


def write_obj(face: Face, surface: Sample, path: PathLike, *, quads: bool = True) -> None:
    """Write an OBJ, and beside it ``.mtl`` and, if the face has one, its texture.

    Texture coordinates have their origin at the bottom left, as readers of OBJ expect.

    Raises:
        InputError: a place that cannot be written.
    """
    texture = write_texture_beside(path, face)
    library = write_beside(path, name_beside(path, ".mtl"), material(texture))
    atomic_write(path, obj_text(surface, library, quads=quads))


def obj_text(surface: Sample, library: str, *, quads: bool = True) -> bytes:
    """The content of an OBJ whose material lies in the file ``library`` beside it."""
    cells = surface.quads if quads else surface.triangles
    text = [
        f"# {GENERATOR}, metres, +Y up, +Z forward\nmtllib {library}\no face\n",
        _lines("v %.9g %.9g %.9g\n", surface.vertices),
        _lines("vt %.9g %.9g\n", surface.texcoords_from_below),
        _lines("vn %.9g %.9g %.9g\n", surface.normals),
        "usemtl face\ns 1\n",
        _faces(cells),
        _faces(surface.fans) if quads else "",
    ]
    return "".join(text).encode()


def _faces(cells: NDArray[np.int32]) -> str:
    # The three lists run in step, so that a corner is the same number three times, from 1.
    corner = " %d/%d/%d" * cells.shape[1]
    return _lines(f"f{corner}\n", np.repeat(cells + 1, 3, axis=1))


def _lines(pattern: str, values: NDArray[np.generic]) -> str:
    """One line a row. One big format is 6 times faster than ``np.savetxt``."""
    return pattern * len(values) % tuple(values.ravel().tolist())


def material(texture: str | None) -> bytes:
    """The content of an MTL: skin that does not shine, with a texture of this name or none."""
    lines = [f"# {GENERATOR}", "newmtl face", "Ka 0 0 0", "Ks 0 0 0", "d 1", "illum 1"]
    if texture is None:
        lines.append("Kd {:.3f} {:.3f} {:.3f}".format(*SKIN))
    else:
        lines += ["Kd 1 1 1", f"map_Kd {texture}"]
    return "\n".join([*lines, ""]).encode()
