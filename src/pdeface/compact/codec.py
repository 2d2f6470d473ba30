"""Boundary curves in a few hundred bytes: what makes a person different, and no more of it.

The curves are predicted by the neutral face and its identity modes, whose weights are part of the
code; what is left is transformed to waves, rounded to a step that meets the error asked for, and
coded by an adaptive arithmetic coder in the contexts of what was coded before.
"""

from __future__ import annotations

from bisect import bisect
from collections.abc import Iterator
from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from pdeface.compact.coder import Decoder, Encoder
from pdeface.compact.waves import forward, inverse
from pdeface.controls import CONTROLS, displacement
from pdeface.curves import BoundaryCurves, curve_parameters
from pdeface.errors import FileFormatError
from pdeface.pde import GridEvaluator
from pdeface.template import neutral_curves
from pdeface.template.layout import LEVELS

__all__ = ["Predicted", "decode", "encode", "predicted"]

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]

_WEIGHT_STEP = 0.1
"""Standard deviations: a finer step of an identity weight costs more than it saves."""

_STIFFNESS = 2e-5
"""Metres for which an identity mode is as dear as the residual that it saves."""

DEADZONE = 0.4
"""What is added before rounding down: below one half zeros are favoured, which cost least."""

_RINGS = (0.12, 0.4)
_MOST = 1 << 40


class Predicted(NamedTuple):
    """Curves as the neutral face, identity modes and what is left.

    Attributes:
        weights: (50,) of the identity modes, in tenths of a standard deviation, rounded.
        waves: (K, M/2, 3) of what is left, metres.
    """

    weights: IntArray
    waves: FloatArray

    def levels(self, step: float) -> IntArray:
        """(K, M/2, 3) the waves in steps of so many metres, rounded."""
        size = np.floor(np.abs(self.waves) / step + DEADZONE)
        return np.asarray(np.copysign(size, self.waves).astype(np.int64))

    def error(self, step: float) -> float:
        """Root mean square distance of points that are rounded so, metres.

        The waves are orthonormal: their errors are those of the points.
        """
        off = self.waves - step * self.levels(step)
        return float(np.sqrt((off**2).sum() / (off.size / 3.0)))


def predicted(curves: BoundaryCurves) -> Predicted:
    """The prediction of curves that are closed by reflection, by ridge regression."""
    own = curves.half - _base(curves.shape)
    own[..., 2] -= curves.mirror_z - _mirror_z()
    modes = _modes(curves.shape)
    flat = modes.reshape(len(modes), -1)
    stiff = (_STIFFNESS**2 * flat.shape[1] / 3.0) * np.eye(len(modes))
    weights = np.linalg.solve(flat @ flat.T + stiff, flat @ own.ravel())
    whole = np.rint(weights / _WEIGHT_STEP).astype(np.int64)
    return Predicted(whole, forward(own - np.tensordot(whole * _WEIGHT_STEP, modes, 1)))


def encode(curves: Predicted, step: float) -> bytes:
    """The code of curves whose waves are rounded to a step, metres."""
    encoder = Encoder()
    for index, value in enumerate(curves.weights.tolist()):
        encoder.number(value, ("weight", index // 10))
    levels = curves.levels(step)
    for at, context in _walk(levels):
        encoder.number(int(levels[at]), context)
    return encoder.finish()


def decode(data: bytes, size: tuple[int, int], mirror_z: float, step: float) -> BoundaryCurves:
    """The curves in a code.

    Args:
        data: from :func:`encode`.
        size: (K, M) of the curves.
        mirror_z, step: as they were there.

    Raises:
        FileFormatError: the bytes are no such code.
    """
    decoder = Decoder(data)
    count = len(_modes(size))
    whole = np.array([decoder.number(("weight", index // 10)) for index in range(count)])
    levels = np.zeros((size[0], size[1] // 2, 3), np.int64)
    for at, context in _walk(levels):
        value = decoder.number(context)
        if abs(value) > _MOST:
            raise FileFormatError("the curves of a compact face are damaged; make it again")
        levels[at] = value
    return _curves(size, mirror_z, whole, levels, step)


def _curves(
    size: tuple[int, int], mirror_z: float, whole: IntArray, levels: IntArray, step: float
) -> BoundaryCurves:
    half = _base(size) + np.tensordot(whole * _WEIGHT_STEP, _modes(size), 1)
    half += inverse(step * levels.astype(np.float64))
    half[..., 2] += mirror_z - _mirror_z()
    return BoundaryCurves.from_half(half, mirror_z)


def _walk(levels: IntArray) -> Iterator[tuple[tuple[int, int, int], tuple[int, int]]]:
    """Places of the waves from the slowest to the fastest, each with its context.

    The context is how slow the wave is, and how large those beside it are that came before: a
    decoder, which fills the levels in as it goes, knows both.
    """
    rows, columns, _ = levels.shape
    size = _Sizes(levels)
    for place, i, j in _order(rows, columns):
        ring = bisect(_RINGS, place)
        for c in range(3):
            yield (i, j, c), (ring, size.beside(i, j, c))
            size.note(i, j, c)


@lru_cache(maxsize=8)
def _order(rows: int, columns: int) -> list[tuple[float, int, int]]:
    return sorted((i / rows + j / columns, i, j) for i in range(rows) for j in range(columns))


class _Sizes:
    """Magnitudes of the levels that were coded, with a border of two that are 0."""

    def __init__(self, levels: IntArray) -> None:
        self._levels = levels
        rows, columns, _ = levels.shape
        self._size = [[[0, 0, 0] for _ in range(columns + 2)] for _ in range(rows + 2)]

    def note(self, i: int, j: int, c: int) -> None:
        self._size[i + 2][j + 2][c] = abs(int(self._levels[i, j, c]))

    def beside(self, i: int, j: int, c: int) -> int:
        """The weighted sum of those beside, as one of a few classes."""
        above, here = self._size[i + 1], self._size[i + 2]
        total = 2 * above[j + 2][c] + 2 * here[j + 1][c] + above[j + 1][c]
        total += self._size[i][j + 2][c] + here[j][c] + sum(here[j + 2][:c])
        return total if total < 4 else total.bit_length() + 1


@lru_cache(maxsize=8)
def _base(size: tuple[int, int]) -> FloatArray:
    """(K, M/2, 3) front halves of the neutral face's curves at any level."""
    name = f"{size[0]}x{size[1]}"
    if name in LEVELS:
        return neutral_curves(name).half
    u, v = np.linspace(0.0, 1.0, size[0]), curve_parameters(size[1])[: size[1] // 2]
    points = neutral_curves("109x184").points
    return np.asarray(GridEvaluator(points.shape[:2], u, v).positions(points))


def _mirror_z() -> float:
    return neutral_curves().mirror_z


@lru_cache(maxsize=8)
def _modes(size: tuple[int, int]) -> FloatArray:
    """(modes, K, M/2, 3) displacement of the front halves by each identity mode."""
    names = [name for name, control in CONTROLS.items() if control.kind == "identity"]
    return np.array([displacement({name: 1.0}, size).smooth[:, : size[1] // 2] for name in names])
