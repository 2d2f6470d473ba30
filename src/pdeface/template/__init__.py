"""The neutral face: boundary curves measured on a scanned head, and the names of its parts.

The numbers in ``data/neutral.npz`` were measured by ``python -m pdeface.template.build`` on
ICT-FaceKit's neutral head (MIT, Copyright (c) 2020 USC Institute for Creative Technologies; see
NOTICE).
"""

from __future__ import annotations

from functools import lru_cache
from pathlib import Path
from types import MappingProxyType
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pdeface.curves import BoundaryCurves, mirror_points
from pdeface.errors import InputError
from pdeface.openings import Opening
from pdeface.template.layout import (
    COLUMNS,
    LEVELS,
    OPENING_ROWS,
    PAPER_ROWS,
    REGIONS,
    ROWS,
    Region,
)

__all__ = [
    "COLUMNS",
    "DATA",
    "FEATURE_POINTS",
    "LEVELS",
    "REGIONS",
    "ROWS",
    "Region",
    "column",
    "column_v",
    "feature_points",
    "neutral_curves",
    "openings",
    "row",
    "row_u",
]

DATA = Path(__file__).parent / "data" / "neutral.npz"

FEATURE_POINTS = (
    "right_brow_extension",
    "right_brow_middle",
    "brow_centre",
    "left_brow_middle",
    "left_brow_extension",
    "right_eye_extension",
    "right_eye_middle",
    "eyes_centre",
    "left_eye_middle",
    "left_eye_extension",
    "right_cheek",
    "right_nostril",
    "nose_tip",
    "left_nostril",
    "left_cheek",
    "right_mouth_extension",
    "right_mouth_corner",
    "mouth_centre",
    "left_mouth_corner",
    "left_mouth_extension",
    "chin_1",
    "chin_2",
    "chin_3",
    "chin_4",
    "chin_5",
)
"""The 25 feature points of Fig. 5 in the order of the paper; left and right are the subject's."""


@lru_cache(maxsize=1)
def _data() -> MappingProxyType[str, NDArray[Any]]:
    with np.load(DATA, allow_pickle=False) as file:
        return MappingProxyType({name: file[name] for name in file.files})


def neutral_curves(level: str = "28x46") -> BoundaryCurves:
    """Boundary curves of the neutral face.

    Args:
        level: ``"28x46"`` (the paper's, also called ``"paper"``), ``"55x92"`` or ``"109x184"``:
            curves x points on each.

    Raises:
        InputError: no such level.
    """
    name = "28x46" if level == "paper" else level
    if name not in LEVELS:
        raise InputError(f"level must be one of {', '.join(LEVELS)} or paper, got {level!r}")
    mirror_z = float(_data()["mirror_z"])
    half = _data()[f"curves_{name}"].astype(np.float64)
    return BoundaryCurves(mirror_points(half, mirror_z), mirror_z)


def feature_points() -> dict[str, tuple[float, float]]:
    """(u, v) of the 25 feature points of Fig. 5, by name, in the order of the paper."""
    uv = _data()["features"].tolist()
    return {name: (u, v) for name, (u, v) in zip(FEATURE_POINTS, uv, strict=True)}


@lru_cache(maxsize=1)
def openings() -> tuple[Opening, ...]:
    """The openings of the face: the right eye, the left eye and the mouth, in this order.

    The eyes are open at rest, between their lid margins; the lips touch along one line.
    """
    found = []
    for (name, rows), lines in zip(OPENING_ROWS.items(), _data()["openings"], strict=True):
        v, upper, lower = (tuple(line) for line in lines.tolist())
        found.append(Opening(name, v, upper, lower, (row_u(rows[0]), row_u(rows[1]))))
    return tuple(found)


def row_u(name: str) -> float:
    """u of a named row, such as ``"upper_lid_margin"``, at every level of detail.

    Raises:
        InputError: no row has that name.
    """
    if name not in ROWS:
        raise InputError(f"no row is called {name!r}; the rows are {', '.join(ROWS)}")
    return ROWS[name] / (PAPER_ROWS - 1)


def row(name: str, curves: int = PAPER_ROWS) -> int:
    """Index of the curve on a named row, among so many curves.

    Raises:
        InputError: no row has that name, or no curve of that level lies on it.
    """
    index = row_u(name) * (curves - 1)
    if abs(index - round(index)) > 1e-9:
        raise InputError(f"with {curves} curves none lies on {name!r}; levels have 27 n + 1 curves")
    return round(index)


def column_v(name: str) -> float:
    """v of a named column, such as ``"left_mouth_corner"``, radians, at every level of detail.

    Raises:
        InputError: no column has that name.
    """
    if name not in COLUMNS:
        raise InputError(f"no column is called {name!r}; the columns are {', '.join(COLUMNS)}")
    return float(_data()["columns"][COLUMNS.index(name)])


def column(name: str, points: int = 46) -> int:
    """Index of the data point nearest to a named column, on curves of so many points.

    Raises:
        InputError: no column has that name.
    """
    nearest = round(column_v(name) * points / (2.0 * np.pi) - 0.5)
    return min(max(nearest, 0), points // 2 - 1)
