"""A film of a moving face: the pictures of its frames as an MP4 that every browser plays."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from pdeface.controls.neck import PIVOT, rotations
from pdeface.errors import InputError
from pdeface.face import Face
from pdeface.files import PathLike, atomic_path
from pdeface.pde import Join
from pdeface.pictures.camera import View, frame
from pdeface.pictures.canvas import picture_of
from pdeface.pictures.encoder import Encoder
from pdeface.pictures.ground import STUDIO, background_image, over
from pdeface.pictures.options import PAPER_MESH, Options, check_size
from pdeface.pictures.styles import style_named

__all__ = ["SUFFIX", "film"]

Frames = Sequence[tuple[Face, NDArray[np.float64]]]
"""A face and the (3,) yaw, pitch and roll of its head, radians, for each frame."""

SUFFIX: Final = ".mp4"
STYLES: Final = ("textured", "shaded", "uvmesh")
"""The styles that draw nothing but the uv mesh, which turns with the head."""

MESH: Final = (109, 121)
"""As fine as anybody sees in motion; the creases of every level are edges of it."""


def film(
    frames: Frames,
    path: PathLike,
    rate: float = 30.0,
    view: View = "front",
    style: str | None = None,
    mesh: tuple[int, int] | None = None,
    join: Join = "smooth",
    size: tuple[int, int] = (720, 900),
    background: Any = STUDIO,
    *,
    light: str | None = None,
    progress: Callable[[int], None] | None = None,
) -> None:
    """Draw every frame and write them as a film, without sound (H.264, 4:2:0, in an MP4).

    The camera stands still, where it has the face in the picture throughout.

    Args:
        frames: the face in each frame, with its head's angles (:class:`pdeface.motion.Frames`).
        path: the ``.mp4`` to write. It appears last and whole, or not at all.
        rate: frames a second.
        view, join, background, light: as for :func:`pdeface.render`.
        style: ``"textured"``, ``"shaded"`` or ``"uvmesh"``; None for the first of a face with a
            texture and the second of one without.
        mesh: (rows, columns) of the uv mesh; None for 28 x 41 in style ``"uvmesh"`` and for one
            too fine to see in the others.
        size: (width, height), pixels, both even.
        progress: called with the number of each frame, from 1, before it is drawn.

    Raises:
        InputError: no frames, another suffix, an odd size, a rate, view, style or light that there
            is not, or a place that cannot be written.
        MissingExtraError: imageio-ffmpeg or Pillow is not installed.

    Example:
        >>> from pdeface import motion
        >>> frames = motion.Frames(face, motion.clip("talk"), rate=30)  # doctest: +SKIP
        >>> film(frames, "talk.mp4", rate=30)  # doctest: +SKIP
    """
    if Path(path).suffix.lower() != SUFFIX:
        raise InputError(f"a film is written as {SUFFIX}, got {Path(path).name!r}; end its name so")
    if not len(frames):
        raise InputError("a film needs a frame at least, got none; give a track with samples")
    size = _check_even(check_size(size))
    name, draw = style_named(style, frames[0][0])
    if name not in STYLES:
        raise InputError(f"the style of a film is one of {', '.join(STYLES)}, got {name!r}")
    mesh = mesh or (PAPER_MESH if name == "uvmesh" else MESH)
    options = Options(mesh=mesh, join=join, light=light)
    ground = background_image(background, size)
    with atomic_path(path) as temporary:
        encoder = Encoder(temporary, size, rate)  # which may be missing, before any work is done
        camera = frame(_reach(frames), view, size[0] / size[1])
        with encoder:
            for number, (face, head) in enumerate(frames, 1):
                if progress:
                    progress(number)
                solids = draw(face, camera, replace(options, head=head))
                encoder.add(over(picture_of(solids, camera, size), ground), number)


def _reach(frames: Frames) -> NDArray[np.float64]:
    """(D, 3) the points that get farthest in each of many directions in all the frames, metres."""
    directions = _directions()
    farthest = np.full(len(directions), -np.inf)
    reached = np.zeros((len(directions), 3))
    for face, head in frames:
        points = face.mesh(*PAPER_MESH).turned(rotations(head), PIVOT).vertices
        far = points @ directions.T
        which = far.argmax(axis=0)
        better = far.max(axis=0) > farthest
        farthest = np.maximum(farthest, far.max(axis=0))
        reached[better] = points[which[better]]
    return reached


def _directions(count: int = 256) -> NDArray[np.float64]:
    """(D, 3) unit vectors, evenly over the sphere: a golden spiral from pole to pole."""
    height = 1.0 - (2.0 * np.arange(count) + 1.0) / count
    angle = np.pi * (3.0 - 5.0**0.5) * np.arange(count)
    radius = np.sqrt(1.0 - height**2)
    return np.stack([radius * np.cos(angle), height, radius * np.sin(angle)], axis=1)


def _check_even(size: tuple[int, int]) -> tuple[int, int]:
    """Colours are stored for every second pixel of a row and of a column."""
    if size[0] % 2 or size[1] % 2 or min(size) < 16:
        raise InputError(
            f"a film's width and height are even and 16 or more, got {size[0]}x{size[1]}; "
            "try 720x900"
        )
    return size
