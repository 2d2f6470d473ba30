"""A moving face as a numbered OBJ a frame, for programs that read no morph targets.

All frames have the same vertices in the same order, and share one material and one texture.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from pdeface.errors import InputError
from pdeface.face import Face
from pdeface.files import PathLike, atomic_batch
from pdeface.formats._companion import name_beside, texture_beside
from pdeface.formats._sample import sample
from pdeface.formats.obj import material, obj_text
from pdeface.pde import Join

__all__ = ["export_sequence"]

Frames = Sequence[tuple[Face, NDArray[np.float64]]]
"""A face and the (3,) yaw, pitch and roll of its head, radians, for each frame."""


def export_sequence(
    frames: Frames,
    path: PathLike,
    mesh: tuple[int, int] = (28, 41),
    join: Join = "smooth",
    quads: bool = True,
    progress: Callable[[int], None] | None = None,
) -> list[Path]:
    """Write ``me.0001.obj``, ``me.0002.obj``, ... for ``me.obj``: all of them or none.

    Args:
        frames: the face in each frame, with its head's angles (:class:`pdeface.motion.Frames`). The
            texture is that of the first.
        path: ``me.obj``, whose name and folder the frames have.
        mesh: (rows, columns) of the uv mesh.
        join: ``"smooth"`` (C2) or ``"patchwise"`` (the paper's).
        quads: quads or triangles.
        progress: called with the number of each frame, from 1, before it is made.

    Returns:
        The OBJ files, in order.

    Raises:
        InputError: another suffix, no frames, a mesh or a face that cannot be, frames of an
            earlier and longer sequence in the way, or a place that cannot be written.
        MissingExtraError: the face has a texture and Pillow is not installed.

    Example:
        >>> from pdeface import motion
        >>> frames = motion.Frames(face, motion.clip("talk"), rate=24)  # doctest: +SKIP
        >>> export_sequence(frames, "talk.obj")  # doctest: +SKIP
    """
    target = Path(path)
    if target.suffix.lower() != ".obj":
        raise InputError(
            f"a sequence is written as .obj, got {target.name!r}; end its name in .obj"
        )
    if not len(frames):
        raise InputError("a sequence needs a frame at least, got none; give a track with samples")
    files = [target.with_name(f"{target.stem}.{n + 1:04d}.obj") for n in range(len(frames))]
    _check_no_others(target, files)
    with atomic_batch() as write:
        texture = texture_beside(target, frames[0][0])
        if texture is not None:
            write(target.with_name(texture[0]), texture[1])
        library = name_beside(target, ".mtl")
        write(target.with_name(library), material(texture[0] if texture else None))
        for number, (file, (face, head)) in enumerate(zip(files, frames, strict=True), 1):
            if progress:
                progress(number)
            surface = sample(face, mesh, join, head=head)
            write(file, obj_text(surface, library, quads=quads))
    return files


def _check_no_others(target: Path, files: Sequence[Path]) -> None:
    """Frames left of a longer sequence would be played after these."""
    pattern = re.compile(re.escape(target.stem) + r"\.\d{4,}\.obj")
    names = {file.name for file in files}
    there = target.parent.iterdir() if target.parent.is_dir() else ()
    others = sorted(p.name for p in there if pattern.fullmatch(p.name) and p.name not in names)
    if others:
        raise InputError(
            f"{target.parent} holds {others[0]} of another sequence, which would follow on the "
            f"{len(files)} frames of this one; delete it, or use another name or folder"
        )
