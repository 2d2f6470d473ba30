"""Speech: a row of visemes, each with its length, as weights over time.

Sounds are not spoken one after the other but over each other: lips are round before the u of
"two" begins. Each viseme therefore has a dominance that rises and falls about its own time and
reaches into its neighbours, and the mouth is the mean of all visemes weighted by dominance (after
Cohen and Massaro, "Modeling coarticulation in synthetic visual speech", 1993, with bells in place
of their two-sided exponentials, which have a corner). Sounds that the lips make count for more than
those that the tongue makes behind them. One thing no neighbour may prevent: at p, b and m the lips
close.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from pdeface.controls.visemes import VISEMES
from pdeface.errors import InputError
from pdeface.motion import easing
from pdeface.motion.names import did_you_mean

__all__ = ["mouth_weights"]

FloatArray = NDArray[np.float64]

# How much a sound insists on its own shape of the lips.
_STRENGTH = {
    **dict.fromkeys(VISEMES, 1.0),
    **dict.fromkeys(("viseme_PP", "viseme_FF"), 2.5),
    **dict.fromkeys(("viseme_CH", "viseme_O", "viseme_U"), 1.4),
    **dict.fromkeys(("viseme_kk", "viseme_nn", "viseme_DD", "viseme_TH", "viseme_RR"), 0.6),
}
# Standard deviation of a bell, as a share of the sound's length, and its least, seconds. Lips need
# about 100 ms from one shape to the next.
_REACH, _LEAST_REACH = 0.5, 0.035
_CLOSING = 0.08
_PARTED = ("mouthLowerDown", "mouthUpperUp", "mouthFunnel")


def mouth_weights(
    times: FloatArray, visemes: Sequence[tuple[str, float]], start: float = 0.0
) -> dict[str, FloatArray]:
    """Weights of the mouth by ARKit name, while a row of visemes is spoken.

    Args:
        times: (T,) seconds.
        visemes: (name, seconds that it lasts) of each.
        start: when the first begins, seconds. Before it and after the last, the mouth is at rest.

    Returns:
        (T,) weights of each control that occurs.

    Raises:
        InputError: an unknown viseme, or one that lasts no time.
    """
    _check(visemes)
    # The rest before and after lasts for ever, but a bell that long would reach into all others.
    spoken = [("viseme_sil", 2 * _CLOSING), *visemes, ("viseme_sil", 2 * _CLOSING)]
    lengths = np.array([length for _, length in spoken])
    middles = start - lengths[0] + np.cumsum(lengths) - lengths / 2
    reach = np.maximum(_REACH * lengths, _LEAST_REACH)
    # Beyond the outermost middles the rest stays as dominant as it is there.
    moments = np.clip(times, middles[0], middles[-1])[:, np.newaxis]
    strength = np.log([_STRENGTH[name] for name, _ in spoken])
    dominance = strength - 0.5 * ((moments - middles) / reach) ** 2
    share = np.exp(dominance - dominance.max(axis=1, keepdims=True))
    share /= share.sum(axis=1, keepdims=True)
    names = dict.fromkeys(name for viseme, _ in visemes for name in VISEMES[viseme])
    weights = {
        name: share @ np.array([VISEMES[viseme].get(name, 0.0) for viseme, _ in spoken])
        for name in names
    }
    rest = easing.window(times - start + _CLOSING, sum(lengths[1:-1]) + 2 * _CLOSING, _CLOSING)
    weights = {name: values * rest for name, values in weights.items()}
    closed = [
        (middle, length)
        for (name, length), middle in zip(spoken, middles, strict=True)
        if name == "viseme_PP"
    ]
    return _close(times, weights, closed) if closed else weights


def _close(
    times: FloatArray, weights: dict[str, FloatArray], sounds: Sequence[tuple[float, float]]
) -> dict[str, FloatArray]:
    """Bring the lips together at each (middle, length), however far the jaw is down."""
    parted = np.ones_like(times)
    for middle, length in sounds:
        parted = parted * (
            1.0 - easing.bump(times, middle, length + 2 * _CLOSING, plateau=0.6 * length)
        )
    lips = {
        name: values * parted
        if name.removesuffix("Left").removesuffix("Right") in _PARTED
        else values
        for name, values in weights.items()
    }
    return {**lips, "mouthClose": weights["jawOpen"] * (1.0 - parted)}


def _check(visemes: Sequence[tuple[str, float]]) -> None:
    if not visemes:
        raise InputError("expected visemes to speak, got none; give at least one")
    for name, length in visemes:
        if name not in VISEMES:
            raise InputError(f"expected a viseme, got {name!r}; {did_you_mean(name, VISEMES)}")
        if not 0 < length < np.inf:
            raise InputError(
                f"expected {name} to last some seconds, got {length}; give a positive number"
            )
