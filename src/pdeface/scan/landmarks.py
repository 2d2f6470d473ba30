"""Landmarks on a scan: the face is looked for from all sides, and then from its front."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pdeface.errors import InputError
from pdeface.files import PathLike
from pdeface.photo import PhotoFace, find_faces, glances
from pdeface.scan.alignment import Alignment, Landmarks, align, detected_uv
from pdeface.scan.pictures_of import clay, own_colours
from pdeface.scan.raster import Seen, look
from pdeface.scan.surface import Scan

__all__ = ["find_landmarks"]

FloatArray = NDArray[np.float64]
Look = Callable[[NDArray[np.uint8]], list[PhotoFace]]
Progress = Callable[[str], None]

_SIZE = 400
_FRONT = 560
_SURE, _POSSIBLE = 3.0e-3, 6.0e-3
"""Distance of the landmarks from a face's, on its own scale, of a find to go on with at once, and
of one to take if there is none better."""

_X, _Y, _Z = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)
_USUAL = (
    (_Z, _Y),
    ((0.0, -1.0, 0.0), _Z),
    ((0.0, 0.0, -1.0), _Y),
    (_Y, _Z),
    (_X, _Y),
    ((-1.0, 0.0, 0.0), _Y),
)
"""Forwards and up, as scans usually have them."""

_MOST_OUTLIERS = 0.4
_INLIERS = 0.78
_FACE_WIDTH = 0.24
"""Metres that a picture of a face from its front shows."""


@dataclass(frozen=True, eq=False)
class _Find:
    landmarks: Landmarks
    alignment: Alignment

    @property
    def sure(self) -> bool:
        return self.alignment.error < _SURE and self.alignment.inliers > _INLIERS


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
        best = _search(scan, detect, say)
        if best is not None:
            say("looking at the face from its front")
            for _ in range(2):
                best = _from_front(scan, detect, best)
            return best.landmarks
    best = _closely(scan, model, say)
    if best is None:
        raise InputError(
            "no face is found in the scan; give points on it with --landmarks (docs/scans.md)"
        )
    with glances(model) as detect:
        return _from_front(scan, detect, _from_front(scan, detect, best)).landmarks


def _search(scan: Scan, detect: Look, say: Progress) -> _Find | None:
    """The first sure find, or else the best possible one."""
    best: _Find | None = None
    centre, width = _middle(scan)
    for number, axes in enumerate(_directions()):
        say(f"looking for the face, from side {number + 1}")
        for find in _finds(scan, detect, axes, centre, width, _SIZE):
            if best is None or find.alignment.error < best.alignment.error:
                best = find
        if best is not None and best.sure:
            return best
    if best is None or best.alignment.error > _POSSIBLE:
        return None
    return best


def _closely(scan: Scan, model: PathLike | None, say: Progress) -> _Find | None:
    """A small face in a large scan: the many looks that a photo gets, along the axes."""
    centre, width = _middle(scan)
    best: _Find | None = None
    for number, axes in enumerate(_directions()):
        if number == len(_USUAL):
            break
        say(f"looking closely, from side {number + 1}")
        seen = look(scan, axes, centre, width, (1400, 1400))
        picture = own_colours(scan, seen) if scan.has_colors else clay(scan, seen, axes)
        for turn in range(4):
            for face in find_faces(np.rot90(picture, turn).copy(), model):
                find = _unprojected(face, seen, axes, centre, width, turn)
                if find and (best is None or find.alignment.error < best.alignment.error):
                    best = find
        if best is not None and best.sure:
            break
    return best if best is not None and best.alignment.error < _POSSIBLE else None


def _middle(scan: Scan) -> tuple[FloatArray, float]:
    low, high = np.percentile(scan.vertices[:: max(1, len(scan.vertices) // 50_000)], [1, 99], 0)
    return 0.5 * (low + high), 1.25 * float((high - low).max())


def _directions() -> Iterator[FloatArray]:
    """(3, 3) axes to look along: the scan's own, the usual first, then all around it."""
    for forward, up in _USUAL:
        yield _axes(np.array(forward), np.array(up))
    count = 40
    index = np.arange(count) + 0.5
    polar, azimuth = np.arccos(1.0 - 2.0 * index / count), np.pi * (1.0 + 5.0**0.5) * index
    around = np.stack(
        [np.cos(azimuth) * np.sin(polar), np.cos(polar), np.sin(azimuth) * np.sin(polar)], axis=1
    )
    for forward in around:
        up = np.eye(3)[1 if abs(forward[1]) < 0.8 else 0]
        axes = _axes(forward, up)
        yield axes
        yield _turned(axes, np.pi / 4)


def _axes(forward: FloatArray, up: FloatArray) -> FloatArray:
    right = np.cross(up, forward)
    right /= np.linalg.norm(right)
    return np.stack([right, np.cross(forward, right), forward])


def _turned(axes: FloatArray, angle: float) -> FloatArray:
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, s, 0.0], [-s, c, 0.0], [0.0, 0.0, 1.0]]) @ axes


def _finds(
    scan: Scan, detect: Look, axes: FloatArray, centre: FloatArray, width: float, size: int
) -> Iterator[_Find]:
    """What is found in pictures from one side, whichever way up."""
    seen = look(scan, axes, centre, width, (size, size))
    pictures = [clay(scan, seen, axes)]
    if scan.has_colors:
        pictures.insert(0, own_colours(scan, seen))
    for picture in pictures:
        for turn in range(4):
            for face in detect(np.rot90(picture, turn).copy())[:1]:
                find = _unprojected(face, seen, axes, centre, width, turn)
                if find is not None:
                    yield find
                    if find.sure:
                        return


def _from_front(scan: Scan, detect: Look, find: _Find) -> _Find:
    """The face looked at from its front; the find as it is if it is not seen better there."""
    axes = find.alignment.rotation
    width = _FACE_WIDTH / find.alignment.scale
    middle = np.array([0.0, 0.005, 0.08]) - find.alignment.shift
    centre = middle @ find.alignment.rotation / find.alignment.scale
    for closer in _finds(scan, detect, axes, centre, width, _FRONT):
        if closer.alignment.inliers > find.alignment.inliers - 0.1:
            return closer
    return find


def _unprojected(
    face: PhotoFace, seen: Seen, axes: FloatArray, centre: FloatArray, width: float, turn: int
) -> _Find | None:
    """The landmarks on the surface where they are seen, if enough of them are."""
    size = len(seen.item)
    xy = face.landmarks[:468, :2]
    for _ in range(turn):  # back from a picture that was turned to the left
        xy = np.stack([size - xy[:, 1], xy[:, 0]], axis=1)
    depth, good = _depth(seen, xy)
    if good.mean() < 1.0 - _MOST_OUTLIERS:
        return None
    scale = width / size
    across = np.stack([(xy[:, 0] - 0.5 * size) * scale, (0.5 * size - xy[:, 1]) * scale, depth], 1)
    uv, trust = detected_uv()
    landmarks = Landmarks(uv, across @ axes + centre, np.where(good, trust, 0.0))
    return _Find(landmarks, align(landmarks))


def _depth(seen: Seen, xy: FloatArray) -> tuple[FloatArray, NDArray[np.bool_]]:
    """Depth in the middle of the four pixels about each place, and where there is any."""
    rows, columns = seen.depth.shape
    x, y = (np.floor(xy[:, k] - 0.5).astype(np.int64) for k in (0, 1))
    inside = (x >= 0) & (y >= 0) & (x < columns - 1) & (y < rows - 1)
    x, y = x.clip(0, columns - 2), y.clip(0, rows - 2)
    four = np.stack([seen.depth[y + j, x + i] for j in (0, 1) for i in (0, 1)])
    good = inside & np.isfinite(four).all(axis=0)
    return np.where(good, np.median(np.where(good, four, 0.0), axis=0), 0.0), good
