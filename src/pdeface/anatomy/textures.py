"""Procedural textures of the parts: rows along u, columns along v, as for the face.

Nothing here is a photograph; every texel is a closed form of its place on the part.
"""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from pdeface.anatomy.eyes import BACK, SPACING
from pdeface.anatomy.measured import arch
from pdeface.anatomy.part import part
from pdeface.errors import InputError

__all__ = ["BROWN", "EYE_WHITE", "IRIS_COLOUR", "eye", "mouth", "teeth", "texture", "tongue"]

FloatArray = NDArray[np.float64]
Colour = tuple[int, int, int]
Pixels = NDArray[np.uint8]

BROWN: Colour = (104, 68, 40)
IRIS_COLOUR: Colour = (96, 112, 112)
"""sRGB of the iris unless another is asked for: a grey blue."""

EYE_WHITE: Colour = (236, 230, 224)
"""sRGB of the white of the eye unless another is asked for."""

IRIS, PUPIL = np.radians(21.5), np.radians(6.8)
"""Angles from the middle of the pupil to the limbus and to the edge of the pupil."""

LIP, DEEP, THROAT = (170, 100, 92), (104, 40, 40), (32, 8, 10)
TOOTH, GUM = (236, 228, 208), (196, 118, 114)
TONGUE = (192, 104, 104)

DUSK = {"upper": (0.50, 1.35), "lower": (0.30, 0.85)}
"""Angles between which the shadow of the cheeks falls on an arch, radians from its middle. Below an
open jaw one looks along the lower arch."""

SHADOW = 0.80, 0.88, 0.88
"""How much of red, green and blue the shadow takes."""


def eye(colour: Colour = IRIS_COLOUR, size: int = 512, white: Colour = EYE_WHITE) -> Pixels:
    """(size, size, 3) uint8 texture of an eyeball.

    A dark pupil; an iris of this colour with radial fibres, lighter round the pupil and dark at
    the limbus; a slightly warm sclera that reddens towards the back.

    Raises:
        InputError: no colour of three numbers from 0 to 255.
    """
    for what, given in (("an iris", colour), ("the white of an eye", white)):
        if len(given) != 3 or not all(0 <= c <= 255 for c in given):
            raise InputError(f"the colour of {what} is three numbers from 0 to 255, got {given}")
    u, v = _places(size, size)
    angle = BACK * u**SPACING
    base = np.array(colour, dtype=np.float64)
    across = (angle - PUPIL) / (IRIS - PUPIL)
    fibres = _fibres(v, across)
    ring = np.exp(-(((across - 0.25 - 0.05 * fibres) / 0.16) ** 2))
    light = 0.86 + 0.30 * fibres + 0.25 * ring - 0.45 * _step(0.72, 1.05, across)
    iris = base * light[..., None] + ring[..., None] * (26.0, 14.0, -6.0)
    red = _step(np.radians(30.0), np.radians(75.0), angle)[..., None]
    light = np.array(white, dtype=np.float64)
    sclera = (1.0 - red) * light + red * (light * (0.91, 0.77, 0.74))
    blur = np.radians(1.6)
    colours = _mix(iris, sclera, _step(IRIS - blur, IRIS + blur, angle))
    pupil = np.array([12.0, 10.0, 10.0])
    return _pixels(_mix(pupil, colours, _step(PUPIL - 0.5 * blur, PUPIL + 0.4 * blur, angle)))


def mouth(size: int = 128) -> Pixels:
    """(size, 8, 3) uint8 texture of the cavity: lips at its margin, dark red within."""
    u, _ = _places(size, 8)
    colours = _mix(np.array(LIP, float), np.array(DEEP, float), _step(0.02, 0.30, u))
    return _pixels(_mix(colours, np.array(THROAT, float), _step(0.45, 0.85, u)))


def teeth(name: str, size: int = 512) -> Pixels:
    """(size, size / 4, 3) uint8 texture of the ``"upper"`` or ``"lower"`` arch.

    The gaps between the teeth and the scalloped edge of the gum lie where they were measured.
    """
    u, v = _places(size, size // 4)
    row = arch(name)
    count = part(f"{name}_teeth").shape[0]
    along = (u * (count - 1) - 1.0) / (count - 3)
    angle = row.angle[0] + along * (row.angle[-1] - row.angle[0])
    index = np.clip(np.searchsorted(row.gaps, angle) - 1, 0, len(row.gaps) - 2)
    start, end = row.gaps[index], row.gaps[index + 1]
    # -1 and 1 at the sides of a tooth.
    across = np.clip((2.0 * angle - start - end) / (end - start), -1.0, 1.0)
    height = 0.5 + 0.5 * np.sin(v) * (1.0 if name == "upper" else -1.0)
    gum_line = 0.56 - 0.09 * across**4
    shade = 1.0 - 0.34 * np.abs(across) ** 18 - 0.08 * across**2
    tooth = np.array(TOOTH, float) * (shade * (1.0 - 0.10 * height))[..., None]
    gum = np.array(GUM, float) * (1.0 - 0.10 * across**2)[..., None]
    # No renderer of such a mesh shades a mouth from within: the shadow of the cheeks is painted.
    dusk = _step(*DUSK[name], np.abs(angle)) * np.ones_like(height)
    light = 1.0 - dusk[..., None] * np.array(SHADOW)
    return _pixels(_mix(tooth, gum, _step(-0.03, 0.03, height - gum_line)) * light)


def tongue(size: int = 128) -> Pixels:
    """(size, size, 3) uint8 texture of the tongue, darker at its root and in its furrow."""
    u, v = _places(size, size)
    top = np.clip(np.sin(v), 0.0, 1.0)
    shade = 0.30 + 0.70 * _step(0.1, 0.85, u) - 0.12 * top**40
    grain = 1.0 + 0.02 * np.sin(61.0 * u + 3.0 * np.sin(9.0 * v)) * np.sin(23.0 * v)
    return _pixels(np.array(TONGUE, float) * (shade * grain)[..., None])


@lru_cache(maxsize=16)
def texture(name: str, iris: Colour = IRIS_COLOUR, white: Colour = EYE_WHITE) -> Pixels:
    """(H, W, 3) uint8 texture of a part, read-only.

    Texel [0, 0] lies at u = 0, v = 0; texture coordinates are (v / 2 pi, u).

    Args:
        name: of the part.
        iris, white: colours of the eyes.

    Raises:
        InputError: no part has that name, or no such colour.
    """
    material = part(name).material
    if material == "teeth":
        pixels = teeth(name.removesuffix("_teeth"))
    elif material == "eye":
        pixels = eye(iris, white=white)
    elif material == "lids":
        pixels = lids()
    else:
        pixels = {"mouth": mouth, "tongue": tongue}[material]()
    pixels.setflags(write=False)
    return pixels


def lids(size: int = 32) -> Pixels:
    """(size, 8, 3) uint8 texture of the rims of the lids: skin, then moist and pink."""
    u, _ = _places(size, 8)
    skin, moist = np.array((206.0, 154.0, 134.0)), np.array((188.0, 116.0, 106.0))
    return _pixels(_mix(skin, moist, _step(0.0, 0.35, u)))


def _places(rows: int, columns: int) -> tuple[FloatArray, FloatArray]:
    """u and v of the middle of each texel, (rows, columns) each."""
    u = (np.arange(rows) + 0.5) / rows
    v = (np.arange(columns) + 0.5) * (2.0 * np.pi / columns)
    u, v = np.meshgrid(u, v, indexing="ij")
    return u, v


def _fibres(v: FloatArray, across: FloatArray) -> FloatArray:
    """Radial streaks between -1 and 1: sums of waves round the pupil that bend outwards."""
    rng = np.random.default_rng(1)
    total = np.zeros_like(v)
    waves = (17, 29, 43, 61, 83, 109, 137)
    for wave in waves:
        phase, bend = rng.uniform(0.0, 2.0 * np.pi), rng.normal(scale=1.2)
        total += np.sin(wave * v + phase + bend * across)
    return total / np.sqrt(0.5 * len(waves)) / 2.5


def _step(low: float, high: float, x: FloatArray) -> FloatArray:
    """0 below ``low``, 1 above ``high``, smooth between."""
    t = np.clip((x - low) / (high - low), 0.0, 1.0)
    return t * t * (3.0 - 2.0 * t)


def _mix(first: FloatArray, second: FloatArray, share: FloatArray) -> FloatArray:
    return first + (second - first) * share[..., None]


def _pixels(colours: FloatArray) -> Pixels:
    return np.rint(colours.clip(0.0, 255.0)).astype(np.uint8)
