"""The names that a track may have: of the 52 ARKit expressions, and of angles."""

from __future__ import annotations

from pdeface.controls import ARKIT
from pdeface.controls.naming import both_sides, did_you_mean

__all__ = ["ANGLE_NAMES", "ARKIT_NAMES", "both_sides", "did_you_mean"]

ARKIT_NAMES = ARKIT
"""The blendshapes of Apple's ARKit, in its order; left and right are the subject's."""

ANGLE_NAMES = tuple(
    part + angle for part in ("head", "leftEye", "rightEye") for angle in ("Yaw", "Pitch", "Roll")
)
"""The nine angles that a recording may have: of the head, the left and the right eye."""
