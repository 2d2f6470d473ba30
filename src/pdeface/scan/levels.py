"""Samples of a face, by as many curves as are asked for."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from pdeface.curves import BoundaryCurves, mirror_points
from pdeface.errors import InputError
from pdeface.pde import GridEvaluator
from pdeface.pde.fit import fit_curves
from pdeface.template import neutral_curves
from pdeface.template.layout import PAPER_ROWS

__all__ = ["check_level", "fit_level"]

FloatArray = NDArray[np.float64]

_MOST = 217, 368
"""Curves and points that the samples of a scan can tell apart."""

_ALONG, _ROUNDS, _FEW = 0.3, 2, 55
"""What a distance along the surface counts, beside one along its normal; how often the fit is
repeated for that (more often rows slide off their features); and the curves from which on it
changes nothing."""


def fit_level(samples: FloatArray, level: tuple[int, int]) -> BoundaryCurves:
    """Curves of a level whose surface is nearest to (U, V, 3) samples of a face on its grid.

    A sample's distance along the surface says little of the shape: few curves come nearer to the
    shape when it counts less. With the samples moved by a part of it the fit is linear as before,
    and is repeated: a fixed-point iteration for ``A' P A x = A' P s``, where A makes samples of
    curves x, s are the samples, and ``P = n n' + 0.3 (1 - n n')``.

    Raises:
        InputError: a level that there is not.
    """
    check_level(level)
    curves = _fitted(samples, level)
    u = np.linspace(0.0, 1.0, samples.shape[0])
    v = (np.arange(samples.shape[1]) + 0.5) * (np.pi / samples.shape[1])
    grid = GridEvaluator(level, u, v)
    for _ in range(_ROUNDS if level[0] < _FEW else 0):
        points, normals = grid.positions_and_normals(curves.points)
        off = samples - points
        off *= _ALONG
        off += (1.0 - _ALONG) * ((samples - points) * normals).sum(-1, keepdims=True) * normals
        curves = _fitted(points + off, level)
    return curves


def _fitted(samples: FloatArray, level: tuple[int, int]) -> BoundaryCurves:
    """The curves nearest to samples in all directions."""
    mirror_z = neutral_curves().mirror_z
    fairness, damping = _stiffness(level[0])
    closed = mirror_points(samples, mirror_z)
    points = fit_curves(closed, level, fairness=fairness, damping=damping)
    return BoundaryCurves.from_half(points[:, : level[1] // 2], mirror_z)


def check_level(level: tuple[int, int]) -> None:
    """Refuse levels at which no curves lie on lids and lips, or that are finer than the samples.

    Raises:
        InputError: such a level.
    """
    curves, points = level
    if curves < PAPER_ROWS or (curves - 1) % (PAPER_ROWS - 1) or curves > _MOST[0]:
        raise InputError(
            f"a level has 27 n + 1 curves, 28 to {_MOST[0]}, got {curves}; try 28x46, 55x92 or "
            "109x184"
        )
    if points % 2 or not 16 <= points <= _MOST[1]:
        raise InputError(
            f"curves have an even number of points, 16 to {_MOST[1]}, got {points}; try 28x46, "
            "55x92 or 109x184"
        )


def _stiffness(curves: int) -> tuple[float, float]:
    """Fairness and damping, and between the levels for which they were tried."""
    known = np.log([28.0, 55.0, 109.0])
    fairness = np.exp(np.interp(np.log(curves), known, np.log([1e-2, 5e-3, 5e-3])))
    damping = np.exp(np.interp(np.log(curves), known, np.log([0.5, 1.0, 4.0])))
    return float(fairness), float(damping)
