"""Landmarks of a scan from a file: the 68 of Multi-PIE by number, or feature points by name."""

from __future__ import annotations

import json
import math
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pdeface.errors import InputError
from pdeface.files import PathLike
from pdeface.photo.anchors import anchors
from pdeface.scan.alignment import Landmarks
from pdeface.template import feature_points

__all__ = ["MULTI_PIE", "known_places", "load_landmarks"]

FEWEST = 4
"""Points, not on one line, that say where a face is."""

# MediaPipe's landmark at each of the 68 of Multi-PIE, whose places on the face were measured.
MULTI_PIE = (
    *(127, 234, 93, 132, 58, 136, 150, 176, 152, 400, 379, 365, 288, 361, 323, 454, 356),
    *(70, 63, 105, 66, 107, 336, 296, 334, 293, 300, 168, 197, 5, 4, 75, 97, 2, 326, 305),
    *(33, 160, 158, 133, 153, 144, 362, 385, 387, 263, 373, 380),
    *(61, 39, 37, 0, 267, 269, 291, 405, 314, 17, 84, 181, 78, 82, 13, 312, 308, 317, 14, 87),
)
_JAW = 17
_JAW_TRUST, _NAMED_TRUST = 0.02, 1.0
"""Points of the jaw's outline are where a picture's outline was: next to nothing on a surface."""


@lru_cache(maxsize=1)
def known_places() -> dict[str, tuple[float, float, float]]:
    """u, v and trust of every point that a file may name."""
    uv = anchors().uv[list(MULTI_PIE)].tolist()
    places = {
        str(number + 1): (u, v, _JAW_TRUST if number < _JAW else _NAMED_TRUST)
        for number, (u, v) in enumerate(uv)
    }
    named = {name: (u, v, _NAMED_TRUST) for name, (u, v) in feature_points().items()}
    return {**places, **named}


def load_landmarks(path: PathLike) -> Landmarks:
    """The landmarks in a JSON file: an object of names or numbers 1 to 68 with [x, y, z] each.

    A list of 68 places means Multi-PIE's in their order; null leaves one out.

    Raises:
        InputError: no such file, or too few points in it.
    """
    path = Path(path)
    try:
        content = json.loads(path.read_text(encoding="utf-8"))
    except FileNotFoundError as error:
        raise InputError(f"expected landmarks, found no file at {path}; check its name") from error
    except (OSError, ValueError, RecursionError) as error:
        raise InputError(f"cannot read {path} as JSON ({error}); see docs/scans.md") from error
    if isinstance(content, list) and len(content) == len(MULTI_PIE):
        content = {str(number + 1): place for number, place in enumerate(content)}
    if not isinstance(content, dict):
        raise InputError(
            f"{path} must hold an object of points, or a list of {len(MULTI_PIE)}, got "
            f"{type(content).__name__}; see docs/scans.md"
        )
    known = known_places()
    found: list[tuple[float, ...]] = []
    points = []
    for name, place in content.items():
        if place is None:
            continue
        if name not in known:
            raise InputError(
                f"{path} names the point {name!r}; the names are 1 to {len(MULTI_PIE)} and "
                f"{', '.join(feature_points())}"
            )
        points.append(_place(path, name, place))
        found.append(known[name])
    if len(points) < FEWEST or np.linalg.matrix_rank(_centred(points), tol=1e-9) < 2:
        raise InputError(
            f"{path} must hold at least {FEWEST} points, not on one line, got {len(points)}; add "
            "corners of eyes and mouth and the tip of the nose"
        )
    uv_trust = np.array(found)
    return Landmarks(uv_trust[:, :2], np.array(points), uv_trust[:, 2])


def _place(path: Path, name: str, place: Any) -> list[float]:
    good = isinstance(place, list) and len(place) == 3
    good = good and all(isinstance(x, int | float) and math.isfinite(x) for x in place)
    if not good:
        raise InputError(f"{path}: the point {name!r} must be three numbers, got {place!r}")
    return [float(x) for x in place]


def _centred(points: list[list[float]]) -> NDArray[np.float64]:
    array = np.array(points).reshape(-1, 3)
    away = array - array.mean(axis=0)
    return away / max(float(np.abs(away).max()), 1e-300)
