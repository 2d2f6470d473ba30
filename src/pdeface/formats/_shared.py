"""What every format says alike: who wrote it, and how a face without a texture looks."""

from __future__ import annotations

from pdeface import __version__

__all__ = ["GENERATOR", "ROUGHNESS", "SKIN", "linear"]

GENERATOR = f"pdeface {__version__}"

SKIN = (0.76, 0.70, 0.66)
"""A grey with a little of skin in it, sRGB 0..1: shape shows on it, and nobody's colour."""

ROUGHNESS = 0.8
"""Of skin without make-up: light shapes it and hardly shines on it."""


def linear(srgb: float) -> float:
    """An sRGB value in linear light, as glTF wants factors (IEC 61966-2-1)."""
    return srgb / 12.92 if srgb <= 0.04045 else float(((srgb + 0.055) / 1.055) ** 2.4)
