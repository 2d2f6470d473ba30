"""The identity that the detector's network suggests: what landmarks do not say of a face.

The values of an inner layer (:mod:`pdeface.photo.network`), of the face and of its mirror image,
are mapped to weights of the identity modes by a linear regression, learnt together with that of
the landmarks (:mod:`pdeface.photo.regression`). Its numbers are in ``data/traits.npz``.
"""

from __future__ import annotations

from functools import lru_cache
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from pdeface.photo.network import Network, square

__all__ = ["TRAITS", "Reading", "find_traits", "reading", "traits_of"]

FloatArray = NDArray[np.float64]
Pixels = NDArray[np.uint8]

TRAITS = Path(__file__).parent / "data" / "traits.npz"


class Reading(NamedTuple):
    """What was learnt.

    Attributes:
        centre, spread: (8192,) means of the layer's values, and what they are divided by.
        weights: (8192, 50) of these in the identity modes, 127 for the largest of a mode.
        scale: (50,) what 1 stands for.
        signs: (50,) what a mirror does to each identity mode.
    """

    centre: FloatArray
    spread: FloatArray
    weights: NDArray[np.int8]
    scale: FloatArray
    signs: FloatArray


@lru_cache(maxsize=1)
def reading() -> Reading:
    """What ships with the package."""
    with np.load(TRAITS, allow_pickle=False) as file:
        numbers = {name: file[name].astype(np.float64) for name in Reading._fields}
        return Reading(**numbers | {"weights": file["weights"]})


def find_traits(network: Network, photo: Pixels, landmarks: FloatArray) -> FloatArray:
    """(50,) the traits of a face in a photo.

    Args:
        network: the detector's.
        photo: (H, W, 3 or 4).
        landmarks: (478, 3) the face's, pixels of the photo.
    """
    seen = square(photo, landmarks)
    return traits_of(network.inner([seen, np.ascontiguousarray(seen[:, ::-1])]), reading())


def traits_of(inner: NDArray[np.floating], learnt: Reading) -> FloatArray:
    """(..., 50) traits of the layer's values (..., 2, 8192), of a face and of its mirror image."""
    read = (inner - learnt.centre) / learnt.spread @ learnt.weights.astype(np.float32)
    return np.asarray(0.5 * learnt.scale * (read[..., 0, :] + learnt.signs * read[..., 1, :]))
