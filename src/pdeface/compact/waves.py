"""Curves as sums of waves: the cosine and sine transforms that their symmetry makes exact.

Points lie at v_j = (j + 1/2) 2 pi / M. Under the reflection v -> 2 pi - v the coordinates x and y
are even and z - mirror_z is odd, so that half a curve holds it all: cosines of v for x and y, sines
for z. Over the curves, which do not close, cosines of u. Both transforms are orthonormal: an error
in the coefficients is the same error in the points.
"""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

__all__ = ["forward", "inverse"]

FloatArray = NDArray[np.float64]


def forward(half: FloatArray) -> FloatArray:
    """(K, M/2, 3) coefficients of (K, M/2, 3) displacements of the front halves of curves."""
    rows, (even, odd) = _cosines(half.shape[0]), _over_v(half.shape[1])
    across = np.stack([half[..., c] @ (odd if c == 2 else even).T for c in range(3)], axis=-1)
    return np.asarray(np.einsum("ik,kjc->ijc", rows, across))


def inverse(coefficients: FloatArray) -> FloatArray:
    """What :func:`forward` came from."""
    rows, (even, odd) = _cosines(coefficients.shape[0]), _over_v(coefficients.shape[1])
    down = np.einsum("ik,ijc->kjc", rows, coefficients)
    return np.stack([down[..., c] @ (odd if c == 2 else even) for c in range(3)], axis=-1)


def _over_v(count: int) -> tuple[FloatArray, FloatArray]:
    return _cosines(count), _sines(count)


@lru_cache(maxsize=32)
def _cosines(count: int) -> FloatArray:
    """(n, n) orthonormal cosines at half samples (DCT-II), one a row."""
    wave, place = np.arange(count), np.arange(count) + 0.5
    matrix = np.cos(np.pi / count * wave[:, None] * place) * np.sqrt(2.0 / count)
    matrix[0] *= np.sqrt(0.5)
    return np.asarray(matrix)


@lru_cache(maxsize=32)
def _sines(count: int) -> FloatArray:
    """(n, n) orthonormal sines at half samples (DST-II), one a row."""
    wave, place = np.arange(1, count + 1), np.arange(count) + 0.5
    matrix = np.sin(np.pi / count * wave[:, None] * place) * np.sqrt(2.0 / count)
    matrix[-1] *= np.sqrt(0.5)
    return np.asarray(matrix)
