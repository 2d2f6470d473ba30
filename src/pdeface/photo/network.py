"""What the detector's network makes of a face before it names the landmarks.

MediaPipe's network turns a square picture of a face into landmarks in many layers. The last ones
know landmarks alone; one in its middle, 8 x 8 places with 128 values each, still holds more of the
face's shape. The network is a file of the model, and OpenCV, which MediaPipe brings, runs it.
"""

from __future__ import annotations

import zipfile
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pdeface.errors import InputError, require

__all__ = ["INNER", "SIDE", "Network", "square"]

FloatArray = NDArray[np.float64]
Pixels = NDArray[np.uint8]

SIDE = 256
"""Pixels of the square that the network looks at."""

INNER = 8 * 8 * 128
"""Values of the layer that is read."""

_FILE = "face_landmarks_detector.tflite"
_LAYER = "model_5/model_4/model_3/p_re_lu_174/"
_FILLING = 1.5
"""Of the longer side of the landmarks' box: what MediaPipe cuts out, too."""

_MESH = 468
_EYES = 33, 263
"""Outer corners of the right and of the left eye."""


class Network:
    """The network in a model's file.

    Args:
        model: MediaPipe's face_landmarker.task.

    Raises:
        InputError: there is no such network in it.
        MissingExtraError: OpenCV is not installed.
    """

    def __init__(self, model: Path) -> None:
        self._cv2 = require("cv2", "photo", "to look at faces in photos")
        try:
            with zipfile.ZipFile(model) as file:
                data = np.frombuffer(file.read(_FILE), np.uint8)
            self._net = self._cv2.dnn.readNetFromTFLite(data)
            self._layer = next(n for n in self._net.getLayerNames() if n.startswith(_LAYER))
        except (OSError, KeyError, StopIteration, zipfile.BadZipFile, self._cv2.error) as error:
            raise InputError(
                f"expected MediaPipe's face_landmarker.task with {_FILE} in it, got {model}; "
                "download the model again"
            ) from error

    def inner(self, squares: Sequence[Pixels]) -> NDArray[np.float32]:
        """(n, 8192) values of its layer for squares of 256 x 256 x 3 pixels."""
        found = []
        for pixels in squares:
            self._net.setInput(self._cv2.dnn.blobFromImage(pixels, 1.0 / 255.0))
            values = self._net.forward(self._layer)[0]
            found.append(np.moveaxis(values, 0, -1).ravel())
        return np.array(found, dtype=np.float32)


def square(photo: Pixels, landmarks: FloatArray) -> Pixels:
    """(256, 256, 3) the part of a photo around a face, its eyes level, as the network is shown it.

    Args:
        photo: (H, W, 3 or 4).
        landmarks: (478, 2 or 3) pixels of the photo.
    """
    cv2: Any = require("cv2", "photo", "to look at faces in photos")
    right, down = _axes(landmarks)
    level = landmarks[:_MESH, :2] @ np.array([right, down]).T
    low, high = level.min(axis=0), level.max(axis=0)
    side = _FILLING * float((high - low).max())
    corner = (0.5 * (low + high) - 0.5 * side) @ np.array([right, down])
    # The axes of the square's pixels, and where its first one lies in the photo.
    affine = np.column_stack([right * side / SIDE, down * side / SIDE, corner])
    part, affine = _shrunk(photo[..., :3], affine, int(side / SIDE))
    flags = cv2.INTER_LINEAR | cv2.WARP_INVERSE_MAP
    border = cv2.BORDER_REPLICATE
    return np.asarray(cv2.warpAffine(part, affine, (SIDE, SIDE), flags=flags, borderMode=border))


def _axes(landmarks: FloatArray) -> tuple[FloatArray, FloatArray]:
    """(2,) each: unit vectors in the photo from eye to eye, and down from there."""
    across = landmarks[_EYES[1], :2] - landmarks[_EYES[0], :2]
    x, y = across / np.linalg.norm(across)
    return np.array([x, y]), np.array([-y, x])


def _shrunk(photo: Pixels, affine: FloatArray, by: int) -> tuple[Pixels, FloatArray]:
    """The photo with one pixel for ``by`` times ``by``, so that none is passed over."""
    pixels = np.ascontiguousarray(photo)
    if by < 2:
        return pixels, affine
    from PIL import Image

    smaller = np.asarray(Image.fromarray(pixels).reduce(by))
    # Pixels count from their middles.
    moved = affine / by
    moved[:, 2] -= 0.5 * (by - 1) / by
    return smaller, moved
