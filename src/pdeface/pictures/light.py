"""Light: from normals to colours, worked out per vertex.

The lamps stand with the camera, so that a face is lit alike from every side. Light is added
in linear units and encoded as sRGB at the end, which is what keeps the shadows soft.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from pdeface.errors import InputError
from pdeface.pictures.camera import Camera

__all__ = ["RIGS", "Lamp", "Rig", "decode_srgb", "encode_srgb", "light_up", "rig_named"]

FloatArray = NDArray[np.float64]


@dataclass(frozen=True)
class Lamp:
    """A distant light.

    Attributes:
        direction: towards the lamp, in the picture's axes (right, up, towards the viewer).
        color: linear red, green and blue; its size is the strength.
        wrap: 0 for a point of light, towards 1 for one so large that it reaches around the form.
    """

    direction: tuple[float, float, float]
    color: tuple[float, float, float]
    wrap: float = 0.0


@dataclass(frozen=True)
class Rig:
    """A set of lamps, with light from all around and a faint sheen.

    Attributes:
        sky, ground: linear ambient colour from above and from below.
        sheen: strength of the highlight of the first lamp.
        gloss: how small the highlight is (the exponent of Blinn and Phong).
    """

    lamps: tuple[Lamp, ...]
    sky: tuple[float, float, float]
    ground: tuple[float, float, float]
    sheen: float = 0.0
    gloss: float = 24.0


RIGS: Final[dict[str, Rig]] = {
    "studio": Rig(
        lamps=(
            Lamp((-0.55, 0.62, 0.62), (0.98, 0.93, 0.87), 0.18),
            Lamp((0.85, 0.05, 0.45), (0.17, 0.185, 0.21), 0.35),
            Lamp((0.45, 0.75, -0.55), (0.22, 0.22, 0.23), 0.10),
        ),
        sky=(0.235, 0.245, 0.26),
        ground=(0.085, 0.08, 0.075),
        sheen=0.05,
    ),
    "raking": Rig(
        lamps=(
            Lamp((-0.90, 0.34, 0.27), (1.10, 1.06, 1.00)),
            Lamp((0.92, 0.10, 0.27), (0.34, 0.38, 0.44)),
        ),
        sky=(0.07, 0.07, 0.075),
        ground=(0.04, 0.04, 0.04),
    ),
    "gallery": Rig(
        lamps=(
            Lamp((-0.45, 0.60, 0.66), (0.62, 0.61, 0.59), 0.30),
            Lamp((0.85, 0.05, 0.45), (0.14, 0.145, 0.16), 0.35),
        ),
        sky=(0.40, 0.405, 0.42),
        ground=(0.24, 0.24, 0.245),
    ),
    "soft": Rig(
        lamps=(Lamp((-0.30, 0.45, 0.85), (0.38, 0.38, 0.38), 0.35),),
        sky=(0.66, 0.66, 0.66),
        ground=(0.50, 0.50, 0.50),
    ),
}
"""``studio``: three-point light; ``gallery``: brighter, for white surfaces with lines on them;
``raking``: lamps from the sides, which show every ripple; ``soft``: nearly even, for a texture
that brings its own light."""


def rig_named(name: str) -> Rig:
    """A rig by its name; InputError for a name that there is not."""
    try:
        return RIGS[name]
    except KeyError:
        raise InputError(f"light is one of {', '.join(RIGS)}, got {name!r}; try 'studio'") from None


def light_up(
    vertices: FloatArray, normals: FloatArray, albedo: FloatArray, camera: Camera, rig: Rig
) -> FloatArray:
    """sRGB colours of lit vertices.

    Args:
        vertices, normals: (V, 3) metres, and unit vectors.
        albedo: (3,) or (V, 3) linear reflectances.

    Returns:
        (V, 3) from 0 to 1.
    """
    axes = np.stack([camera.right, camera.up, camera.backward], axis=1)
    seen = normals @ axes
    height = 0.5 + 0.5 * seen[:, 1:2]
    light = height * np.array(rig.sky) + (1.0 - height) * np.array(rig.ground)
    for lamp in rig.lamps:
        light = light + _diffuse(seen, lamp) * np.array(lamp.color)
    color = albedo * light
    if rig.sheen > 0.0:
        color = color + rig.sheen * _highlight(vertices, seen, axes, camera, rig)
    return encode_srgb(np.clip(color, 0.0, 1.0))


def _unit(vector: FloatArray) -> FloatArray:
    length: FloatArray = np.linalg.norm(vector, axis=-1, keepdims=True)
    return vector / np.maximum(length, 1e-300)


def _diffuse(normals: FloatArray, lamp: Lamp) -> FloatArray:
    """(V, 1) share of the lamp's light that a surface facing this way catches."""
    facing = normals @ _unit(np.array(lamp.direction))
    caught: FloatArray = np.clip((facing + lamp.wrap) / (1.0 + lamp.wrap), 0.0, 1.0)[:, None]
    return caught ** (1.0 + lamp.wrap)


def _highlight(
    vertices: FloatArray, seen: FloatArray, axes: FloatArray, camera: Camera, rig: Rig
) -> FloatArray:
    """(V, 1) Blinn-Phong reflection of the first lamp."""
    to_eye = _unit(camera.position - vertices) @ axes
    half = _unit(to_eye + _unit(np.array(rig.lamps[0].direction)))
    aligned = np.clip(np.sum(seen * half, axis=1), 0.0, 1.0)
    shine: FloatArray = (aligned**rig.gloss)[:, None]
    return shine


def encode_srgb(linear: FloatArray) -> FloatArray:
    """Display values of linear ones, both from 0 to 1 (IEC 61966-2-1)."""
    low = 12.92 * linear
    high = 1.055 * np.power(np.maximum(linear, 0.0031308), 1.0 / 2.4) - 0.055
    return np.where(linear <= 0.0031308, low, high)


def decode_srgb(display: FloatArray) -> FloatArray:
    """Linear values of display ones, both from 0 to 1 (IEC 61966-2-1)."""
    high = np.power((np.maximum(display, 0.04045) + 0.055) / 1.055, 2.4)
    return np.where(display <= 0.04045, display / 12.92, high)
