"""The fifteen visemes of speech as weights of ARKit controls.

The set, its names and what each stands for are those of the Oculus lip-sync kit, which avatars
expect. The weights are this project's, from how the sounds are made:

- what the **lips** do (spread, rounded, closed, the lower one under the teeth) is what is seen and
  sets a viseme apart; what the tongue does behind the teeth (DD, kk, nn) is left to a jaw that
  opens a little. ``tongueOut`` is not used: TH shows a parted mouth and no tongue;
- the **jaw** opens with the vowel: most for aa, then O and E, little for I and U;
- both sides are alike, and weights are those of clear speech, not of shouting;
- ``mouthClose`` brings together lips that the jaw has parted, so it is never above ``jawOpen``.

As each viseme is a weighted sum of controls, it is a morph target where they are.
"""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

from pdeface.controls.naming import both_sides

__all__ = ["VISEMES"]

_WEIGHTS = {
    # Silence: the face at rest.
    "viseme_sil": both_sides(),
    # p, b, m: lips pressed together, their red rolled in a little; the jaw hangs behind them.
    "viseme_PP": both_sides(
        jawOpen=0.06, mouthClose=0.06, mouthPress=0.35, mouthRollLower=0.3, mouthRollUpper=0.22
    ),
    # f, v: the lower lip drawn up and in under the upper teeth, which the upper lip bares.
    "viseme_FF": both_sides(
        jawOpen=0.06, mouthRollLower=0.5, mouthShrugLower=0.12, mouthUpperUp=0.22
    ),
    # th: the tongue between the teeth; lips apart and flat.
    "viseme_TH": both_sides(
        jawOpen=0.14, mouthLowerDown=0.24, mouthUpperUp=0.12, mouthStretch=0.06
    ),
    # t, d: the tongue behind the upper teeth, which are just apart.
    "viseme_DD": both_sides(jawOpen=0.11, mouthLowerDown=0.24, mouthUpperUp=0.1, mouthStretch=0.08),
    # k, g: the back of the tongue against the palate; the lips wait for the vowel.
    "viseme_kk": both_sides(jawOpen=0.17, mouthLowerDown=0.16, mouthUpperUp=0.08),
    # ch, j, sh: teeth nearly shut, lips pushed forward into a square.
    "viseme_CH": both_sides(
        jawOpen=0.06, mouthFunnel=0.5, mouthPucker=0.12, mouthLowerDown=0.15, mouthUpperUp=0.1
    ),
    # s, z: teeth together, the jaw a little forward, lips spread off them.
    "viseme_SS": both_sides(
        jawOpen=0.03,
        jawForward=0.06,
        mouthStretch=0.22,
        mouthSmile=0.12,
        mouthLowerDown=0.24,
        mouthUpperUp=0.12,
    ),
    # n, l: as t and d, but voiced and wider apart.
    "viseme_nn": both_sides(jawOpen=0.14, mouthLowerDown=0.18, mouthUpperUp=0.08),
    # r: lips pushed forward, less than for ch, and closer together.
    "viseme_RR": both_sides(jawOpen=0.1, mouthFunnel=0.2, mouthPucker=0.32, mouthLowerDown=0.05),
    # a as in car: the jaw at its widest, lips at ease.
    "viseme_aa": both_sides(jawOpen=0.5, mouthLowerDown=0.18, mouthUpperUp=0.1),
    # e as in bed: half open, corners drawn apart.
    "viseme_E": both_sides(
        jawOpen=0.28, mouthStretch=0.18, mouthSmile=0.14, mouthLowerDown=0.2, mouthUpperUp=0.1
    ),
    # i as in tip and tea: nearly closed, corners far apart.
    "viseme_I": both_sides(
        jawOpen=0.13, mouthStretch=0.22, mouthSmile=0.28, mouthLowerDown=0.22, mouthUpperUp=0.12
    ),
    # o as in toe: half open and round.
    "viseme_O": both_sides(jawOpen=0.34, mouthFunnel=0.38, mouthPucker=0.35),
    # u as in book: nearly closed, the lips a small ring far forward.
    "viseme_U": both_sides(jawOpen=0.1, mouthFunnel=0.12, mouthPucker=0.8),
}

VISEMES: Mapping[str, Mapping[str, float]] = MappingProxyType(
    {name: MappingProxyType(weights) for name, weights in _WEIGHTS.items()}
)
"""Weights by ARKit name of ``viseme_sil``, ``viseme_PP``, ... ``viseme_U``."""
