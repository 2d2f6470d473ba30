"""The 52 expressions of Apple's ARKit, and what each was measured from.

Left and right are the subject's. ``browInnerUp`` and ``cheekPuff`` are the sum of their two sides,
which the source has apart. ``tongueOut`` has no source: it moves the tongue
(:mod:`pdeface.anatomy`) and nothing of the face itself.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from types import MappingProxyType

from pdeface.controls.control import Control

__all__ = ["ARKIT", "EXPRESSIONS", "EYE_RANGE", "SOURCES"]

_BY_GROUP = {
    "eyes": "eyeBlink eyeLookDown eyeLookIn eyeLookOut eyeLookUp eyeSquint eyeWide",
    "jaw": "jawForward jawLeft jawRight jawOpen",
    "mouth": "mouthClose mouthFunnel mouthPucker mouthLeft mouthRight mouthSmile mouthFrown "
    "mouthDimple mouthStretch mouthRollLower mouthRollUpper mouthShrugLower mouthShrugUpper "
    "mouthPress mouthLowerDown mouthUpperUp",
    "brows": "browDown browInnerUp browOuterUp",
    "cheeks": "cheekPuff cheekSquint",
    "nose": "noseSneer",
    "tongue": "tongueOut",
}
_PAIRED = frozenset(
    [
        *_BY_GROUP["eyes"].split(),
        *("mouthSmile", "mouthFrown", "mouthDimple", "mouthStretch", "mouthPress"),
        *("mouthLowerDown", "mouthUpperUp", "browDown", "browOuterUp", "cheekSquint", "noseSneer"),
    ]
)
_SUMMED = frozenset({"browInnerUp", "cheekPuff"})
_OF_THE_TONGUE = frozenset({"tongueOut"})


def _names(stem: str) -> tuple[str, ...]:
    return (f"{stem}Left", f"{stem}Right") if stem in _PAIRED else (stem,)


def _in_order() -> tuple[str, ...]:
    """ARKit lists all of the left eye, then all of the right; other pairs side by side."""
    eyes = _BY_GROUP["eyes"].split()
    rest = [s for group, stems in _BY_GROUP.items() if group != "eyes" for s in stems.split()]
    sides = [stem + side for side in ("Left", "Right") for stem in eyes]
    return (*sides, *(name for stem in rest for name in _names(stem)))


ARKIT = _in_order()
"""All 52 names in ARKit's order."""

EYE_RANGE = math.radians(30.0)
"""How far an eye turns, radians, at weight 1 of eyeLookUp, Down, In or Out."""

_GROUP = {n: g for g, stems in _BY_GROUP.items() for stem in stems.split() for n in _names(stem)}


def _sources(name: str) -> tuple[str, ...]:
    if name in _SUMMED:
        return f"{name}_L", f"{name}_R"
    for side in ("Left", "Right"):
        if name.endswith(side) and name.removesuffix(side) in _PAIRED:
            return (f"{name.removesuffix(side)}_{side[0]}",)
    return (name,)


SOURCES: Mapping[str, tuple[str, ...]] = MappingProxyType(
    {name: () if name in _OF_THE_TONGUE else _sources(name) for name in ARKIT}
)
"""Measured expressions that each control is the sum of."""

EXPRESSIONS: Mapping[str, Control] = MappingProxyType(
    {name: Control(name, _GROUP[name], "expression", 0.0, 1.0, "as in ARKit") for name in SOURCES}
)
"""The expression controls, 0 to 1."""
