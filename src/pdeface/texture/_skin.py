"""What of a face's texture is skin, what is hair and what is neither.

The middle of a face is skin: cheeks, nose and chin, without eyes and lips. Its colours are taken as
normally distributed, in logarithms of brightness and of the ratios of red and blue to green, which
shading changes little; a texel many deviations away is not skin. What is not skin is hair where a
head has hair, above the brows and beside the eyes, and something else (an ear, a collar, the
background) beside and below the face.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from pdeface.template import openings
from pdeface.texture._smooth import blur, step

__all__ = ["Kinds", "kinds"]

FloatArray = NDArray[np.floating[Any]]

_FLOOR = 4.0
"""Brightness, of 255, below which colour is noise."""

_LEAST = (0.03, 0.03, 0.12)
"""What is added to the spread of the logarithms: red and blue against green, brightness."""

_NEAR, _FAR = 3.5, 5.5
"""Deviations within which a colour is skin, and beyond which it is not."""

_FEWEST = 64


class Kinds(NamedTuple):
    """(H, W) each, 0 to 1.

    Attributes:
        skin: how like this person's skin a texel is.
        hair: whether it is hair.
        face: whether it belongs to the face at all.
    """

    skin: FloatArray
    hair: FloatArray
    face: FloatArray


def kinds(colours: FloatArray, known: FloatArray) -> Kinds:
    """What each texel shows.

    Args:
        colours: (H, W, 3) over the face, 0 <= u <= 1 and 0 <= v <= pi, 0 to 255.
        known: (H, W) how far each can be trusted, 0 to 1.
    """
    height, width = known.shape
    u = ((np.arange(height) + 0.5) / height)[:, None]
    v = ((np.arange(width) + 0.5) * (np.pi / width))[None]
    aside = np.abs(v - 0.5 * np.pi)
    skin = _likeness(colours, _sample(u, v, aside) & (known > 0.9))
    fine = height / 256.0
    zone = _hair_zone(u, aside)
    hair = step(0.3, 0.7, blur(1.0 - skin, fine) * zone)
    outside = np.clip(step(0.75, 0.95, aside) + step(0.86, 0.89, u), 0.0, 1.0) * (1.0 - zone)
    face = 1.0 - outside * (1.0 - step(0.6, 0.95, blur(skin, fine)))
    # Where a face ends photos show ears and what is behind the head, however well they fit.
    face = face * step(1.45, 1.2, aside) * step(0.89, 0.83, u)
    return Kinds(skin, hair, np.asarray(face))


def _sample(u: FloatArray, v: FloatArray, aside: FloatArray) -> NDArray[np.bool_]:
    """Where a face is skin for sure."""
    mouth = openings()[2]
    seam = mouth.lines(v[0])[0][None]
    lips = (np.abs(u - seam) < 0.12) & (aside < 0.45)
    return np.asarray((u > 0.42) & (u < 0.85) & (aside < 0.9) & ~lips)


def _hair_zone(u: FloatArray, aside: FloatArray) -> FloatArray:
    """Where hair can be: above the brows, and beside the eyes down to the ears."""
    limit = 0.10 + 0.30 * step(0.75, 1.35, aside)
    return step(0.03, -0.03, u - limit)


def _likeness(colours: FloatArray, sample: NDArray[np.bool_]) -> FloatArray:
    """(H, W) how like the colours of the sample every colour is."""
    logs = _logarithms(colours)
    chosen = logs[sample].astype(np.float64)
    if len(chosen) < _FEWEST:  # nothing to tell skin by: all is
        return np.ones(sample.shape, np.float32)
    middle = np.median(chosen, axis=0)
    apart = chosen - middle
    # Without moles, highlights, stubble and glasses: first by the medians of their distances.
    spread = np.diag(np.square(1.48 * np.median(np.abs(apart), axis=0)) + np.square(_LEAST))
    for _ in range(4):
        inverse = np.linalg.inv(spread)
        near = np.einsum("ni,ij,nj->n", apart, inverse, apart) < 9.0
        if near.sum() < _FEWEST:
            break
        apart = apart[near]
        spread = _covariance(apart)
    inverse = np.linalg.inv(spread).astype(np.float32)
    off = logs - middle.astype(np.float32)
    distance = np.sqrt(np.einsum("hwi,ij,hwj->hw", off, inverse, off).clip(0.0))
    return step(_FAR, _NEAR, distance)


def _covariance(apart: FloatArray) -> FloatArray:
    return np.asarray(np.cov(apart.T) + np.diag(np.square(_LEAST)))


def _logarithms(colours: FloatArray) -> FloatArray:
    """(H, W, 3) log(R / G), log(B / G), log of the brightness."""
    red, green, blue = np.moveaxis(np.log(np.maximum(colours, _FLOOR)), -1, 0)
    light = np.log(np.maximum(colours @ np.array([0.2126, 0.7152, 0.0722], np.float32), _FLOOR))
    return np.stack([red - green, blue - green, light], axis=-1).astype(np.float32)
