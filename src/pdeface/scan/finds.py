"""Faces that are found in pictures of a scan, back on the scan."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pdeface.photo import PhotoFace
from pdeface.scan.alignment import Alignment, Landmarks, align, detected_uv
from pdeface.scan.pictures_of import clay, own_colours
from pdeface.scan.raster import Seen, look
from pdeface.scan.surface import Scan

__all__ = ["Find", "Look", "finds", "finds_closely"]

FloatArray = NDArray[np.float64]
Pixels = NDArray[np.uint8]
Look = Callable[[Pixels], list[PhotoFace]]

_SURE, _POSSIBLE = 3.0e-3, 6.0e-3
"""Distance of the landmarks from a face's, on its own scale, of a find to go on with at once, and
of one to take if there is none better."""

_NO_FACE = 12.0e-3
"""The same, of the neutral face, from which on it is not worth while to ask for identities."""

_MOST_OUTLIERS = 0.4
_INLIERS, _MET = 0.78, 0.65
"""Share of the landmarks within 6 mm of a find to go on with at once; and, of those that are seen,
of one to take. Heads have 0.85 and more, a ball has half."""

_CLOSE, _TILE, _STRIDE = 1400, 560, 280


@dataclass(frozen=True, eq=False)
class Find:
    """Landmarks found on a scan, and the face aligned to them."""

    landmarks: Landmarks
    alignment: Alignment

    @property
    def sure(self) -> bool:
        """Whether it need not be looked for any further."""
        return self.alignment.error < _SURE and self.alignment.inliers > _INLIERS

    @property
    def possible(self) -> bool:
        """Whether it may be a face: balls and rings too are near to some of a face's landmarks."""
        seen = float((self.landmarks.trust > 0.0).mean())
        return self.alignment.error < _POSSIBLE and self.alignment.inliers > _MET * seen


def finds(
    scan: Scan, detect: Look, axes: FloatArray, centre: FloatArray, width: float, size: int
) -> Iterator[Find]:
    """What is found in pictures from one side, whichever way up; a sure find ends it.

    Args:
        axes, centre, width, size: as for :func:`pdeface.scan.raster.look`.
    """
    seen = look(scan, axes, centre, width, (size, size))
    pictures = [clay(scan, seen, axes)]
    if scan.has_colors:
        pictures.insert(0, own_colours(scan, seen))
    for picture in pictures:
        for turn in range(4):
            for face in detect(np.rot90(picture, turn).copy())[:1]:
                find = _unprojected(face, (0, 0), seen, axes, centre, width, turn)
                if find is not None:
                    yield find
                    if find.sure:
                        return


def finds_closely(
    scan: Scan, detect: Look, axes: FloatArray, centre: FloatArray, width: float
) -> Iterator[Find]:
    """The same in a large picture, looked at piece by piece: a small face in a large scan."""
    seen = look(scan, axes, centre, width, (_CLOSE, _CLOSE))
    picture = own_colours(scan, seen) if scan.has_colors else clay(scan, seen, axes)
    for turn in range(4):
        turned, there = np.rot90(picture, turn), np.rot90(seen.item >= 0, turn)
        for top in range(0, _CLOSE - _TILE + 1, _STRIDE):
            for left in range(0, _CLOSE - _TILE + 1, _STRIDE):
                part = slice(top, top + _TILE), slice(left, left + _TILE)
                # A face is in the middle of one of the pieces, which overlap by half.
                middle = there[part][_TILE // 4 : -_TILE // 4, _TILE // 4 : -_TILE // 4]
                if not middle.any():
                    continue
                for face in detect(turned[part].copy())[:1]:
                    find = _unprojected(face, (left, top), seen, axes, centre, width, turn)
                    if find is not None:
                        yield find


def _unprojected(
    face: PhotoFace,
    corner: tuple[int, int],
    seen: Seen,
    axes: FloatArray,
    centre: FloatArray,
    width: float,
    turn: int,
) -> Find | None:
    """The landmarks on the surface where they are seen, if enough of them are."""
    size = len(seen.item)
    xy = face.landmarks[:468, :2] + corner
    for _ in range(turn):  # back from a picture that was turned to the left
        xy = np.stack([size - xy[:, 1], xy[:, 0]], axis=1)
    depth, good = _depth(seen, xy)
    if good.mean() < 1.0 - _MOST_OUTLIERS:
        return None
    scale = width / size
    across = np.stack([(xy[:, 0] - 0.5 * size) * scale, (0.5 * size - xy[:, 1]) * scale, depth], 1)
    uv, trust = detected_uv()
    landmarks = Landmarks(uv, across @ axes + centre, np.where(good, trust, 0.0))
    if align(landmarks, identity=False).error > _NO_FACE:
        return None
    return Find(landmarks, align(landmarks))


def _depth(seen: Seen, xy: FloatArray) -> tuple[FloatArray, NDArray[np.bool_]]:
    """Depth in the middle of the four pixels about each place, and where there is any."""
    rows, columns = seen.depth.shape
    x, y = (np.floor(xy[:, k] - 0.5).astype(np.int64) for k in (0, 1))
    inside = (x >= 0) & (y >= 0) & (x < columns - 1) & (y < rows - 1)
    x, y = x.clip(0, columns - 2), y.clip(0, rows - 2)
    four = np.stack([seen.depth[y + j, x + i] for j in (0, 1) for i in (0, 1)])
    good = inside & np.isfinite(four).all(axis=0)
    return np.where(good, np.median(np.where(good, four, 0.0), axis=0), 0.0), good
