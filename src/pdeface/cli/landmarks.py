"""What the commands do with a photo that came without points: find them, and tell about it."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

from pdeface.cli.report import Report, size_in_words

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from pdeface.photo import PhotoFace

__all__ = ["face_in"]

_BAR = 24


def face_in(
    path: Path, photo: NDArray[np.uint8], number: int, model: Path | None, report: Report
) -> PhotoFace:
    """A face found in a photo; notes and warnings go to stderr.

    Args:
        path: the photo's file, for messages.
        photo: (H, W, 3 or 4) its pixels.
        number: which face, counted from the largest.
        model: MediaPipe's model; None for the default one.

    Raises:
        InputError: no such face, or no model.
        MissingExtraError: MediaPipe is not installed.
    """
    from pdeface.photo import choose, doubts, find_faces, model_file

    with report.step("looking for the face model") as show:
        file = model_file(model, _download(show))
    with report.step("looking for faces"):
        faces = find_faces(photo, file)
    face = choose(faces, number, str(path))
    if len(faces) > 1:
        report.note(_which(faces, number))
    for doubt in doubts(face, photo):
        report.warn(doubt)
    return face


def _which(faces: list[PhotoFace], number: int) -> str:
    """Which of several faces was taken, and how to take another."""
    taken = "the largest" if number == 1 else f"number {number} by size"
    x, y, _ = faces[number - 1].landmarks.mean(axis=0)
    others = ", ".join(str(n + 1) for n in range(len(faces)) if n + 1 != number)
    return (
        f"{len(faces)} faces found, took {taken}, at ({x:.0f}, {y:.0f}); --face {others} "
        f"{'takes the other' if len(faces) == 2 else 'take the others'}"
    )


def _download(show: Callable[[str], None]) -> Callable[[int, int], None]:
    """A function that shows how much of the model has come."""

    def progress(done: int, total: int) -> None:
        filled = min(_BAR, _BAR * done // max(total, 1))
        bar = "\u2501" * filled + "\u2500" * (_BAR - filled)
        show(f"fetching the face model {bar} {size_in_words(done)} of {size_in_words(total)}")

    return progress
