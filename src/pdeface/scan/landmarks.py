"""Landmarks on a scan: the face is looked for from all sides, and then from its front."""

from __future__ import annotations

from collections.abc import Callable, Iterator

import numpy as np
from numpy.typing import NDArray

from pdeface.errors import InputError
from pdeface.files import PathLike
from pdeface.photo import glances
from pdeface.scan.alignment import Landmarks
from pdeface.scan.finds import Find, Look, finds, finds_closely
from pdeface.scan.sides import around, usual
from pdeface.scan.surface import Scan
from pdeface.scan.thinning import thinned

__all__ = ["find_landmarks"]

FloatArray = NDArray[np.float64]
Progress = Callable[[str], None]

_SIZE, _AROUND, _FRONT = 400, 240, 560
"""Pixels of pictures along the axes, from all around, and from the face's front."""

_CELL = 1.0, 2.0
"""Pixels, of a mesh's pictures and of a cloud's, in which one vertex does."""

_SMALL = 10_000
"""Vertices of a scan up to which a face that is a small part of it has too few."""

_FACE_WIDTH = 0.24
"""Metres that a picture of a face from its front shows."""


def find_landmarks(
    scan: Scan, model: PathLike | None = None, progress: Progress | None = None
) -> Landmarks:
    """MediaPipe's landmarks on a scan of any scale in any orientation.

    The scan is drawn in parallel projection along its axes, any of them up, and then from all
    around; in its own colours and in clay. The best find is looked at again, twice, from its front.

    Args:
        model: MediaPipe's model; None for the one that :func:`pdeface.photo.model_file` finds.
        progress: called with a line of text now and then.

    Raises:
        InputError: no face is found.
        MissingExtraError: MediaPipe is not installed.
    """
    say = progress or (lambda text: None)
    with glances(model) as detect:
        best = _best(_looks(scan, detect, say))
        if best is None and len(scan.vertices) > _SMALL:
            best = _best(_close_looks(scan, detect, say))
        if best is None:
            raise InputError(
                "no face is found in the scan; give points on it with --landmarks (docs/scans.md)"
            )
        say("looking at the face from its front")
        close = _about(scan, best)
        for _ in range(2):
            best = _from_front(close, detect, best)
        return best.landmarks


def _best(looks: Iterator[list[Find]]) -> Find | None:
    """The best find up to the first side from which one is sure; None if none is possible."""
    best: Find | None = None
    for found in looks:
        for find in found:
            if best is None or find.alignment.error < best.alignment.error:
                best = find
        if best is not None and best.sure:
            return best
    return best if best is not None and best.possible else None


def _looks(scan: Scan, detect: Look, say: Progress) -> Iterator[list[Find]]:
    """What is found from one side after another."""
    centre, width = _middle(scan)
    thin = thinned(scan, _CELL[scan.is_cloud] * width / _SIZE)
    number = 0
    for sides, size in ((usual(), _SIZE), (around(), _AROUND)):
        for axes in sides:
            number += 1
            say(f"looking for the face, from side {number}")
            yield list(finds(thin, detect, axes, centre, width, size))


def _close_looks(scan: Scan, detect: Look, say: Progress) -> Iterator[list[Find]]:
    """What is found along the axes of a small face in a large scan."""
    centre, width = _middle(scan)
    for number, axes in enumerate(usual()):
        say(f"looking closely, from side {number + 1}")
        yield list(finds_closely(scan, detect, axes, centre, width))


def _middle(scan: Scan) -> tuple[FloatArray, float]:
    low, high = np.percentile(scan.vertices[:: max(1, len(scan.vertices) // 50_000)], [1, 99], 0)
    return 0.5 * (low + high), 1.25 * float((high - low).max())


def _front(find: Find) -> tuple[FloatArray, FloatArray, float]:
    """Axes, centre and width of a picture of a face from its front."""
    axes, scale = find.alignment.rotation, find.alignment.scale
    middle = np.array([0.0, 0.005, 0.08]) - find.alignment.shift
    return axes, middle @ axes / scale, _FACE_WIDTH / scale


def _about(scan: Scan, find: Find) -> Scan:
    """What of a scan the picture of a face from its front may show."""
    _, centre, width = _front(find)
    near = np.linalg.norm(scan.vertices - centre, axis=1) < width
    return thinned(scan.part(near), _CELL[scan.is_cloud] * width / _FRONT)


def _from_front(scan: Scan, detect: Look, find: Find) -> Find:
    """The face looked at from its front; the find as it is if it is not seen better there."""
    for closer in finds(scan, detect, *_front(find), _FRONT):
        if closer.alignment.inliers > find.alignment.inliers - 0.1:
            return closer
    return find
