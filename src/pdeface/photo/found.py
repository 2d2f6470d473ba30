"""A face found in a photo, as a value."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pdeface.errors import InputError

__all__ = ["LANDMARKS", "PhotoFace", "choose"]

FloatArray = NDArray[np.float64]

LANDMARKS = 478
"""Landmarks of a face: 468 of its mesh and five of each iris, numbered by MediaPipe."""

_RIGHT_EYE, _LEFT_EYE = (33, 133), (263, 362)


@dataclass(frozen=True, eq=False)
class PhotoFace:
    """One face of a photo, as MediaPipe's face landmarker finds it.

    Attributes:
        landmarks: (478, 3) x to the right and y down in pixels from the photo's top-left corner,
            and depth away from the camera on the same scale (only its differences mean anything).
        scores: 52 expressions of ARKit by name, each 0 to 1, as they look to the detector.
        pose: (4, 4) from MediaPipe's canonical face to the camera, centimetres; x to the right,
            y up, z towards the camera.
        image_size: (width, height) of the photo.
        traits: (50,) the identity that the detector's network suggests beside the landmarks
            (:mod:`pdeface.photo.traits`); None where it was not asked.
    """

    landmarks: FloatArray
    scores: Mapping[str, float]
    pose: FloatArray
    image_size: tuple[int, int]
    traits: FloatArray | None = None

    @property
    def size(self) -> float:
        """Height and width of the landmarks' box together, pixels."""
        return float(np.ptp(self.landmarks[:, :2], axis=0).sum())

    @property
    def eye_distance(self) -> float:
        """Distance between the middles of the eyes, pixels."""
        return float(np.linalg.norm(self._between_eyes))

    @property
    def across(self) -> FloatArray:
        """(2,) unit vector in the photo from the right eye to the left."""
        return np.asarray(self._between_eyes / self.eye_distance)

    @property
    def _between_eyes(self) -> FloatArray:
        right, left = (
            self.landmarks[list(eye), :2].mean(axis=0) for eye in (_RIGHT_EYE, _LEFT_EYE)
        )
        return np.asarray(left - right)

    @property
    def yaw(self) -> float:
        """How far the head is turned to its left, radians."""
        return math.atan2(self.pose[0, 2], self.pose[2, 2])

    @property
    def pitch(self) -> float:
        """How far the head looks up, radians."""
        return math.asin(min(max(float(self.pose[1, 2]), -1.0), 1.0))


def choose(faces: Sequence[PhotoFace], number: int = 1, name: str = "the photo") -> PhotoFace:
    """One of the faces of a photo.

    Args:
        faces: the largest first, as :func:`pdeface.photo.find_faces` returns them.
        number: which, counted from 1.
        name: what messages call the photo.

    Raises:
        InputError: there are fewer faces, or none.
    """
    if not faces:
        raise InputError(
            f"no face was found in {name}; use a photo of a face from the front, or place its "
            "points by hand (docs/points.md) and give them with --points"
        )
    if not 1 <= number <= len(faces):
        many = "1 face was" if len(faces) == 1 else f"{len(faces)} faces were"
        raise InputError(
            f"--face must be a number from 1 to {len(faces)}, because {many} found in {name}, "
            f"got {number}; 1 is the largest"
        )
    return faces[number - 1]
