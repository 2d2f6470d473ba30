"""What the sum of a geometry's columns lacks where two controls meet.

A blink brings both lids to one line, wherever others have put them: those that move the lids, and
those that make another person of the face. What a sum of displacements lacks there is linear in the
blink and linear in each of the others, and adds up, to less than 0.1 mm.
"""

from __future__ import annotations

from itertools import combinations
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pdeface.controls import BLINKS, CONTROLS, Displacement
from pdeface.studio.geometry import Geometry

__all__ = ["meetings"]

FloatArray = NDArray[np.float64]

_SEEN = 2e-5
"""Metres that nobody misses."""


def meetings(geometry: Geometry) -> dict[str, NDArray[Any]]:
    """What the page adds to the sum of the columns.

    Returns:
        ``pairs`` (P, 2) of controls by number; ``shares`` (P, R) of each move that a pair makes,
        both at 1; ``vertices`` (n,) that are moved, and ``moves`` (R, n, 3) of them.
    """
    names, blinks = list(CONTROLS), list(BLINKS) if geometry.face.has_lids else []
    meeting = [(b, name) for b in blinks for name in names if name not in blinks]
    pairs, lacking = [], []
    for one, other in [*meeting, *combinations(blinks, 2)]:
        by = geometry.lacking({one: 1.0, other: 1.0})
        if max(np.abs(each).max() for each in by) > _SEEN:
            pairs.append((names.index(one), names.index(other)))
            lacking.append(by)
    shares, few = _of_few(lacking)
    values = [geometry.everywhere(by).astype(np.float32) for by in few]
    moves = np.array(values, np.float32).reshape(len(few), sum(geometry.counts[:-1]), 3)
    # By the largest share of each move: what no pair can bring about is left out.
    most = np.abs(shares).max(axis=0, initial=0.0)[:, None, None]
    vertices = np.flatnonzero((np.abs(moves) * most > _SEEN).any(axis=(0, 2)))
    return {
        "pairs": np.array(pairs, np.int32).reshape(-1, 2),
        "shares": shares.astype(np.float32),
        "vertices": vertices.astype(np.int32),
        "moves": moves[:, vertices],
    }


def _of_few(displacements: list[Displacement]) -> tuple[FloatArray, list[Displacement]]:
    """Displacements as sums of few: as many principal ones as leave nothing that is seen.

    Returns:
        (P, R) what each takes of each, and the R.
    """
    if not displacements:
        return np.zeros((0, 0)), []
    shapes = [part.shape for part in displacements[0]]
    ends = np.cumsum([int(np.prod(shape)) for shape in shapes])
    flat = np.array([np.concatenate([part.ravel() for part in by]) for by in displacements])
    left, sizes, right = np.linalg.svd(flat, full_matrices=False)
    shares = left * sizes
    rest, rank = flat.copy(), 0
    while np.abs(rest).max() > _SEEN and rank < len(sizes):
        rest -= np.outer(shares[:, rank], right[rank])
        rank += 1
    few = [
        Displacement(*(part.reshape(shape) for part, shape in zip(
            np.split(row, ends[:-1]), shapes, strict=True)))
        for row in right[:rank]
    ]  # fmt: skip
    return shares[:, :rank], few
