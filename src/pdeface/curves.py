"""Closed boundary curves: the only degrees of freedom that a face has.

A face is ``K`` closed curves of ``M`` points each (28 x 46 in section 2.2 of the paper). The
first half of every curve is the face, the second half its reflection in the coronal plane
``z = mirror_z``, which makes the curve periodic.

Point ``j`` lies at ``v_j = (j + 1/2) 2 pi / M``. The half-sample shift makes the reflection
``j -> M - 1 - j`` exactly ``v -> 2 pi - v``, so that x and y are even in v (cosines only) and
``z - mirror_z`` is odd (sines only); for M = 46 it also puts point 11 on the midline v = pi/2.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pdeface.errors import InputError

__all__ = ["BoundaryCurves", "curve_parameters", "mirror_points"]

FloatArray = NDArray[np.float64]


def curve_parameters(count: int) -> FloatArray:
    """Parameter ``v_j = (j + 1/2) 2 pi / M`` of each of the ``M = count`` points of a curve."""
    return (np.arange(count, dtype=np.float64) + 0.5) * (2.0 * np.pi / count)


def mirror_points(half: FloatArray, mirror_z: float = 0.0) -> FloatArray:
    """Close half curves by their reflection in the plane ``z = mirror_z`` (section 2.2).

    Args:
        half: (..., M/2, 3) points of the front half.

    Returns:
        (..., M, 3) points of the closed curves.
    """
    back = half[..., ::-1, :] * np.array([1.0, 1.0, -1.0])
    back[..., 2] += 2.0 * mirror_z
    return np.concatenate([half, back], axis=-2)


@dataclass(frozen=True, eq=False)
class BoundaryCurves:
    """``K`` closed curves of ``M`` data points, which the surface passes through.

    Attributes:
        points: (K, M, 3) metres, read-only; curve 0 is the top of the forehead and curve
            K - 1 the chin; point 0 is beside the subject's right ear.
        mirror_z: height of the coronal plane of reflection, metres.
    """

    points: FloatArray
    mirror_z: float = 0.0

    def __post_init__(self) -> None:
        points = np.array(self.points, dtype=np.float64)
        if points.ndim != 3 or points.shape[2] != 3 or points.shape[0] < 2 or points.shape[1] < 4:
            raise InputError(
                "boundary curves need an array of (curves >= 2, points >= 4, 3), "
                f"got {points.shape}; give one row of points per closed curve"
            )
        bad = np.argwhere(~np.isfinite(points))
        if len(bad):
            raise InputError(
                f"boundary curves need finite points, got {points[tuple(bad[0])]} in curve "
                f"{bad[0][0]}, point {bad[0][1]}; remove or replace it"
            )
        points.setflags(write=False)
        object.__setattr__(self, "points", points)
        object.__setattr__(self, "mirror_z", float(self.mirror_z))

    @classmethod
    def from_half(cls, half: Any, mirror_z: float) -> BoundaryCurves:
        """Curves from the (K, M/2, 3) points of their front halves."""
        return cls(mirror_points(np.asarray(half, dtype=np.float64), mirror_z), mirror_z)

    @property
    def shape(self) -> tuple[int, int]:
        """(K, M): the number of curves and of points on each."""
        return self.points.shape[0], self.points.shape[1]

    @property
    def half(self) -> FloatArray:
        """(K, M/2, 3) points of the front halves: what a file needs to hold."""
        return self.points[:, : self.points.shape[1] // 2]

    @property
    def is_mirrored(self) -> bool:
        """Whether every curve is its own reflection, to the last bit."""
        if self.points.shape[1] % 2:
            return False
        return bool(np.array_equal(self.points, mirror_points(self.half, self.mirror_z)))

    def with_points(self, points: Any) -> BoundaryCurves:
        """The same curves through other points."""
        return replace(self, points=np.asarray(points, dtype=np.float64))

    def displaced(self, displacement: Any) -> BoundaryCurves:
        """Curves moved by a (K, M, 3) displacement, metres."""
        return self.with_points(self.points + np.asarray(displacement, dtype=np.float64))

    def __reduce__(self) -> tuple[Any, ...]:
        # Unpickled arrays would be writable.
        return type(self), (self.points, self.mirror_z)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, BoundaryCurves):
            return NotImplemented
        return self.mirror_z == other.mirror_z and np.array_equal(self.points, other.points)

    def __repr__(self) -> str:
        return f"BoundaryCurves({self.shape[0]} curves x {self.shape[1]} points)"
