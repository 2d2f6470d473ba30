"""How much of a face something covers: glasses, hair, a hand in a glove, a hard shadow."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from pdeface.photo.alignment import seen
from pdeface.photo.texturing import PhotoView
from pdeface.photo.visibility import trust
from pdeface.template import openings
from pdeface.texture import shown

__all__ = ["COVERED", "covered"]

COVERED = 0.10
"""Part of the face from which on something covers it; free faces have 0.03 and less."""

_SIZE = (128, 128)


def covered(view: PhotoView) -> float:
    """Part of the skin of a face, as far as a photo shows it, whose colour is not the skin's.

    The skin is that of the forehead's lower half, the cheeks, the nose and the chin, without eyes,
    brows, nostrils and lips. What has the colour of skin, a hand for one, is not noticed.
    """
    face = seen(view.found, view.shape)
    sure = trust(face.points, face.normals, view.shape.camera.distance)
    known, skin = shown(view.photo, face.places, sure, face.nodes, _SIZE)
    weight = known * _skin_region()
    total = float(weight.sum())
    return float((weight * (1.0 - skin)).sum()) / total if total > 1.0 else 0.0


def _skin_region() -> NDArray[np.float64]:
    """(H, W) 1 where a face is skin and nothing else."""
    height, width = _SIZE
    u = ((np.arange(height) + 0.5) / height)[:, None]
    v = np.asarray((np.arange(width) + 0.5) * (np.pi / width), dtype=np.float64)
    aside = np.abs(v - 0.5 * np.pi)[None]
    region = (u > 0.16) & (u < 0.84) & (aside < 0.85)
    for opening in openings():
        margin_u, margin_v = (0.03, 0.05) if opening.name != "mouth" else (0.10, 0.12)
        start, end = opening.corners
        upper, lower = opening.lines(v)
        beside = (v > start - margin_v) & (v < end + margin_v)
        region &= ~(beside & (u > upper - margin_u) & (u < lower + margin_u))
    nostrils = (u > 0.44) & (u < 0.58) & (aside < 0.45)
    return np.asarray(region & ~nostrils, dtype=np.float64)
