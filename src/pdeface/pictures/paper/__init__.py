"""The figures of the paper, redrawn with this project's data."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path

from pdeface.errors import InputError
from pdeface.face import Face
from pdeface.files import PathLike, atomic_write
from pdeface.pictures.image_file import write_image
from pdeface.pictures.paper.figure1 import figure1
from pdeface.pictures.paper.figure2 import figure2
from pdeface.pictures.paper.figure3 import figure3
from pdeface.pictures.paper.figure4 import figure4
from pdeface.pictures.paper.figure5 import figure5
from pdeface.pictures.paper.figure6 import figure6
from pdeface.pictures.paper.figure8 import figure8
from pdeface.pictures.paper.figure9 import figure9
from pdeface.pictures.paper.page import page
from pdeface.pictures.paper.panels import Figure
from pdeface.texture import UVTexture

__all__ = ["PAGE", "paper"]

PAGE = "README.md"
"""Name of the page beside the figures."""

CURVES = 28


def paper(
    directory: PathLike,
    face: Face | None = None,
    progress: Callable[[str], None] | None = None,
) -> list[Path]:
    """Redraw Figs 1 to 6, 8 and 9 of the paper, and write a page that compares them with it.

    Args:
        directory: folder for the files; made if need be.
        face: a face of 28 curves for Figs 2, 3, 8 and 9; None for the neutral one, 28 x 46.
        progress: called with a line of text before each figure.

    Returns:
        The files written, the page last.

    Raises:
        InputError: another number of curves, or a folder that cannot be written.
        MissingExtraError: what draws pictures or warps photos is not installed.
    """
    face = _neutral() if face is None else face
    if face.curves.shape[0] != CURVES:
        raise InputError(
            f"the paper's figures are of {CURVES} curves, got a face of {face.curves.shape[0]}; "
            "use pdeface.neutral('28x46')"
        )
    folder = _made(directory)
    figures: list[Figure] = []
    written: list[Path] = []
    for number, draw in _drawings(face):
        if progress:
            progress(f"drawing Fig. {number}")
        figures.append(draw())
        written.append(folder / figures[-1].file_name)
        write_image(written[-1], figures[-1].image)
    written.append(folder / PAGE)
    atomic_write(written[-1], page(figures).encode())
    return written


def _drawings(face: Face) -> Iterator[tuple[int, Callable[[], Figure]]]:
    """(number, function that draws it) of each figure; the photo is warped when it is needed."""
    yield 1, figure1
    yield 2, lambda: figure2(face)
    yield 3, lambda: figure3(face)
    steps = _portrait_steps()
    yield 4, lambda: figure4(_neutral(), steps)
    yield 5, lambda: figure5(steps)
    yield 6, lambda: figure6(steps)
    yield 8, lambda: figure8(face)
    yield 9, lambda: figure9(face, steps)


def _made(directory: PathLike) -> Path:
    folder = Path(directory)
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise InputError(
            f"cannot make the folder {directory}: {error.strerror}; choose another place"
        ) from error
    return folder


def _neutral() -> Face:
    from pdeface.face import neutral

    return neutral("28x46")


def _portrait_steps() -> UVTexture:
    from pdeface.texture import portrait, uv_texture

    return uv_texture(*portrait(), margins=False)
