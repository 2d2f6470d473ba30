"""Expressions together: what simple addition would leave open or push through.

Lids: when a blink is at b, what all else leaves between the lids is at 1 - b of its size, so that a
full blink closes the eye of anyone, however wide or narrowed it is and wherever it looks. Alone
on a face a blink is linear in b; with others it is linear in each of them.

Lips: their two sides may part but not cross. Each expression alone keeps to that, and so does a sum
of them: gaps add. ``mouthClose`` closes what ``jawOpen`` opens, and no more.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from pdeface.controls import measured
from pdeface.controls.arkit import SOURCES
from pdeface.controls.measured import Displacement
from pdeface.controls.seams import nearest, seam

__all__ = ["COMPANY", "expressed"]

FloatArray = NDArray[np.float64]

COMPANY: Mapping[str, Mapping[str, float]] = {"mouthClose": {"jawOpen": 1.0}}
"""Expressions that say something only together with others: a mouth is closed that is open."""

_BLINKS = {"eyeBlinkRight": "right_eye", "eyeBlinkLeft": "left_eye"}


def expressed(
    rest: FloatArray, weights: Mapping[str, float], a: float = 1.0, modes: int = 6
) -> Displacement:
    """Displacement of a person's curves by expressions together.

    Args:
        rest: (K, M, 3) data points of the person without expression.
        weights: values by ARKit's names.
        a, modes: as for :class:`pdeface.pde.PDESurface`.

    Raises:
        InputError: a K for which no curve lies on the lids and lips.
    """
    size = rest.shape[0], rest.shape[1]
    weights = _effective(weights)
    if not weights:
        return Displacement(np.zeros(rest.shape), np.zeros(rest.shape))
    moved = measured.expressions(_sources(weights), size)
    parting = moved.parting.copy()
    for name, weight in weights.items():
        parting += weight * _kept_apart(name, size, a, modes)
    for blink, eye in _BLINKS.items():
        if blink in weights:
            others = {name: weight for name, weight in weights.items() if name != blink}
            parting += _closed(rest, weights[blink], blink, others, eye, a, modes)
    return Displacement(moved.smooth, parting)


def _effective(weights: Mapping[str, float]) -> dict[str, float]:
    """The weights that are not 0, none of which closes a mouth further than it is open."""
    effective = dict(weights)
    if "mouthClose" in weights:
        effective["mouthClose"] = min(weights["mouthClose"], weights.get("jawOpen", 0.0))
    return {name: weight for name, weight in effective.items() if weight}


def _sources(weights: Mapping[str, float]) -> dict[str, float]:
    return {source: weight for name, weight in weights.items() for source in SOURCES[name]}


def _closed(
    rest: FloatArray,
    weight: float,
    blink: str,
    others: Mapping[str, float],
    eye: str,
    a: float,
    modes: int,
) -> FloatArray:
    """What a blink lacks: the upper lid brought to the lower, wherever others have put the two."""
    size = rest.shape[0], rest.shape[1]
    lids = seam(eye, size, a, modes)
    by_others = measured.expressions(_sources(others), size)
    by_blink = measured.expressions(_sources({blink: 1.0}), size)
    shut = by_others.smooth + by_blink.smooth, by_others.parting + by_blink.parting
    upper, lower = lids.lines(rest + shut[0], shut[1])
    return lids.moved(weight * (nearest(lower, upper) - upper), share=1.0)


@lru_cache(maxsize=1024)
def _kept_apart(name: str, size: tuple[int, int], a: float, modes: int) -> FloatArray:
    """What keeps the lips of one expression from crossing: half of the way given to each."""
    lips = seam("mouth", size, a, modes)
    moved = measured.expressions(_sources({**COMPANY.get(name, {}), name: 1.0}), size)
    crossed = lips.gap(moved.smooth, moved.parting)[:, 1].clip(max=0.0)
    apart = lips.moved(np.multiply.outer(-crossed, [0.0, 1.0, 0.0]), share=0.5)
    apart.setflags(write=False)
    return apart
