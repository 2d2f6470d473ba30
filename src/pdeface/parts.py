"""The parts of one face: eyes, the rims of the lids and all of the mouth, in their places.

Where they lie follows from who the face is, and how they move is linear in what its lids and lips
and its expressions do, so that the face and its parts have the same morph targets.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import cached_property
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from pdeface.anatomy import OPENINGS, PARTS, Margins, Outline, Part, placed
from pdeface.anatomy.textures import EYE_WHITE, IRIS_COLOUR
from pdeface.controls import CONTROLS, Displacement, expressed, person
from pdeface.controls.seams import seam
from pdeface.face import Face
from pdeface.openings import Opening
from pdeface.template import openings

__all__ = ["FaceParts", "eye_colours", "has_parts"]

FloatArray = NDArray[np.float64]
Colour = tuple[int, int, int]

# Of an eye's width to either side of its middle, of its height off the lids, and by brightness.
_MIDDLE, _INSET, _IRIS_LIGHT = 0.17, 0.2, (0.3, 0.6)
_NEAR_CORNERS, _WHITE_LIGHT = 0.40, (0.75, 0.95)
_WHITES = (176, 160, 150), (236, 230, 224)
_FEWEST_TEXELS = 40

# What the eyeballs keep clear of, lest they show through a lid on its way.
_LIDS: tuple[Mapping[str, float], ...] = (
    *({"eyeBlink": blink} for blink in (0.25, 0.5, 0.75, 1.0)),
    *({look: 1.0, "eyeLookOut": 1.0} for look in ("eyeLookDown", "eyeLookUp")),
    *({look: 1.0, "eyeLookIn": 1.0} for look in ("eyeLookDown", "eyeLookUp")),
    {"eyeSquint": 1.0},
)

NARROWEST = 1e-6
"""Metres between the corners of an opening behind which something can be."""


def has_parts(face: Face) -> bool:
    """Whether a face has lids and lips, and openings wide enough to look into."""
    if not face.has_lids:
        return False
    points = face.curves.points + person(face.weights, face.curves.shape)
    widths = []
    for name in OPENINGS:
        upper, _ = seam(name, face.curves.shape).lines(points, np.zeros_like(points))
        widths.append(float(np.linalg.norm(upper[-1] - upper[0])))
    return min(widths) > NARROWEST


def eye_colours(face: Face) -> tuple[Colour, Colour]:
    """sRGB of iris and white that the texture of a face shows; a grey blue eye's without one.

    The eyes of a texture are its photo's: between the lids, in the middle, lie pupil, iris, white
    and highlights. The iris is what is neither among the darkest nor among the brighter half; the
    white is what is bright beside the middle, in the photo's light.
    """
    if face.texture is None:
        return IRIS_COLOUR, EYE_WHITE
    middles, sides = [], []
    for opening in openings()[:2]:
        start, end = opening.corners
        texels, u, v = _window(face.texture, opening)
        upper, lower = (line + (u[:, None] * 0.0) for line in opening.lines(v))
        inset = _INSET * (lower - upper)
        inside = (u[:, None] > upper + inset) & (u[:, None] < lower - inset)
        away = np.abs(v - 0.5 * (start + end)) / (end - start)
        middles.append(texels[inside & (away < _MIDDLE)])
        sides.append(texels[inside & (away > _MIDDLE) & (away < _NEAR_CORNERS)])
    iris = _middle_colour(np.concatenate(middles), _IRIS_LIGHT)
    white = _middle_colour(np.concatenate(sides), _WHITE_LIGHT)
    # Strongly lit or shaded eyes would look blind or dead in any other light.
    return iris or IRIS_COLOUR, EYE_WHITE if white is None else _between(white, *_WHITES)


def _window(
    texture: NDArray[np.uint8], opening: Opening
) -> tuple[NDArray[np.uint8], FloatArray, FloatArray]:
    """The texels in an opening's box, and their u and v."""
    height, width = texture.shape[:2]
    u, v = np.arange(0.5, height) / height, np.arange(0.5, width) * (np.pi / width)
    rows = (u >= min(opening.upper)) & (u <= max(opening.lower))
    columns = (v >= opening.v[0]) & (v <= opening.v[-1])
    return texture[np.ix_(rows, columns)], u[rows], v[columns]


def _middle_colour(texels: NDArray[np.uint8], part: tuple[float, float]) -> Colour | None:
    """Median of the texels whose brightness lies between two quantiles."""
    if len(texels) < _FEWEST_TEXELS:
        return None
    colours = texels[:, :3].astype(np.float64)
    light = colours @ (0.2126, 0.7152, 0.0722)
    low, high = np.quantile(light, part)
    return _rounded(np.median(colours[(light >= low) & (light <= high)], axis=0))


def _between(colour: Colour, low: Colour, high: Colour) -> Colour:
    return _rounded(np.clip(colour, low, high))


def _rounded(colour: NDArray[np.float64]) -> Colour:
    red, green, blue = (int(c) for c in np.rint(colour))
    return red, green, blue


class FaceParts:
    """The parts behind the openings of a face.

    Args:
        face: one that has them (:func:`has_parts`).

    Example:
        >>> import pdeface
        >>> parts = FaceParts(pdeface.neutral().set(eyeLookUpLeft=1.0))
        >>> parts.curves("left_eyeball").shape
        (16, 16, 3)
    """

    parts: Mapping[str, Part] = MappingProxyType(PARTS)

    def __init__(self, face: Face) -> None:
        self._face = face
        self._rest = face.curves.points + person(face.weights, face.curves.shape)
        self._weights = {n: w for n, w in face.weights.items() if CONTROLS[n].kind == "expression"}
        rest = self.outline(Displacement(self._rest, np.zeros_like(self._rest)))
        lids = [self._lidded(lids) for lids in _LIDS]
        self._anatomy = placed(rest, lids)

    def curves(self, name: str) -> FloatArray:
        """(K, M, 3) closed curves of a part as the face is now, metres."""
        return self._anatomy.curves(name) + self.moved(name, self._own, self._weights)

    def outline(self, by: Displacement) -> Outline:
        """How far a displacement of the face's curves takes the margins of its openings."""
        shape, a, modes = self._face.curves.shape, self._face.a, self._face.modes
        lines = (seam(name, shape, a, modes).lines(by.smooth, by.parting) for name in OPENINGS)
        moved = zip(lines, by.margins, strict=True)
        return Outline(*(Margins(*(np.array(line) + margins)) for line, margins in moved))

    def moved(self, name: str, outline: Outline, weights: Mapping[str, float]) -> FloatArray:
        """(K, M, 3) displacement of a part's curves where expressions displace the face's.

        Args:
            name: of the part.
            outline: from :meth:`outline`.
            weights: the expressions that displace the face.
        """
        return self._anatomy.moved(name, outline, weights)

    @cached_property
    def _own(self) -> Outline:
        return self.outline(self._expressed(self._weights))

    def _lidded(self, lids: Mapping[str, float]) -> Outline:
        both = {f"{name}{side}": w for name, w in lids.items() for side in ("Left", "Right")}
        moved = self._expressed(both)
        return self.outline(moved._replace(smooth=self._rest + moved.smooth))

    def _expressed(self, weights: Mapping[str, float]) -> Displacement:
        return expressed(self._rest, weights, self._face.a, self._face.modes)
