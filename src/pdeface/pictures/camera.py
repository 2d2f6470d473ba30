"""Where a picture is taken from: views by name or angle, and a camera framed on the face.

The camera turns about a vertical axis in the middle of the face. From everywhere in front of it
the distance is the same, so that pictures of one face from several sides have one scale.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Final

import numpy as np
from numpy.typing import NDArray

from pdeface.errors import InputError

__all__ = ["VIEWS", "Camera", "View", "frame", "parse_view"]

FloatArray = NDArray[np.float64]

View = str | float | tuple[float, float]
"""A name in :data:`VIEWS`, an azimuth, or (azimuth, elevation); degrees."""

VIEWS: Final[dict[str, tuple[float, float]]] = {
    "front": (0.0, 0.0),
    "three-quarter": (35.0, 0.0),
    "profile": (90.0, 0.0),
    "three-quarter-right": (-35.0, 0.0),
    "profile-right": (-90.0, 0.0),
    "45": (45.0, 0.0),
    "back": (180.0, 0.0),
}
"""Named views as (azimuth, elevation) in degrees. The azimuth is positive where the camera
moves towards the subject's left, so that the nose points to the left of the picture."""

FIELD_OF_VIEW: Final = 20.0
"""Vertical angle of view in degrees: a portrait lens."""

MARGIN: Final = 0.9
"""Share of the picture's height or width that the face may fill."""


@dataclass(frozen=True)
class Camera:
    """A perspective camera.

    Attributes:
        position: (3,) where it stands, metres.
        target: (3,) what it looks at, metres.
        right, up: (3,) unit vectors of the picture's axes.
        fov: vertical angle of view, degrees.
    """

    position: FloatArray
    target: FloatArray
    right: FloatArray
    up: FloatArray
    fov: float = FIELD_OF_VIEW

    @property
    def backward(self) -> FloatArray:
        """(3,) unit vector from the target to the camera."""
        return np.cross(self.right, self.up)

    @property
    def distance(self) -> float:
        """Metres from the camera to its target."""
        return float(np.linalg.norm(self.position - self.target))

    def project(self, points: FloatArray, size: tuple[int, int]) -> tuple[FloatArray, FloatArray]:
        """Pixel coordinates and depths of points in space.

        Args:
            points: (..., 3) metres.
            size: (width, height) of the picture.

        Returns:
            (..., 2) pixel coordinates from the top left corner, x to the right and y
            downwards, and (...,) distances in front of the camera, metres.
        """
        width, height = size
        offset = np.asarray(points, dtype=np.float64) - self.position
        depth = -(offset @ self.backward)
        focal = 0.5 * height / np.tan(np.radians(self.fov) / 2.0)
        x = 0.5 * width + focal * (offset @ self.right) / depth
        y = 0.5 * height - focal * (offset @ self.up) / depth
        return np.stack([x, y], axis=-1), depth

    def pixel_size(self, height: int) -> float:
        """Width in metres of one pixel at the target, in a picture ``height`` pixels high."""
        return 2.0 * self.distance * float(np.tan(np.radians(self.fov) / 2.0)) / height


def parse_view(view: View) -> tuple[float, float]:
    """(azimuth, elevation) in degrees of a view.

    Args:
        view: a name in :data:`VIEWS`; an azimuth in degrees, as a number or as text
            (``-35`` or ``"-35"``); or azimuth and elevation (``(35, 10)`` or ``"35,10"``).

    Raises:
        InputError: the view is none of these.
    """
    if isinstance(view, str) and view in VIEWS:
        return VIEWS[view]
    parts = view.split(",") if isinstance(view, str) else np.atleast_1d(view).tolist()
    try:
        angles = [float(part) for part in parts]
    except (TypeError, ValueError):
        angles = []
    if len(angles) not in (1, 2) or not np.all(np.isfinite(angles)):
        raise InputError(
            f"a view is a name ({', '.join(VIEWS)}), an azimuth in degrees or "
            f"'azimuth,elevation', got {view!r}; try 'front' or 35"
        )
    elevation = angles[1] if len(angles) == 2 else 0.0
    if abs(elevation) > 89.0:
        raise InputError(
            f"a view's elevation lies between -89 and 89 degrees, got {elevation:g}; "
            "look from less far above or below"
        )
    return angles[0], elevation


def frame(points: FloatArray, view: View = "front", aspect: float = 0.8) -> Camera:
    """The camera that shows ``points`` from ``view``, equally far off for all views from in front.

    Args:
        points: (..., 3) what must be in the picture, metres.
        view: see :func:`parse_view`.
        aspect: width of the picture over its height.
    """
    azimuth, elevation = parse_view(view)
    points = np.asarray(points, dtype=np.float64).reshape(-1, 3)
    middle = 0.5 * (points.min(axis=0) + points.max(axis=0))
    right, up, backward = axes = _axes(azimuth, elevation)
    seen = (points - middle) @ np.stack([right, up], axis=1)
    across, upwards = 0.5 * (seen.min(axis=0) + seen.max(axis=0))
    target = middle + across * right + upwards * up
    reach = 180.0 if backward[2] < -1e-9 else 90.0
    others = [_axes(angle, 0.0) for angle in np.arange(-reach, reach + 1.0, 15.0)]
    distance = max(_distance(points - middle, aspect, *seen_from) for seen_from in [axes, *others])
    return _centred(Camera(target + distance * backward, target, right, up), points)


def _centred(camera: Camera, points: FloatArray) -> Camera:
    """The camera moved sideways until the points are as far from the left as from the right."""
    x = camera.project(points, (0, 2))[0][..., 0]
    step = 0.5 * (x.min() + x.max()) * camera.pixel_size(2) * camera.right
    return replace(camera, position=camera.position + step, target=camera.target + step)


def _axes(azimuth: float, elevation: float) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Unit vectors of a picture from these angles: right, up, and towards the camera."""
    c, s = np.cos(np.radians(azimuth)), np.sin(np.radians(azimuth))
    e, h = np.cos(np.radians(elevation)), np.sin(np.radians(elevation))
    right, backward = np.array([c, 0.0, -s]), np.array([s * e, h, c * e])
    return right, np.cross(backward, right), backward


def _distance(
    offsets: FloatArray, aspect: float, right: FloatArray, up: FloatArray, backward: FloatArray
) -> float:
    """How far off a camera with these axes must stand for all points to be in its picture."""
    slope = MARGIN * np.tan(np.radians(FIELD_OF_VIEW) / 2.0)
    near, across, upwards = offsets @ backward, offsets @ right, offsets @ up
    across = across - 0.5 * (across.min() + across.max())
    upwards = upwards - 0.5 * (upwards.min() + upwards.max())
    return float(np.max(near + np.maximum(np.abs(across) / aspect, np.abs(upwards)) / slope))
