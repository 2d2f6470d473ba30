"""Weights of the data points at scattered places: the surface there as one small matrix."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pdeface.pde.fourier import analysis, synthesis, wave_numbers
from pdeface.pde.joins import Continuity, Join, slopes
from pdeface.pde.rows import Side, locate, row_weights

__all__ = ["point_weights"]

FloatArray = NDArray[np.float64]


def point_weights(
    shape: tuple[int, int],
    u: Any,
    v: Any,
    du: int = 0,
    dv: int = 0,
    *,
    a: float = 1.0,
    modes: int = 6,
    join: Join = "smooth",
    continuity: Mapping[int, Continuity] | None = None,
    side: Side = "after",
) -> FloatArray:
    """(n, K M) weights of the data points in S, or a derivative of it, at n places (u, v).

    ``weights @ points.reshape(K * M, 3)`` is what :meth:`pdeface.pde.PDESurface.derivative` gives;
    a matrix pays where few places are wanted for many faces.

    Args:
        shape: (K, M) of the curves.
        u: (n,) values in [0, 1].
        v: (n,) radians.
        du, dv: orders of the derivative.
        a, modes, join, continuity, side: as for :class:`pdeface.pde.PDESurface`.
    """
    curves, count = shape
    v = np.atleast_1d(np.asarray(v, dtype=np.float64))
    rows = locate(np.atleast_1d(u), curves, side, continuity)
    w_of_mode = wave_numbers(count, a, modes)
    # Indices: cosine or sine; place; mode. And: cosine or sine; mode; point.
    waves, of_points = synthesis(count, v, dv), analysis(count)
    result = np.zeros((len(v), curves, count))
    for w in np.unique(w_of_mode):
        group = w_of_mode == w
        along_u = row_weights(rows, float(w), slopes(float(w), curves, join, continuity), du)
        along_v = (waves[:, :, group] @ of_points[:, group]).sum(axis=0)
        result += along_u[:, :, None] * along_v[:, None, :]
    return result.reshape(len(v), -1)
