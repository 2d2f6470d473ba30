"""Waves: closed curves as cosines and sines in one list, as the grid evaluator wants them.

Arrays here are *planar*: x, y and z come first, each a matrix of its own.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import DTypeLike, NDArray

from pdeface.pde.fourier import analysis, synthesis

__all__ = ["Waves", "closed_waves", "mirrored_waves"]

FloatArray = NDArray[np.float64]


@dataclass(frozen=True)
class Waves:
    """The waves that make up closed curves of M points, ``per_harmonic`` for each harmonic.

    Attributes:
        count: M; the harmonics are 0 to M // 2.
        per_harmonic: 2, a cosine and a sine; or 1 where every curve is its own reflection in
            a plane z = const, for then x and y have cosines only and z - const has sines only
            (section 2.2).
        analysis: (1 or 3, waves, samples) weights of a curve's samples in each wave, in the
            order of harmonics, for x, y and z.
    """

    count: int
    per_harmonic: int
    analysis: FloatArray

    def synthesis(self, v: FloatArray, derivative: int = 0) -> FloatArray:
        """(1 or 3, waves, V) values of each wave, or of a derivative, at each v."""
        cosine, sine = synthesis(self.count, v, derivative).transpose(0, 2, 1)
        if self.per_harmonic == 2:
            return _alternating(cosine, sine)
        sine[0] = derivative == 0  # the const
        return np.stack([cosine, cosine, sine])

    def samples(self, points: NDArray[np.floating], dtype: DTypeLike) -> NDArray[np.floating]:
        """(3, curves, samples) what the analysis reads of (..., M, 3) data points."""
        read = points[..., : self.analysis.shape[-1], :]
        planar = read.transpose(-1, *range(read.ndim - 1)).astype(dtype, order="C")
        return planar.reshape(3, -1, planar.shape[-1])


def closed_waves(count: int) -> Waves:
    """The waves of any closed curve of ``count`` points."""
    return Waves(count, 2, _alternating(*analysis(count)))


def mirrored_waves(count: int) -> Waves:
    """The waves of a curve of ``count`` points, an even number, that is its own reflection.

    The first half of the points is read, and one more: halfway between points count / 2 - 1 and
    count / 2, which are each other's reflections, lies the plane.
    """
    half = count // 2
    weights = np.zeros((3, half + 1, half + 1))
    weights[:2, :, :half], weights[2, :, :half] = 2.0 * analysis(count)[:, :, :half]
    weights[2, :, -2:] -= 0.5 * weights[2].sum(axis=1, keepdims=True)  # z - const
    weights[2, 0, -2:] = 0.5
    return Waves(count, 1, weights)


def _alternating(cosine: FloatArray, sine: FloatArray) -> FloatArray:
    """Cosine 0, sine 0, cosine 1, sine 1, ... for all coordinates alike."""
    return np.stack([cosine, sine], axis=1).reshape(1, -1, cosine.shape[1])
