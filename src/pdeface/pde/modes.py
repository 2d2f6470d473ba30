"""Modes: from the samples of the curves to the value of every wave on every row."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import DTypeLike, NDArray

from pdeface.pde.fourier import wave_numbers
from pdeface.pde.joins import Continuity, Join, slopes
from pdeface.pde.rows import Rows, row_weights
from pdeface.pde.waves import Waves

__all__ = ["ModeProducts"]

Array = NDArray[np.floating]


class ModeProducts:
    """Two small matrix products a face: along every curve, then across the curves.

    Args:
        shape: (K, M) of the curves.
        waves: of the curves.
        rows: where the modes are wanted, R rows.
        a, modes, join: as for :class:`pdeface.pde.PDESurface`.
        layers: the continuity of each surface that is summed.
        dtype: precision of the products.
    """

    def __init__(
        self,
        shape: tuple[int, int],
        waves: Waves,
        rows: Rows,
        a: float,
        modes: int,
        join: Join,
        layers: Sequence[Mapping[int, Continuity]],
        dtype: DTypeLike,
    ) -> None:
        self._analysis = waves.analysis.astype(dtype)

        def across(w: float, derivative: int) -> Array:
            """(curves of all layers, R): the layers are summed by the same product."""
            of_layer = [slopes(w, shape[0], join, continuity) for continuity in layers]
            return np.concatenate([row_weights(rows, w, of, derivative).T for of in of_layer])

        of_w = np.unique(wave_numbers(shape[1], a, modes)).tolist()
        weights = np.array([[across(w, d) for w in of_w] for d in (0, 1)], dtype=dtype)
        # One matrix for each harmonic solved on its own, and one for all of the remainder.
        self._each, self._remainder = weights[:, : modes + 1], weights[:, modes + 1 :]
        self._split = waves.per_harmonic * self._each.shape[1]

    def coefficients(self, samples: Array) -> Array:
        """(waves, 3, faces L K) Fourier coefficients of (3, faces L K, samples), L layers."""
        result = np.empty((self._analysis.shape[1], *samples.shape[:2]), samples.dtype)
        np.matmul(self._analysis, samples.swapaxes(1, 2), out=result.transpose(1, 0, 2))
        return result

    def on_rows(self, coefficients: Array, derivative: int = 0) -> Array:
        """(3, faces R, waves) value of each wave, or its u-derivative, on each row."""
        harmonics, curves, rows = self._each.shape[1:]
        waves = len(coefficients)
        result = np.empty((waves, coefficients[0].size // curves, rows), coefficients.dtype)
        np.matmul(
            coefficients[: self._split].reshape(harmonics, -1, curves),
            self._each[derivative],
            out=result[: self._split].reshape(harmonics, -1, rows),
        )
        if self._split < waves:
            np.matmul(
                coefficients[self._split :].reshape(-1, curves),
                self._remainder[derivative, 0],
                out=result[self._split :].reshape(-1, rows),
            )
        return result.reshape(waves, 3, -1).transpose(1, 2, 0)
