"""The skin beside the openings: what a photo shows there belongs to eyes and teeth, or to lashes.

Above an open eye a few millimetres of skin are folded away; when the eye closes they cover it, and
lashes painted on them would be drawn out to streaks. Teeth seen between smiling lips would stay on
lips that are shut. Both are filled from the skin around and get a fine dark line at the margin.
"""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from pdeface.openings import Opening
from pdeface.template import openings
from pdeface.template.layout import PAPER_ROWS
from pdeface.texture._fill import extend

__all__ = ["clean_margins"]

FloatArray = NDArray[np.float64]


class _Band(NamedTuple):
    """What is filled beside an opening, in rows of the paper.

    Attributes:
        above, below: how far from its lines the fill begins to give way to the photo.
        fade: over how many rows it does.
        line, dark: width and strength of the dark line on the upper and on the lower side.
    """

    above: float
    below: float
    fade: float
    line: tuple[float, float]
    dark: tuple[float, float]


_EYE = _Band(2.1, 0.6, 0.8, (0.22, 0.08), (0.70, 0.30))
_MOUTH = _Band(0.55, 0.60, 0.35, (0.09, 0.09), (0.45, 0.35))
_TAPER, _BEYOND = 0.10, 0.08
"""Over which part of an opening's width the dark lines end at its corners, and the fill beyond."""


def clean_margins(texture: NDArray[np.uint8]) -> NDArray[np.uint8]:
    """The texture with skin alone beside the eyes and between the lips.

    Args:
        texture: (H, W, 3) over the face, 0 <= u <= 1 and 0 <= v <= pi.
    """
    height, width = texture.shape[:2]
    u, v = np.arange(0.5, height) / height, np.arange(0.5, width) * (np.pi / width)
    result = texture.copy()  # windows of openings do not overlap

    def clean(opening: Opening) -> None:
        rows, columns = _window(opening, u, v)
        part = texture[rows, columns].astype(np.float32)
        part = _cleaned(part, opening, u[rows], v[columns])
        result[rows, columns] = np.clip(np.rint(part), 0, 255)

    with ThreadPoolExecutor() as pool:  # numpy lets threads run
        list(pool.map(clean, openings()))
    return result


def _cleaned(
    part: NDArray[np.float32], opening: Opening, u: FloatArray, v: FloatArray
) -> NDArray[np.float32]:
    """The part of the texture around an opening, filled beside it and dark along its lines."""
    band = _MOUTH if opening.name == "mouth" else _EYE
    above, below = _distances(opening, u, v)
    part = _filled(part, above, below, _ends(opening, v, _BEYOND), band)
    ends = _ends(opening, v, 0.0)
    for away, line, dark in zip((above, below), band.line, band.dark, strict=True):
        shade = dark * ends * np.exp(-((np.maximum(away, 0.0) / line) ** 2)) * (away >= 0.0)
        part *= 1.0 - shade[..., None].astype(np.float32)
    return part


def _window(opening: Opening, u: FloatArray, v: FloatArray) -> tuple[slice, slice]:
    """Rows and columns around an opening, with skin on all sides to fill from."""
    margin = 4.0 / (PAPER_ROWS - 1)
    first, last = min(opening.upper) - margin, max(opening.lower) + margin
    start, end = opening.corners
    rows = np.flatnonzero((u > first) & (u < last))
    columns = np.flatnonzero((v > start - 0.1) & (v < end + 0.1))
    return slice(rows[0], rows[-1] + 1), slice(columns[0], columns[-1] + 1)


def _distances(opening: Opening, u: FloatArray, v: FloatArray) -> tuple[FloatArray, FloatArray]:
    """(H, W) rows above the upper line, and below the lower."""
    upper, lower = opening.lines(v)
    scale = PAPER_ROWS - 1.0
    return scale * (upper - u[:, None]), scale * (u[:, None] - lower)


def _ends(opening: Opening, v: FloatArray, beyond: float) -> FloatArray:
    """(W,) 1 within an opening, falling smoothly to 0 a part of its width beyond its corners."""
    start, end = opening.corners
    near = (np.minimum(v - start, end - v) / (end - start) + beyond) / (_TAPER + beyond)
    near = near.clip(0.0, 1.0)
    return np.asarray(near * near * (3.0 - 2.0 * near))


def _filled(
    part: NDArray[Any], above: FloatArray, below: FloatArray, ends: FloatArray, band: _Band
) -> NDArray[Any]:
    """The part with its band filled; the opening itself stays, for faces that are not cut."""
    inside = (above < 0.0) & (below < 0.0)
    reach = np.where(above >= 0.0, above - band.above, below - band.below)
    share = (1.0 - reach / band.fade).clip(0.0, 1.0) * ends
    known = np.where(inside, 0.0, 1.0 - share).astype(np.float32)
    guess = extend(part * 1.0, np.where(known > 0.999, 1.0, 0.0).astype(np.float32))
    share = np.where(inside, 0.0, share)[..., None]
    return np.asarray((1.0 - share) * part + share * guess, dtype=np.float32)
