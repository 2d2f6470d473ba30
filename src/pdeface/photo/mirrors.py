"""A face looked at in the mirror as well.

The detector does not see a picture's mirror image as the mirror image of what it sees in the
picture. Half of the difference is chance, so that the mean of both is nearer to the face.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from pdeface.photo.found import PhotoFace
from pdeface.photo.regression import learnt

__all__ = ["ACROSS", "evened", "other_side", "partners", "unmirrored"]

FloatArray = NDArray[np.float64]

ACROSS = np.array([-1.0, 1.0, 1.0])
"""What a mirror does to x, y and z."""

_NEAR = 0.25
"""Of a face's size: how far its finds may be apart."""


def unmirrored(face: PhotoFace, axis: float) -> PhotoFace:
    """A face found in a mirror image, as it is in the photo.

    Args:
        face: found in the mirror image.
        axis: x that the mirror leaves where it is, pixels.
    """
    places = face.landmarks[_partners()] * ACROSS + (2.0 * axis, 0.0, 0.0)
    mirror = np.diag((*ACROSS, 1.0))
    scores = {other_side(name): score for name, score in face.scores.items()}
    return PhotoFace(places, scores, mirror @ face.pose @ mirror, face.image_size)


def evened(faces: Sequence[PhotoFace], mirrored: Sequence[PhotoFace]) -> list[PhotoFace]:
    """The mean of each face and the nearest of those from the mirror, if one is near."""
    evened = []
    for face in faces:
        away = [_middles_apart(face, other) for other in mirrored]
        near = int(np.argmin(away)) if away else -1
        even = near >= 0 and away[near] < _NEAR * face.size
        evened.append(_mean(face, mirrored[near]) if even else face)
    return evened


def _middles_apart(one: PhotoFace, other: PhotoFace) -> float:
    return float(np.linalg.norm((one.landmarks - other.landmarks)[:, :2].mean(axis=0)))


def _mean(one: PhotoFace, other: PhotoFace) -> PhotoFace:
    pose = 0.5 * (one.pose + other.pose)
    left, _, right = np.linalg.svd(pose[:3, :3])
    pose[:3, :3] = left @ right
    scores = {name: 0.5 * (score + other.scores[name]) for name, score in one.scores.items()}
    return PhotoFace(0.5 * (one.landmarks + other.landmarks), scores, pose, one.image_size)


def other_side(name: str) -> str:
    """An expression's name on the other side of the face."""
    return name.replace("Left", "-").replace("Right", "Left").replace("-", "Right")


def partners(mean: FloatArray) -> NDArray[np.int64]:
    """(n,) which landmark is the mirror image of each, on a face (n, 3) that is its own."""
    square = ((mean[:, None] - mean * ACROSS) ** 2).sum(axis=2)
    return np.asarray(square.argmin(axis=1))


@lru_cache(maxsize=1)
def _partners() -> NDArray[np.int64]:
    """(478,) as :func:`partners`, for the mean of all faces."""
    return partners(learnt().mean)
