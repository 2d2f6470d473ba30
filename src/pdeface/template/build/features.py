"""Where the 25 feature points of the paper (Fig. 5) lie on the template."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from pdeface.template import FEATURE_POINTS
from pdeface.template.build.head import Head
from pdeface.template.build.parameterisation import Parameterisation
from pdeface.template.layout import COLUMNS

__all__ = ["measure_columns", "measure_features"]

FloatArray = NDArray[np.float64]

# (x, y) in metres, seen from the front, of the points on the midline and on the subject's left;
# the right half is their reflection. Eye centres and mouth corners are those of the scan.
MIDLINE = {
    "brow_centre": 0.0575,
    "eyes_centre": 0.0350,
    "nose_tip": 0.0015,
    "mouth_centre": -0.0335,
    "chin_3": -0.0757,
}
PAIRED = {
    ("right_brow_extension", "left_brow_extension"): (0.0582, 0.0545),
    ("right_brow_middle", "left_brow_middle"): (0.0320, 0.0585),
    ("right_eye_extension", "left_eye_extension"): (0.0620, 0.0340),
    ("right_eye_middle", "left_eye_middle"): (0.0313, 0.0350),
    ("right_cheek", "left_cheek"): (0.0600, 0.0000),
    ("right_nostril", "left_nostril"): (0.0160, -0.0030),
    ("right_mouth_extension", "left_mouth_extension"): (0.0530, -0.0345),
    ("right_mouth_corner", "left_mouth_corner"): (0.0253, -0.0352),
    ("chin_1", "chin_5"): (0.0390, -0.0645),
    ("chin_2", "chin_4"): (0.0253, -0.0708),
}


# Multi-PIE landmarks, counted from 0, of the named columns on the subject's right.
ON_COLUMN = {
    "right_eye_outer": 36,
    "right_eye_inner": 39,
    "right_nostril_wing": 31,
    "right_mouth_corner": 48,
}


def measure_columns(face: Parameterisation, head: Head) -> FloatArray:
    """(13,) values of v of the named columns, exactly symmetric."""
    landmarks = np.array([head.landmark(mark) for mark in ON_COLUMN.values()])
    v = dict(zip(ON_COLUMN, face.uv_of(landmarks)[:, 1].tolist(), strict=True))
    v |= {"right_edge": 0.0, "midline": np.pi / 2}
    v["right_eye_middle"] = 0.5 * (v["right_eye_outer"] + v["right_eye_inner"])
    v |= {name.replace("right", "left"): np.pi - v[name] for name in list(v) if "right" in name}
    return np.array([v[name] for name in COLUMNS])


def measure_features(face: Parameterisation) -> FloatArray:
    """(25, 2) parameters (u, v) of the feature points, exactly symmetric."""
    uv = {}
    for name, y in MIDLINE.items():
        uv[name] = np.array([face.uv_of(_from_the_front(face, 0.0, y))[0, 0], np.pi / 2])
    for (right, left), (x, y) in PAIRED.items():
        u, v = face.uv_of(_from_the_front(face, x, y))[0]
        uv[left] = np.array([u, v])
        uv[right] = np.array([u, np.pi - v])
    return np.array([uv[name] for name in FEATURE_POINTS])


def _from_the_front(face: Parameterisation, x: float, y: float) -> FloatArray:
    """(1, 3) the point of the face seen at (x, y) from the front, among dense samples."""
    u, v = np.linspace(0.0, 1.0, 541), np.linspace(0.0, np.pi, 641)
    samples = face.points(u, v).reshape(-1, 3)
    away = np.linalg.norm(samples[:, :2] - (x, y), axis=1)
    near = away < 0.0008
    seen = near & (samples[:, 2] > samples[near, 2].max() - 0.002)
    return samples[seen][away[seen].argmin()][None]
