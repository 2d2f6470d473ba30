"""Expressions together: what simple addition would leave open or push through.

Lids: when a blink is at b, what all else leaves between the lids is at 1 - b of its size, so that a
full blink closes the eye of anyone, however wide or narrowed it is and wherever it looks. What the
curves cannot follow of that, the margins do by themselves. Alone on a face a blink is linear in b;
with others it is linear in each of them.

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
from pdeface.controls.measured import STILL, Displacement
from pdeface.controls.seams import seam
from pdeface.template.layout import OPENING_ROWS

__all__ = ["BLINKS", "COMPANY", "expressed", "together"]

FloatArray = NDArray[np.float64]

COMPANY: Mapping[str, Mapping[str, float]] = {"mouthClose": {"jawOpen": 1.0}}
"""Expressions that say something only together with others: a mouth is closed that is open."""

_OF_LIDS = ("eyeWide", "eyeLookUp", "eyeLookDown", "eyeLookIn", "eyeLookOut")

BLINKS: Mapping[str, tuple[str, ...]] = {
    f"eyeBlink{side}": tuple(each + side for each in _OF_LIDS) for side in ("Right", "Left")
}
"""By each blink the expressions of whose opening and lowering of its lid it leaves the rest."""

_OPENINGS = tuple(OPENING_ROWS)
_EYES = {"eyeBlinkRight": "right_eye", "eyeBlinkLeft": "left_eye"}


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
    moved = measured.expressions(_sources(_lidded(weights)), size)
    closed = {name: _closed(rest, weights, name, a, modes) for name in _EYES if name in weights}
    added, margins = np.zeros_like(rest), STILL.copy()
    for name, weight in weights.items():
        by_curves, left = _kept_apart(name, size, a, modes)
        added += weight * by_curves
        margins[_OPENINGS.index("mouth")] += weight * left
    for name, (_, by_curves) in closed.items():
        added += weights[name] * by_curves
    for name, (wanted, by_curves) in closed.items():
        weight, eye = weights[name], _EYES[name]
        # A blink undoes what others' corrections do to its lids by the way.
        by_others = added - weight * by_curves
        done = seam(eye, size, a, modes).lines(np.zeros_like(rest), by_curves + by_others)
        margins[_OPENINGS.index(eye)] = weight * (wanted - done)
    return Displacement(moved.smooth, moved.parting + added, margins)


def together(weights: Mapping[str, float]) -> dict[str, float]:
    """What is left of weights in each other's company: they move the face as these would alone,
    but for what lids lack that meet."""
    return _lidded(_effective(weights))


def _effective(weights: Mapping[str, float]) -> dict[str, float]:
    """The weights that are not 0, none of which closes a mouth further than it is open."""
    effective = dict(weights)
    if "mouthClose" in weights:
        effective["mouthClose"] = min(weights["mouthClose"], weights.get("jawOpen", 0.0))
    return {name: weight for name, weight in effective.items() if weight}


def _lidded(weights: Mapping[str, float]) -> dict[str, float]:
    """The weights, of what opens and lowers a lid no more than a blink leaves of its opening."""
    left = dict(weights)
    for blink, others in BLINKS.items():
        for name in others:
            if name in left:
                left[name] *= 1.0 - weights.get(blink, 0.0)
    return left


def _closed(
    rest: FloatArray, weights: Mapping[str, float], blink: str, a: float, modes: int
) -> tuple[FloatArray, FloatArray]:
    """What a full blink lacks, wherever others have put the lids: both brought to one line.

    Returns:
        (2, n, 3) displacement of the two margins; (K, M, 3) parting displacement of the curves,
        which brings them nearly there.
    """
    size = rest.shape[0], rest.shape[1]
    lids = seam(_EYES[blink], size, a, modes)
    moved = measured.expressions(_sources(_lidded({**weights, blink: 1.0})), size)
    shut = np.array(lids.lines(rest + moved.smooth, moved.parting))
    wanted = lids.meeting(shut[1]) - shut
    return wanted, lids.moved(*wanted)


def _sources(weights: Mapping[str, float]) -> dict[str, float]:
    return {source: weight for name, weight in weights.items() for source in SOURCES[name]}


@lru_cache(maxsize=1024)
def _kept_apart(
    name: str, size: tuple[int, int], a: float, modes: int
) -> tuple[FloatArray, FloatArray]:
    """What keeps the lips of one expression from crossing: half of the way given to each.

    Returns:
        (K, M, 3) parting displacement of the curves; (2, n, 3) what it leaves to the margins.
    """
    lips = seam("mouth", size, a, modes)
    moved = measured.expressions(_sources({**COMPANY.get(name, {}), name: 1.0}), size)
    crossed = lips.gap(moved.smooth, moved.parting)[:, 1].clip(max=0.0)
    up = np.multiply.outer(-0.5 * crossed, [0.0, 1.0, 0.0])
    apart = lips.moved(up, -up)
    left = np.array([up, -up]) - lips.lines(np.zeros_like(apart), apart)
    for array in (apart, left):
        array.setflags(write=False)
    return apart, left
