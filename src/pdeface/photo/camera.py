"""The camera that took a photo of a head: a perspective projection and its derivatives."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

__all__ = ["PARAMETERS", "PhotoCamera"]

FloatArray = NDArray[np.float64]

PARAMETERS = 6
"""Numbers that :meth:`PhotoCamera.stepped` takes: turn (3), logarithm of the scale, shift (2)."""


@dataclass(frozen=True, eq=False)
class PhotoCamera:
    """A perspective camera in front of a head.

    With Y = R X the point X as the camera sees it (x right, y up, z towards the camera) and
    w = d / (d - Y_z), the point falls on (c_x + s w Y_x, c_y - s w Y_y).

    Attributes:
        rotation: (3, 3) R, from the face's axes to the camera's.
        scale: s, pixels to the metre at the face's origin.
        centre: (2,) c, where the face's origin falls, pixels.
        distance: d, metres from the camera to the face's origin.
    """

    rotation: FloatArray
    scale: float
    centre: FloatArray
    distance: float = 1.0

    def project(self, points: FloatArray) -> FloatArray:
        """(..., 2) pixels of (..., 3) points, metres."""
        seen = points @ self.rotation.T
        near = self.distance / (self.distance - seen[..., 2:])
        return self.centre + self.scale * near * seen[..., :2] * (1.0, -1.0)

    def moves(self, points: FloatArray, directions: FloatArray) -> FloatArray:
        """(..., n, 2) derivatives of the pixels of n points as these move along directions.

        Args:
            points: (n, 3) metres.
            directions: (..., n, 3) in the face's axes.
        """
        seen = points @ self.rotation.T
        return self._image_moves(seen, directions @ self.rotation.T)

    def own_moves(self, points: FloatArray) -> FloatArray:
        """(6, n, 2) derivatives of the pixels of (n, 3) points by the camera's parameters."""
        seen = points @ self.rotation.T
        turns = np.cross(np.eye(3)[:, None], seen[None])
        scaling = (self.project(points) - self.centre)[None]
        shifts = np.broadcast_to(np.eye(2)[:, None], (2, len(points), 2))
        return np.concatenate([self._image_moves(seen, turns), scaling, shifts])

    def stepped(self, step: FloatArray) -> PhotoCamera:
        """The camera with a change of its six parameters applied."""
        turn, grow, shift = step[:3], float(step[3]), step[4:6]
        return replace(
            self,
            rotation=_rotation(turn) @ self.rotation,
            scale=self.scale * float(np.exp(grow)),
            centre=self.centre + shift,
        )

    def _image_moves(self, seen: FloatArray, moved: FloatArray) -> FloatArray:
        near = self.distance / (self.distance - seen[..., 2:])
        across = moved[..., :2] + seen[..., :2] * moved[..., 2:] * near / self.distance
        return np.asarray(self.scale * near * across * (1.0, -1.0))


def _rotation(turn: FloatArray) -> FloatArray:
    """(3, 3) rotation about a vector by its length, radians (Rodrigues' formula)."""
    angle = float(np.linalg.norm(turn))
    if angle < 1e-12:
        return np.eye(3)
    x, y, z = turn / angle
    cross = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    return np.eye(3) + np.sin(angle) * cross + (1.0 - np.cos(angle)) * cross @ cross
