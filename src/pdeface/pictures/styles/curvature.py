"""Style ``curvature``: the mean curvature in colour, red where the face bulges."""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray

from pdeface.face import Face
from pdeface.pictures.camera import Camera
from pdeface.pictures.light import decode_srgb, rig_named
from pdeface.pictures.options import Options
from pdeface.pictures.skin import skin
from pdeface.pictures.solid import Solid
from pdeface.uvmesh import UVMesh

__all__ = ["QUANTITY", "curvature", "curvature_limit", "diverging"]

FloatArray = NDArray[np.float64]

QUANTITY: Final = "mean curvature, 1/m"

FINE: Final = (141, 161)
"""The uv mesh that is drawn; second derivatives take longer than positions."""

COARSE: Final = (55, 61)
"""The uv mesh on which the range of the colours is found, whatever is drawn."""

STOPS: Final = np.array(
    [
        [0.02, 0.19, 0.38],
        [0.13, 0.40, 0.67],
        [0.47, 0.71, 0.86],
        [0.95, 0.95, 0.95],
        [0.96, 0.64, 0.50],
        [0.79, 0.21, 0.24],
        [0.42, 0.02, 0.13],
    ]
)
"""sRGB colours from the most hollow to the most bulging; grey for flat."""


def curvature(face: Face, camera: Camera, options: Options) -> list[Solid]:
    """The surface coloured by its mean curvature, positive where it bulges outwards."""
    mesh = options.sample(face, otherwise=FINE)
    values = _mean(face, options.uv_mesh(face, otherwise=FINE), options)
    color = decode_srgb(diverging(values / curvature_limit(face, options)))
    return skin(mesh, color, camera, rig_named(options.light or "soft"))


def curvature_limit(face: Face, options: Options) -> float:
    """The value, 1/m, at which the colours end: round, and nine tenths of the face keep to it."""
    limit = float(np.quantile(np.abs(_mean(face, UVMesh(*COARSE), options)), 0.9))
    if limit <= 0.0:
        return 1.0
    unit = 10.0 ** np.floor(np.log10(limit))
    return float(unit * np.ceil(limit / unit))


def _mean(face: Face, domain: UVMesh, options: Options) -> FloatArray:
    mean = face.surface(options.join).curvature(*domain.nodes.T).mean
    return np.nan_to_num(mean, nan=0.0, posinf=0.0, neginf=0.0)


def diverging(values: FloatArray) -> FloatArray:
    """(V, 3) sRGB colours of values from -1 (blue) over 0 (grey) to 1 (red)."""
    place = np.linspace(-1.0, 1.0, len(STOPS))
    channels = [np.interp(values, place, STOPS[:, c]) for c in range(3)]
    return np.stack(channels, axis=-1)
