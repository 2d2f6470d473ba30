"""Handles of the boundary curves, and how far they are moved."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pdeface.curves import mirror_points
from pdeface.errors import InputError
from pdeface.face import Face

__all__ = ["front_moves", "with_moves"]

FloatArray = NDArray[np.float64]


def front_moves(moves: Any, shape: tuple[int, int]) -> FloatArray:
    """(K, M / 2, 3) displacement of the front halves of K curves of M points, metres.

    Args:
        moves: (curve, point, x, y, z) each, as the page sends them.
        shape: (K, M).

    Raises:
        InputError: no such place, or no such numbers.
    """
    by = np.zeros((shape[0], shape[1] // 2, 3))
    if not isinstance(moves, Sequence) or not all(
        isinstance(move, Sequence) and len(move) == 5 for move in moves
    ):
        raise InputError("moves are a list of (curve, point, x, y, z); reload the page")
    for curve, point, *vector in moves:
        if not (_is_index(curve, shape[0]) and _is_index(point, shape[1] // 2)):
            raise InputError(
                f"a handle has a curve of 0 to {shape[0] - 1} and a point of 0 to "
                f"{shape[1] // 2 - 1}, got {curve!r} and {point!r}; choose one of these"
            )
        by[curve, point] += _vector(vector)
    if not np.isfinite(by).all() or np.abs(by).max(initial=0.0) > 1.0:
        raise InputError("a handle moves by a metre at most, got more; move it less")
    return by


def with_moves(face: Face, moves: Any) -> Face:
    """The face with handles of its curves moved, and the back of the curves with them.

    Raises:
        InputError: as for :func:`front_moves`.
    """
    by = front_moves(moves, face.curves.shape)
    return face.with_curves(face.curves.displaced(mirror_points(by)))


def _is_index(value: Any, size: int) -> bool:
    return isinstance(value, int) and not isinstance(value, bool) and 0 <= value < size


def _vector(values: Sequence[Any]) -> FloatArray:
    if not all(isinstance(v, int | float) and not isinstance(v, bool) for v in values):
        raise InputError(f"a move is three numbers, got {values!r}; reload the page")
    return np.array(values, dtype=np.float64)
