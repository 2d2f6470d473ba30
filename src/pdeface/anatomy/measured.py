"""What was measured: where eyes and teeth lie behind the openings, and how the jaw moves.

The numbers in ``data/anatomy.npz`` were measured by ``python -m pdeface.anatomy.build`` on
ICT-FaceKit's neutral head and expressions (MIT, Copyright (c) 2020 USC Institute for Creative
Technologies; see NOTICE).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from types import MappingProxyType
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pdeface.anatomy.outline import OPENINGS, Margins, Outline

__all__ = ["DATA", "Arch", "Frame", "arch", "data", "jaw_motion", "reference"]

FloatArray = NDArray[np.float64]

DATA = Path(__file__).parent / "data" / "anatomy.npz"


@lru_cache(maxsize=1)
def data() -> MappingProxyType[str, NDArray[Any]]:
    """The arrays of the shipped file, by name."""
    with np.load(DATA, allow_pickle=False) as file:
        return MappingProxyType({name: file[name] for name in file.files})


@lru_cache(maxsize=1)
def reference() -> Outline:
    """The outline of the head that was measured."""
    return Outline(**{name: Margins(*data()[name].astype(np.float64)) for name in OPENINGS})


@dataclass(frozen=True)
class Arch:
    """A row of teeth on the measured head, seen from above in polar coordinates.

    Attributes:
        angle: (K,) from straight ahead, positive to the subject's left, radians.
        outer, inner: (K,) distance of the two faces of the teeth from the axis, metres.
        edge: (K,) height of the biting edge, metres.
        gaps: angles between neighbouring teeth, ends included.
        axis_z: where the vertical axis stands.
    """

    angle: FloatArray
    outer: FloatArray
    inner: FloatArray
    edge: FloatArray
    gaps: FloatArray
    axis_z: float


def arch(name: str) -> Arch:
    """The ``"upper"`` or the ``"lower"`` arch."""
    angle, outer, inner, edge = data()[f"{name}_arch"].astype(np.float64)
    gaps = data()[f"{name}_gaps"].astype(np.float64)
    return Arch(angle, outer, inner, edge, gaps, float(data()["axis_z"]))


@dataclass(frozen=True)
class Frame:
    """A similarity that takes places on the measured head to places on a person's.

    ``person = centre + scale (measured - origin)``
    """

    origin: FloatArray
    centre: FloatArray
    scale: float

    @classmethod
    def between(cls, measured: Margins, person: Margins) -> Frame:
        """From the middle and the width of an opening here and there."""
        return cls(_middle(measured), _middle(person), _width(person) / _width(measured))

    def __call__(self, measured: FloatArray) -> FloatArray:
        """(..., 3) places on the person's head."""
        return self.centre + self.scale * (measured - self.origin)

    def back(self, person: FloatArray) -> FloatArray:
        """(..., 3) places on the measured head."""
        return self.origin + (person - self.centre) / self.scale

    def shifted(self, by: FloatArray) -> Frame:
        """The same frame with everything moved by (3,) metres."""
        return Frame(self.origin, self.centre + by, self.scale)


def jaw_motion(points: FloatArray, frame: Frame, weights: Mapping[str, float]) -> FloatArray:
    """(..., 3) displacement of points of the lower jaw: ``A x + t`` of each expression."""
    places = frame.back(points)
    moved = np.zeros_like(points)
    for name, affine in zip(data()["jaw_names"].tolist(), data()["jaw"], strict=True):
        weight = weights.get(name, 0.0)
        if weight:
            moved += weight * (places @ affine[:, :3].T + affine[:, 3])
    return frame.scale * moved


def _middle(margins: Margins) -> FloatArray:
    return np.concatenate(margins).mean(axis=0)


def _width(margins: Margins) -> float:
    ends = 0.5 * (margins.upper[[0, -1]] + margins.lower[[0, -1]])
    return float(np.linalg.norm(ends[1] - ends[0]))
