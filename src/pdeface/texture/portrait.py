"""The bundled portrait: a real photo with its feature points, to try everything on."""

from __future__ import annotations

from importlib.resources import as_file, files

import numpy as np
from numpy.typing import NDArray

from pdeface.texture.photos import read_photo
from pdeface.texture.points import FeaturePoints

__all__ = ["portrait"]


def portrait() -> tuple[NDArray[np.uint8], FeaturePoints]:
    """The astronaut Eileen Collins (NASA, public domain) and the 25 points of her face.

    She smiles with visible teeth, her head is tilted by 4 degrees and hardly turned.

    Returns:
        (256, 256, 3) uint8 and its feature points.
    """
    data = files("pdeface.texture") / "data"
    with as_file(data / "portrait.json") as path:
        points = FeaturePoints.load(path)
    return read_photo((data / "portrait.png").read_bytes()), points
