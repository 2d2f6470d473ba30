"""Where on the face MediaPipe's landmarks lie.

The numbers in ``data/landmarks.npz`` were measured by ``python -m pdeface.photo.build``.
"""

from __future__ import annotations

from functools import lru_cache
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

__all__ = ["DATA", "Anchors", "anchors"]

FloatArray = NDArray[np.float64]

DATA = Path(__file__).parent / "data" / "landmarks.npz"


class Anchors(NamedTuple):
    """Landmarks on the face.

    Attributes:
        uv: (478, 2) u, and v in radians.
        spread: (478,) root mean square distance on one axis of what is found in a picture from
            where the surface has it, in eye distances, that no mode explains.
        modes: (modes, 478, 2) how the landmarks err together: pixels to the right and down with
            the eyes level, in eye distances, for one standard deviation.
    """

    uv: FloatArray
    spread: FloatArray
    modes: FloatArray


@lru_cache(maxsize=1)
def anchors() -> Anchors:
    """The anchors that were measured."""
    with np.load(DATA, allow_pickle=False) as file:
        arrays = [file[name].astype(np.float64) for name in Anchors._fields]
    for array in arrays:
        array.setflags(write=False)
    return Anchors(*arrays)
