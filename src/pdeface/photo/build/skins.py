"""Random skins: textures of the face of many colours, with brows and lips of many shapes.

A detector of landmarks looks for brows, lips and lashes more than for relief, so that the heads it
is tried on need them, and need them different.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import map_coordinates

from pdeface.template import feature_points
from pdeface.template.layout import PAPER_ROWS, ROWS
from pdeface.texture import portrait, uv_texture

__all__ = ["Skin", "random_skin"]

FloatArray = NDArray[np.float64]

_SIZE = 320
_LIGHT, _DARK = np.array([0.93, 0.76, 0.67]), np.array([0.30, 0.19, 0.14])
_PORTRAIT = 0.35
"""Share of the skins that are the bundled portrait's, in another tone."""

_WARP, _BEARDED = 0.006, 0.25
"""How far a skin is warped, of its size, and the share of those with a beard."""

_LAST = PAPER_ROWS - 1
_U, _V = np.meshgrid((np.arange(_SIZE) + 0.5) / _SIZE, np.pi * (np.arange(_SIZE) + 0.5) / _SIZE,
                     indexing="ij")  # fmt: skip


@dataclass(frozen=True, eq=False)
class Skin:
    """What a head is painted with.

    Attributes:
        texture: (H, W, 3) uint8 over the face's (u, v).
        tone: (3,) sRGB from 0 to 1 of the skin around the face.
        hair: (3,) of the hair, or None for a bald head.
        iris: (3,) of the irises.
    """

    texture: NDArray[np.uint8]
    tone: FloatArray
    hair: FloatArray | None
    iris: FloatArray


def random_skin(rng: np.random.Generator) -> Skin:
    """A skin nobody has seen."""
    tone = _LIGHT + (_DARK - _LIGHT) * rng.beta(1.0, 1.5) + rng.normal(0.0, 0.02, 3)
    dark = np.clip(tone * rng.uniform(0.12, 0.75) + rng.normal(0.0, 0.02, 3), 0.02, 0.9)
    if rng.random() < _PORTRAIT:
        image = tone * _portrait(rng.random() < 0.5) ** rng.uniform(0.6, 1.2)
    else:
        image = _painted(rng, tone, dark)
    image = _weathered(rng, _warped(rng, image), dark)
    edge = np.minimum.reduce([_U, 1.0 - _U, _V / np.pi, 1.0 - _V / np.pi])
    inside = np.clip(edge / 0.07, 0.0, 1.0)[..., None]
    pixels = np.clip(inside * image + (1.0 - inside) * tone, 0.0, 1.0)
    hair = None if rng.random() < 0.35 else dark
    iris = np.array([0.35, 0.25, 0.15]) * rng.uniform(0.3, 1.5) + rng.uniform(0.0, 0.15, 3)
    return Skin(np.rint(255.0 * pixels).astype(np.uint8), np.clip(tone, 0.0, 1.0), hair, iris)


@lru_cache(maxsize=2)
def _portrait(mirrored: bool) -> FloatArray:
    """(H, W, 3) the bundled portrait's skin, divided by its usual tone."""
    image = uv_texture(*portrait(), size=(_SIZE, _SIZE)).image / 255.0
    usual = np.median(image[_SIZE // 3 : -_SIZE // 5].reshape(-1, 3), axis=0)
    return np.asarray((image[:, ::-1] if mirrored else image) / usual)


def _painted(rng: np.random.Generator, tone: FloatArray, dark: FloatArray) -> FloatArray:
    """(H, W, 3) skin with blotches, brows, lashes and lips."""
    waves = rng.uniform(-12.0, 12.0, (6, 2))
    blotches = sum(rng.normal(0.0, 0.03) * np.cos(a * _U + b * _V) for a, b in waves)
    image = tone * (1.0 + np.asarray(blotches))[..., None]
    lips = tone * (1.0, rng.uniform(0.6, 0.95), rng.uniform(0.65, 1.0)) * rng.uniform(0.75, 1.05)
    for mask, color in (
        (_lips(rng), lips),
        (rng.uniform(0.2, 0.9) * _lashes(rng), 0.35 * dark),
        (rng.uniform(0.4, 1.0) * _brows(rng), dark),
    ):
        image = image + mask[..., None] * (color - image)
    return image


def _warped(rng: np.random.Generator, image: FloatArray) -> FloatArray:
    """The image with everything a little elsewhere, smoothly."""
    places = []
    for axis, size in ((_U, 1.0), (_V, np.pi)):
        waves = rng.uniform(-9.0, 9.0, (4, 2))
        moved = sum(rng.normal(0.0, _WARP) * np.sin(a * _U + b * _V) for a, b in waves)
        places.append(np.clip(_SIZE * (axis / size + moved) - 0.5, 0.0, _SIZE - 1.001))
    return _read(image, *places)


def _weathered(rng: np.random.Generator, image: FloatArray, dark: FloatArray) -> FloatArray:
    """The image with what skins have: grain, blush, shadows under eyes, folds, and stubble."""
    for cells in (10, 24, 60, 150):
        coarse = rng.normal(0.0, rng.uniform(0.0, 0.035), (cells, cells))
        image = image * (1.0 + _enlarged(coarse))[..., None]
    for mask, most in ((_under_eyes(rng), 0.35), (_folds(rng), 0.35), (_cheeks(rng), 0.25)):
        redder = 1.0, rng.uniform(0.6, 0.95), rng.uniform(0.6, 0.95)
        color = image * redder * rng.uniform(0.6, 1.0)
        image = image + (rng.uniform(0.0, most) * mask)[..., None] * (color - image)
    if rng.random() < _BEARDED:
        grain = 0.6 + 0.4 * rng.random(_U.shape)
        beard = (rng.uniform(0.1, 0.9) * _beard(rng) * grain)[..., None]
        image = image + beard * (rng.uniform(0.5, 1.0) * dark - image)
    return image


def _enlarged(coarse: FloatArray) -> FloatArray:
    """(H, W) the cells from edge to edge of a skin."""
    at = np.linspace(0.0, len(coarse) - 1.001, _SIZE)
    return _read(coarse[..., None], *np.meshgrid(at, at, indexing="ij"))[..., 0]


def _read(image: FloatArray, row: FloatArray, column: FloatArray) -> FloatArray:
    """(H, W, k) an image between its pixels, bilinear."""
    layers = np.moveaxis(image, -1, 0)
    return np.stack([map_coordinates(each, [row, column], order=1) for each in layers], axis=-1)


def _under_eyes(rng: np.random.Generator) -> FloatArray:
    u = ROWS["lower_lid_margin"] / _LAST + rng.uniform(0.015, 0.035)
    away = np.abs(np.abs(_V - np.pi / 2) - rng.uniform(0.5, 0.65))
    return np.exp(-(((_U - u) / 0.02) ** 2) - (away / 0.2) ** 2)


def _folds(rng: np.random.Generator) -> FloatArray:
    """From beside the nose to beside the mouth."""
    low, high = 0.5, rng.uniform(0.66, 0.76)
    line = rng.uniform(0.26, 0.34) + rng.uniform(0.5, 1.0) * (_U - low)
    off = (np.abs(_V - np.pi / 2) - line) / rng.uniform(0.015, 0.05)
    return np.exp(-(off**2)) * _soft(_U - low, 0.04) * _soft(high - _U, 0.05)


def _cheeks(rng: np.random.Generator) -> FloatArray:
    away = np.abs(_V - np.pi / 2) - rng.uniform(0.5, 0.75)
    return np.exp(-(((_U - rng.uniform(0.45, 0.58)) / 0.09) ** 2) - (away / 0.25) ** 2)


def _beard(rng: np.random.Generator) -> FloatArray:
    """The chin and the jaw up to a line, and the upper lip in some; not the lips."""
    away = np.abs(_V - np.pi / 2)
    line = rng.uniform(0.72, 0.82) - rng.uniform(0.05, 0.3) * np.clip(away - 0.35, 0.0, None)
    moustache = (np.abs(_U - 0.615) < 0.03) & (away < 0.33) & (rng.random() < 0.7)
    lips = (np.abs(_U - 0.685) < 0.055) & (away < 0.3)
    return np.asarray(np.maximum(_soft(_U - line, 0.04), 0.9 * moustache) * ~lips)


def _lips(rng: np.random.Generator) -> FloatArray:
    corner = np.pi / 2 - feature_points()["right_mouth_corner"][1]
    across = np.clip(1.0 - ((_V - np.pi / 2) / corner) ** 2, 0.0, 1.0) ** 0.5
    seam = 0.5 * (ROWS["mouth_seam_upper"] + ROWS["mouth_seam_lower"]) / _LAST
    above, below = (rng.uniform(0.8, 1.15) * (row / _LAST - seam) * across
                    for row in (ROWS["upper_lip_border"], ROWS["lower_lip_border"]))  # fmt: skip
    return _soft(_U - seam - above, 0.006) * _soft(seam + below - _U, 0.006) * (across > 0.0)


def _lashes(rng: np.random.Generator) -> FloatArray:
    """Dark lines on the margins of the lids, and a shade on the upper ones."""
    half = 0.24
    mask = np.zeros_like(_U)
    for side in ("right", "left"):
        across = np.abs(_V - feature_points()[f"{side}_eye_middle"][1]) < half
        for row, share in (("upper_lid_margin", 1.0), ("lower_lid_margin", 0.4)):
            mask += across * share * np.exp(-(((_U - ROWS[row] / _LAST) / 0.006) ** 2))
    return np.clip(mask, 0.0, 1.0)


def _brows(rng: np.random.Generator) -> FloatArray:
    """Two arches, each thinner towards its outer end."""
    raised, arch, thick = rng.normal(0.0, 0.012), rng.uniform(0.0, 0.035), rng.uniform(0.006, 0.02)
    inner, outer = rng.uniform(0.2, 0.32), rng.uniform(0.9, 1.02)
    away = np.abs(_V - np.pi / 2)
    along = np.clip((away - inner) / (outer - inner), 0.0, 1.0)
    middle = 0.13 + raised - arch * np.sin(np.pi * along**1.3)
    inside = _soft(away - inner, 0.03) * _soft(outer - away, 0.03)
    return inside * _soft(thick * (1.0 - 0.5 * along) - np.abs(_U - middle), 0.008)


def _soft(distance: FloatArray, width: float) -> FloatArray:
    """0 outside, 1 from ``width`` inside on."""
    return np.clip(distance / width, 0.0, 1.0)
