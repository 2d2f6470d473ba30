"""The paper's 25 feature points (Fig. 5) from the landmarks of a found face."""

from __future__ import annotations

import math
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from pdeface.errors import InputError
from pdeface.photo.found import PhotoFace
from pdeface.texture import FeaturePoints

__all__ = ["LANDMARKS_OF", "feature_points"]

FloatArray = NDArray[np.float64]

LANDMARKS_OF = MappingProxyType(
    {
        "right_brow_middle": (52, 65, 66, 105),
        "brow_centre": (9,),
        "left_brow_middle": (282, 295, 296, 334),
        "right_eye_middle": (33, 133, 145, 159),
        "eyes_centre": (168,),
        "left_eye_middle": (263, 362, 374, 386),
        "right_nostril": (64,),
        "nose_tip": (4,),
        "left_nostril": (294,),
        "right_mouth_corner": (61,),
        "mouth_centre": (13, 14),
        "left_mouth_corner": (291,),
        "chin_3": (152,),
        "upper_lip": (13,),
        "lower_lip": (14,),
    }
)
"""Landmarks of each feature point that lies within the face; it is in their middle."""

# The face's outline from the forehead's top to the chin's lowest point.
_RIGHT = (10, 109, 67, 103, 54, 21, 162, 127, 234, 93, 132, 58, 172, 136, 150, 149, 176, 148, 152)
_LEFT = (
    10,
    338,
    297,
    332,
    284,
    251,
    389,
    356,
    454,
    323,
    361,
    288,
    397,
    365,
    379,
    378,
    400,
    377,
) + (152,)

# Points on the outline: name, and the feature at whose height it lies.
_AT_HEIGHT_OF = (
    ("brow_extension", "brow_middle"),
    ("eye_extension", "eye_middle"),
    ("cheek", "nostril"),
    ("mouth_extension", "mouth_corner"),
)

_DECIMALS = 4
"""Of a pixel, that positions have: a points file holds them exactly."""

_OPEN = 0.03
"""Gap between the lips, in eye distances, from which on the mouth counts as open."""


def feature_points(face: PhotoFace) -> FeaturePoints:
    """The 25 feature points of a found face; of an open mouth also the edges of the lips.

    Those within the face are middles of landmarks (:data:`LANDMARKS_OF`). Those on its edge lie
    on the outline's landmarks: at the height of their feature, or below the mouth's corners, or
    half-way between (docs/points.md), with the eyes level. What would lie outside the photo is
    moved to its border.

    Raises:
        InputError: the points cannot be used for a texture, because the head is turned too far.
    """
    places = {n: face.landmarks[list(i), :2].mean(axis=0) for n, i in LANDMARKS_OF.items()}
    if np.linalg.norm(places["lower_lip"] - places["upper_lip"]) < _OPEN * face.eye_distance:
        del places["upper_lip"], places["lower_lip"]
    turn = _turn(places["left_eye_middle"] - places["right_eye_middle"])
    for side, numbers in (("right", _RIGHT), ("left", _LEFT)):
        outline = face.landmarks[list(numbers), :2] @ turn
        level = {name: place @ turn for name, place in places.items()}
        places.update({n: p @ turn.T for n, p in _on_outline(side, outline, level).items()})
    limits = np.asarray(face.image_size, float)
    inside = {name: np.clip(place.round(_DECIMALS), 0.0, limits).tolist()
              for name, place in places.items()}  # fmt: skip
    points = FeaturePoints(inside, face.image_size)
    try:
        points.validate((face.image_size[1], face.image_size[0]))
    except InputError as error:
        raise InputError(
            f"the head is turned too far from the camera, by {math.degrees(face.yaw):.0f} degrees "
            f"sideways and {math.degrees(face.pitch):.0f} up ({error}); use a photo from the front"
        ) from error
    return points


def _turn(across: FloatArray) -> FloatArray:
    """(2, 2) from the photo to a frame whose x runs from the right eye to the left."""
    x, y = across / np.linalg.norm(across)
    return np.array([[x, -y], [y, x]])


def _on_outline(
    side: str, outline: FloatArray, level: dict[str, FloatArray]
) -> dict[str, FloatArray]:
    """The points of one side that lie on its outline, (x, y) with the eyes level."""
    # A tilted or distorted outline may run back a little; a curve over y must not.
    heights = np.maximum.accumulate(outline[:, 1])
    places = {}
    for name, feature in _AT_HEIGHT_OF:
        y = level[f"{side}_{feature}"][1]
        places[f"{side}_{name}"] = np.array([np.interp(y, heights, outline[:, 0]), y])
    jaw = outline[outline[:, 1] > places[f"{side}_mouth_extension"][1]]
    sign = 1.0 if side == "right" else -1.0
    corner, edge = level[f"{side}_mouth_corner"][0], places[f"{side}_mouth_extension"][0]
    numbers = (2, 1) if side == "right" else (4, 5)
    for number, x in zip(numbers, (corner, 0.5 * (corner + edge)), strict=True):
        y = np.interp(sign * x, np.maximum.accumulate(sign * jaw[:, 0]), jaw[:, 1])
        places[f"chin_{number}"] = np.array([x, y])
    return places
