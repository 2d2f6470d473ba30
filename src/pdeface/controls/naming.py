"""What is said of ARKit's names: both sides at once, and the nearest to one that is none."""

from __future__ import annotations

import difflib
from collections.abc import Iterable

from pdeface.controls.arkit import ARKIT
from pdeface.errors import InputError

__all__ = ["PAIRED", "both_sides", "did_you_mean"]

PAIRED = frozenset(
    name.removesuffix("Left")
    for name in ARKIT
    if name.endswith("Left") and name not in ("jawLeft", "mouthLeft")
)
"""Names, without their side, of the blendshapes that there are two of."""


def both_sides(**weights: float) -> dict[str, float]:
    """Weights by ARKit name, from names that leave the side out: ``mouthSmile`` means both.

    A name that is an ARKit name already (``jawOpen``, ``eyeBlinkLeft``) is kept.
    """
    sided: dict[str, float] = {}
    for name, weight in weights.items():
        if name in PAIRED:
            sided[f"{name}Left"] = sided[f"{name}Right"] = weight
        elif name in ARKIT:
            sided[name] = weight
        else:
            raise InputError(f"expected an ARKit name, got {name!r}; {did_you_mean(name, ARKIT)}")
    return sided


def did_you_mean(name: str, known: Iterable[str]) -> str:
    """Advice on an unknown name: the nearest ones, or all of them if none is near."""
    names = {each.lower(): each for each in known}
    near = [names[each] for each in difflib.get_close_matches(name.lower(), names, n=3)]
    if near:
        return f"did you mean {' or '.join(near)}?"
    if len(names) <= 20:
        return f"use one of {', '.join(names.values())}"
    return "use an ARKit name such as jawOpen or eyeBlinkLeft"
