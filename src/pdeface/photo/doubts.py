"""What of a photo makes it a poor one to make a face from."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from pdeface.photo.found import PhotoFace

__all__ = ["doubts"]

_SMALL = 60.0
"""Pixels between the eyes below which the texture is visibly soft."""

_DARK = 50.0
"""Median brightness of the face, of 255, below which the photo is too dark."""

_TURNED = math.radians(20.0)
_CLOSED = 0.5
_LUMA = (0.2126, 0.7152, 0.0722)


def doubts(face: PhotoFace, photo: NDArray[np.uint8]) -> list[str]:
    """One line for each thing that the photo lacks; none for a good one.

    Args:
        face: found in the photo.
        photo: (H, W, 3 or 4) uint8.
    """
    found = []
    if face.eye_distance < _SMALL:
        found.append(
            f"the face is small, {face.eye_distance:.0f} pixels from eye to eye, and its texture "
            f"will be soft; {_SMALL:.0f} or more are better"
        )
    if (light := _brightness(face, photo)) < _DARK:
        found.append(f"the face is dark, {light:.0f} of 255; use a photo with more light")
    sideways, up = face.yaw, face.pitch
    if max(abs(sideways), abs(up)) > _TURNED:
        found.append(
            f"the head is turned, {abs(math.degrees(sideways)):.0f} degrees to its "
            f"{'left' if sideways > 0 else 'right'} and {abs(math.degrees(up)):.0f} "
            f"{'up' if up > 0 else 'down'}; a photo from the front is better"
        )
    closed = [s for s in ("right", "left") if face.scores[f"eyeBlink{s.title()}"] > _CLOSED]
    if closed:
        eyes = "both eyes are" if len(closed) == 2 else f"the {closed[0]} eye is"
        found.append(f"{eyes} closed, or nearly so; the open lids will show skin for an eye")
    return found


def _brightness(face: PhotoFace, photo: NDArray[np.uint8]) -> float:
    """Median brightness of the pixels at the landmarks that lie in the photo."""
    height, width = photo.shape[:2]
    column, row = np.floor(face.landmarks[:, :2]).astype(int).T
    inside = (row >= 0) & (row < height) & (column >= 0) & (column < width)
    if not inside.any():
        return 255.0
    return float(np.median(photo[row[inside], column[inside], :3] @ np.array(_LUMA)))
