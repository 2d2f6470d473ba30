"""Names of the rows, columns and regions of the face.

Names stand for places in the parameter domain, so that they hold at every level of detail: a row
is a value of u, counted in the 28 curves of the paper (``u = row / 27``); the dense levels keep
every one of these rows.
"""

from __future__ import annotations

from types import MappingProxyType
from typing import NamedTuple

__all__ = ["COLUMNS", "LEVELS", "OPENING_ROWS", "PAPER_ROWS", "REGIONS", "ROWS", "Region"]

LEVELS = MappingProxyType({"28x46": (28, 46), "55x92": (55, 92), "109x184": (109, 184)})
"""Levels of detail that the package ships: (curves, points on each)."""

PAPER_ROWS = 28
"""Curves in the paper (section 2.2)."""

ROWS = MappingProxyType(
    {
        "forehead_top": 0,
        "forehead_upper": 1,
        "forehead_lower": 2,
        "brow": 3,
        "brow_lower": 4,
        "upper_lid_fold": 5,
        "upper_lid": 6,
        "upper_lid_margin": 7,
        "mid_eye": 8,
        "lower_lid_margin": 9,
        "lower_lid": 10,
        "lower_lid_fold": 11,
        "nose_ridge": 12,
        "nose_tip": 13,
        "nostrils": 14,
        "subnasale": 15,
        "philtrum": 16,
        "upper_lip_border": 17,
        "mouth_seam_upper": 18,
        "mouth_seam_lower": 19,
        "lower_lip_border": 20,
        "chin_fold": 21,
        "chin_upper": 22,
        "chin": 23,
        "chin_lower": 24,
        "jaw": 25,
        "under_jaw": 26,
        "under_chin": 27,
    }
)
"""Row of each named feature, in curves of the paper: ``u = row / 27``."""

OPENING_ROWS = MappingProxyType(
    {
        "right_eye": ("upper_lid_margin", "lower_lid_margin"),
        "left_eye": ("upper_lid_margin", "lower_lid_margin"),
        "mouth": ("mouth_seam_upper", "mouth_seam_lower"),
    }
)
"""The rows above and below each opening of the face."""


COLUMNS = (
    "right_edge",
    "right_eye_outer",
    "right_eye_middle",
    "right_eye_inner",
    "right_mouth_corner",
    "right_nostril_wing",
    "midline",
    "left_nostril_wing",
    "left_mouth_corner",
    "left_eye_inner",
    "left_eye_middle",
    "left_eye_outer",
    "left_edge",
)
"""Named columns, from the subject's right to the left: values of v, measured with the template."""


class Region(NamedTuple):
    """A part of the face by rows of the paper and by columns, inclusive.

    Columns are fractions of v / pi: 0 at the subject's right, 1 at the left.
    """

    first_row: float
    last_row: float
    right: float
    left: float


REGIONS = MappingProxyType(
    {
        "frontal": Region(0, 3, 0.0, 1.0),
        "right_orbital": Region(3, 11, 0.12, 0.44),
        "left_orbital": Region(3, 11, 0.56, 0.88),
        "nasal": Region(7, 15, 0.36, 0.64),
        "right_zygomatic": Region(9, 15, 0.0, 0.36),
        "left_zygomatic": Region(9, 15, 0.64, 1.0),
        "maxilla": Region(15, 18, 0.2, 0.8),
        "mandible": Region(19, 27, 0.0, 1.0),
    }
)
"""Regions of the face by the bone of the skull beneath (section 2.3)."""
