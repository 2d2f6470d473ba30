"""Curves whose surface comes nearest to given samples, by linear least squares.

The surface is linear in the curve points and separates into Fourier modes along v and weights along
u. Samples on a uniform grid keep the modes apart, so that the fit is one small K x K problem for
each mode, whatever the level of detail.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pdeface.errors import InputError
from pdeface.pde.fourier import analysis, synthesis, wave_numbers
from pdeface.pde.joins import Continuity
from pdeface.pde.rows import u_weights

__all__ = ["fit_curves"]

FloatArray = NDArray[np.float64]

EDGE_WEIGHT = 20.0
# Damping of the modes grows with this power of their number, so that only the highest feel it:
# a sharp feature would ring in them.
DAMPING_POWER = 6


def fit_curves(
    samples: Any,
    shape: tuple[int, int],
    *,
    a: float = 1.0,
    modes: int = 6,
    fairness: float = 5e-3,
    damping: float = 1.0,
    continuity: Mapping[int, Continuity] | None = None,
    edge_weight: float = EDGE_WEIGHT,
) -> FloatArray:
    """Data points of the closed curves whose smooth surface is nearest to samples.

    Minimises the mean squared distance to the samples plus ``fairness`` times the squared second
    differences of the curves across u, plus ``damping`` times the squared amplitude of mode n
    times ``(n / n_max)^6``.

    Args:
        samples: (U, S, 3) positions on closed curves: row i at ``u = i / (U - 1)``, sample j at
            ``v = (j + 1/2) 2 pi / S``.
        shape: (K, M), curves and points on each; K <= U and M <= S.
        a, modes: as for :class:`pdeface.pde.PDESurface`.
        fairness: weight of the bending of the curves, per sample.
        damping: weight of the highest mode, per sample.
        continuity: inner curves that are a crease or a slit, across which nothing is fair.
        edge_weight: how much each sample of the two end rows counts; they are the surface's edge.

    Returns:
        (K, M, 3) data points.

    Raises:
        InputError: fewer samples than data points.
    """
    samples = np.asarray(samples, dtype=np.float64)
    rows, around = samples.shape[:2]
    count, points = shape
    if rows < count or around < points:
        raise InputError(
            f"to fit {count} x {points} data points at least as many samples are needed, "
            f"got {rows} x {around}; sample more densely or ask for a coarser level"
        )
    waves = analysis(around)[:, : points // 2 + 1]
    amplitudes = np.einsum("cnm,umx->cunx", waves, samples)
    fitted = np.zeros((2, count, amplitudes.shape[2], 3))
    row_weight = np.ones((rows, 1))
    row_weight[[0, -1]] = edge_weight
    bending = _second_differences(count, continuity or {})
    w_of_mode = wave_numbers(points, a, modes)
    for w in np.unique(w_of_mode):
        across = u_weights(np.linspace(0.0, 1.0, rows), w, count, continuity=continuity)
        normal = across.T @ (row_weight * across) + fairness * rows / count * bending.T @ bending
        # Modes of one w differ in a multiple of the identity alone: one decomposition for them all.
        values, vectors = np.linalg.eigh(normal)
        those = np.flatnonzero(w_of_mode == w)
        high = damping * rows / count * (those / (points / 2)) ** DAMPING_POWER
        right = np.einsum("uk,cumx->kmcx", row_weight * across, amplitudes[:, :, those])
        turned = (vectors.T @ right.reshape(count, -1)).reshape(count, len(those), 6)
        turned /= (values[:, None] + high)[..., None]
        solution = (vectors @ turned.reshape(count, -1)).reshape(count, len(those), 2, 3)
        fitted[:, :, those] = solution.transpose(2, 0, 1, 3)
    v = (np.arange(points) + 0.5) * (2.0 * np.pi / points)
    return np.asarray(np.einsum("cmn,cknx->kmx", synthesis(points, v), fitted))


def _second_differences(count: int, continuity: Mapping[int, Continuity]) -> FloatArray:
    """(differences, K) of neighbouring curves, none across a break."""
    breaks = {curve for curve, kind in continuity.items() if kind != "C2"}
    breaks |= {curve + 1 for curve, kind in continuity.items() if kind == "slit"}
    whole = [k for k in range(count - 2) if k + 1 not in breaks]
    return np.diff(np.eye(count), 2, axis=0)[whole]
