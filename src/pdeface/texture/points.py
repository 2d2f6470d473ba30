"""The 25 named feature points of a photo (Fig. 5 of the paper), and their file."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pdeface import files
from pdeface.errors import InputError
from pdeface.texture import _point_checks, _points_file
from pdeface.texture._point_checks import NAMES, OPTIONAL_NAMES, POINT_NAMES

__all__ = ["POINT_NAMES", "FeaturePoints"]

FloatArray = NDArray[np.float64]

_SAME_SHAPE = 0.005


@dataclass(frozen=True)
class FeaturePoints:
    """Where the 25 feature points of Fig. 5 lie in a photo.

    Coordinates are pixels, x to the right and y down, measured from the picture's top-left
    corner: the centre of pixel [row, column] is at (column + 1/2, row + 1/2). Left and right are
    the subject's: in a photo the right eye is on the left-hand side.

    Attributes:
        positions: (x, y) of each of the names in ``POINT_NAMES``; for an open mouth also of
            ``upper_lip`` and ``lower_lip``, the middle of the edges between which teeth show.
        image_size: (width, height) of the photo that they were placed on.

    Raises:
        InputError: a name is missing or unknown, or a position is not two finite numbers.
    """

    positions: Mapping[str, tuple[float, float]]
    image_size: tuple[int, int]

    def __post_init__(self) -> None:
        given = dict(self.positions)
        _point_checks.check_names(given)
        names = [*NAMES, *(name for name in OPTIONAL_NAMES if name in given)]
        ordered = {name: _point_checks.check_position(name, given[name]) for name in names}
        object.__setattr__(self, "positions", MappingProxyType(ordered))
        object.__setattr__(self, "image_size", _point_checks.check_size(self.image_size))

    def __reduce__(self) -> tuple[Any, ...]:
        # A mapping proxy cannot be pickled or copied.
        return type(self), (dict(self.positions), self.image_size)

    @property
    def array(self) -> FloatArray:
        """(5, 5, 2) positions, in the order of ``POINT_NAMES``."""
        return np.array([self.positions[name] for name in NAMES]).reshape(5, 5, 2)

    @property
    def tilt(self) -> float:
        """Angle of the line from the right eye to the left, radians; positive is clockwise."""
        right, left = self.positions["right_eye_middle"], self.positions["left_eye_middle"]
        return math.atan2(left[1] - right[1], left[0] - right[0])

    @classmethod
    def from_array(cls, array: Any, image_size: tuple[int, int]) -> FeaturePoints:
        """Points from 25 positions in the order of ``POINT_NAMES``, as (5, 5, 2) or (25, 2)."""
        flat = np.asarray(array, dtype=np.float64)
        if flat.size != 50:
            raise InputError(f"expected 25 points (x, y), got an array of {flat.shape}")
        pairs = [(float(x), float(y)) for x, y in flat.reshape(25, 2)]
        return cls(dict(zip(NAMES, pairs, strict=True)), image_size)

    @classmethod
    def load(cls, path: files.PathLike) -> FeaturePoints:
        """Read a points file; docs/points.md describes it.

        Raises:
            InputError: the file cannot be opened, or a point in it cannot be used.
            FileFormatError: it is not a points file, is damaged, or is newer than this library.
        """
        positions, size = _points_file.read(path)
        try:
            return cls(positions, size)
        except InputError as error:
            raise InputError(f"{path}: {error}") from error

    def save(self, path: files.PathLike) -> None:
        """Write a points file, all of it or nothing.

        Raises:
            InputError: the file cannot be written.
        """
        _points_file.write(path, self.positions, self.image_size)

    def scaled_to(self, image_shape: tuple[int, ...]) -> FeaturePoints:
        """The points on a smaller or larger copy of the same photo.

        Args:
            image_shape: (height, width, ...) of the copy.

        Raises:
            InputError: it has other proportions, so it cannot be the same photo.
        """
        height, width = image_shape[:2]
        if (width, height) == self.image_size:
            return self
        x, y = width / self.image_size[0], height / self.image_size[1]
        rounding = 1.0 / min(width, height, *self.image_size)
        if abs(x / y - 1.0) > _SAME_SHAPE + rounding:
            raise InputError(
                f"the points were placed on a photo of {self.image_size[0]} x "
                f"{self.image_size[1]} pixels, this one has {width} x {height}, which is another "
                "shape; use the photo they belong to, or place them anew"
            )
        return self.moved(lambda positions: positions * (x, y), (width, height))

    def moved(
        self, move: Callable[[FloatArray], FloatArray], image_size: tuple[int, int]
    ) -> FeaturePoints:
        """The points on another image, to which ``move`` takes (n, 2) positions."""
        new = move(np.array(list(self.positions.values())))
        positions = dict(zip(self.positions, map(tuple, new.tolist()), strict=True))
        return FeaturePoints(positions, image_size)

    def validate(self, image_shape: tuple[int, ...]) -> None:
        """Refuse points that the photo cannot be warped by.

        Args:
            image_shape: (height, width, ...) of the photo.

        Raises:
            InputError: a point lies outside the photo, or two are in crossing order; the message
                names them.
        """
        _point_checks.check_inside(self.positions, image_shape)
        _point_checks.check_sides(self.array)
        _point_checks.check_order(self.upright())
        above, below = self.opening()
        _point_checks.check_lips(-above, 0.0, below)

    def upright(self) -> FloatArray:
        """(5, 5, 2) positions about the middle between the eyes, turned so that these are level."""
        return self._turned(self.array)

    def opening(self) -> tuple[float, float]:
        """How far the mouth is open above and below its centre, pixels; 0 where it is closed."""
        if OPTIONAL_NAMES[0] not in self.positions:
            return 0.0, 0.0
        names = "mouth_centre", *OPTIONAL_NAMES
        centre, upper, lower = self._turned(np.array([self.positions[n] for n in names]))[:, 1]
        return float(centre - upper), float(lower - centre)

    def _turned(self, positions: FloatArray) -> FloatArray:
        eyes = self.array[1, [1, 3]]
        across = np.array([math.cos(self.tilt), math.sin(self.tilt)])
        down = np.array([-across[1], across[0]])
        from_eyes = positions - eyes.mean(axis=0)
        return np.stack([from_eyes @ across, from_eyes @ down], axis=-1)
