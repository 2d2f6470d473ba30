"""Displacements of the curves that were measured: expressions and identity modes.

The numbers in ``data/measured.npz`` were measured by ``python -m pdeface.controls.build`` on the
expressions and identity modes of ICT-FaceKit (MIT, Copyright (c) 2020 USC Institute for Creative
Technologies; see NOTICE).
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import lru_cache
from pathlib import Path
from types import MappingProxyType
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from pdeface.curves import curve_parameters, mirror_points
from pdeface.errors import InputError
from pdeface.openings import SAMPLES
from pdeface.pde import Continuity, GridEvaluator
from pdeface.template.layout import OPENING_ROWS, PAPER_ROWS, ROWS

__all__ = [
    "DATA",
    "IDENTITIES",
    "LEVEL",
    "STILL",
    "Displacement",
    "expressions",
    "has_lids",
    "identities",
    "slits",
]

FloatArray = NDArray[np.float64]

DATA = Path(__file__).parent / "data" / "measured.npz"
LEVEL = (55, 92)
"""Curves and points at which expressions were measured."""

IDENTITIES = 50
"""Identity modes kept of 100: they hold 98 per cent of the variance of the heads."""


STILL = np.zeros((len(OPENING_ROWS), 2, SAMPLES, 3))
"""Margins that nothing moves."""
STILL.setflags(write=False)


class Displacement(NamedTuple):
    """A displacement of a face, metres, in three parts that are added.

    Attributes:
        smooth: (K, M, 3) of the curves: what the surface follows without a break.
        parting: (K, M, 3) of the curves: what parts lids and lips; its surface is slit there.
        margins: (openings, 2, samples, 3) of the margins of openings, where a face has them: what
            its curves cannot follow (:mod:`pdeface.margins`).
    """

    smooth: FloatArray
    parting: FloatArray
    margins: FloatArray = STILL

    def less(self, other: Displacement) -> Displacement:
        """The difference of two."""
        return Displacement(*(mine - theirs for mine, theirs in zip(self, other, strict=True)))


def slits(curves: int) -> dict[int, Continuity]:
    """The curves at which a face of so many curves may part: between the lids and the lips.

    Raises:
        InputError: no curve lies on the lid margins and the mouth seam.
    """
    step = (curves - 1) // (PAPER_ROWS - 1)
    if not has_lids(curves):
        raise InputError(
            f"a face that moves needs 27 n + 1 curves (28, 55, 109, ...), got {curves}; "
            "fit it at such a level"
        )
    eye = range(step * ROWS["upper_lid_margin"], step * ROWS["lower_lid_margin"])
    mouth = range(step * ROWS["mouth_seam_upper"], step * ROWS["mouth_seam_lower"])
    return dict.fromkeys((*eye, *mouth), "slit")


def has_lids(curves: int) -> bool:
    """Whether curves lie on the lid margins and the mouth seam of a face of so many."""
    return curves > 1 and (curves - 1) % (PAPER_ROWS - 1) == 0


@lru_cache(maxsize=1)
def _data() -> MappingProxyType[str, NDArray[Any]]:
    with np.load(DATA, allow_pickle=False) as file:
        return MappingProxyType({name: file[name] for name in file.files})


def expressions(weights: Mapping[str, float], size: tuple[int, int]) -> Displacement:
    """Displacement of K curves of M points by measured expressions together.

    Args:
        weights: values by name as measured, such as ``"eyeBlink_L"``.
        size: (K, M); K = 27 n + 1.

    Raises:
        InputError: no curve of that level lies on the lids and lips.
    """
    slits(size[0])
    names = _data()["names"].tolist()
    by_index = tuple((names.index(name), float(weight)) for name, weight in weights.items())
    return Displacement(
        _at_level("smooth", by_index, size, {}),
        _at_level("parting", by_index, size, slits(LEVEL[0])),
    )


def identities(weights: Mapping[int, float], size: tuple[int, int]) -> FloatArray:
    """(K, M, 3) displacement by identity modes, counted from 0, in standard deviations."""
    return _at_level("identity", tuple(weights.items()), size, {})


def _at_level(
    part: str,
    weights: tuple[tuple[int, float], ...],
    size: tuple[int, int],
    continuity: dict[int, Continuity],
) -> FloatArray:
    """(K, M, 3) sum of measured displacements, read off its own surface."""
    scale, stored = _data()[f"{part}_scale"], _data()[part]
    half = np.zeros(stored.shape[1:])
    for index, weight in weights:
        half += (weight * scale[index]) * stored[index]
    points = mirror_points(half)
    if points.shape[:2] != size and half.any():
        u, v = np.linspace(0.0, 1.0, size[0]), curve_parameters(size[1])
        evaluator = _evaluator(points.shape[:2], tuple(u), tuple(v), tuple(continuity))
        points = np.ascontiguousarray(evaluator.positions(points))
    elif points.shape[:2] != size:
        points = np.zeros((*size, 3))
    points.setflags(write=False)
    return points


@lru_cache(maxsize=16)
def _evaluator(
    shape: tuple[int, int], u: tuple[float, ...], v: tuple[float, ...], slit: tuple[int, ...]
) -> GridEvaluator:
    return GridEvaluator(shape, u, v, continuity=dict.fromkeys(slit, "slit"))
