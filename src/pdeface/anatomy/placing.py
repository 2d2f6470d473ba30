"""All parts of one person, placed behind the openings of the face."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from pdeface.anatomy.eyes import Eyeball, Lids
from pdeface.anatomy.measured import Frame, reference
from pdeface.anatomy.mouth import Cavity
from pdeface.anatomy.outline import Outline
from pdeface.anatomy.part import part
from pdeface.anatomy.teeth import Teeth, behind_lips
from pdeface.anatomy.tongue import Tongue

__all__ = ["Anatomy", "placed"]

FloatArray = NDArray[np.float64]


class _Moving(Protocol):
    """Closed curves at rest and their displacement, linear in both arguments."""

    rest: FloatArray

    def moved(self, outline: Outline, weights: Mapping[str, float]) -> FloatArray: ...


class Anatomy:
    """The parts behind the openings of one person; see :func:`placed`.

    Where they lie follows from the face at rest; how they move is linear in the motion of the
    margins and in the expressions, so that morph targets are exact.

    Attributes:
        eyeballs: the ``"right"`` and the ``"left"``, with their centre and radius.
    """

    def __init__(self, rest: Outline, lids: Sequence[Outline] = ()) -> None:
        self.eyeballs: dict[str, Eyeball] = {}
        self._parts: dict[str, _Moving] = {}
        for side in ("right", "left"):
            margins, *others = (getattr(each, f"{side}_eye") for each in (rest, *lids))
            ball = Eyeball(side, margins, others)
            self.eyeballs[side] = self._parts[f"{side}_eyeball"] = ball
            self._parts[f"{side}_lids"] = Lids(side, margins, ball)
        frame = behind_lips(Frame.between(reference().mouth, rest.mouth), rest.mouth)
        self._parts["mouth"] = Cavity(rest.mouth, frame)
        for name in ("upper", "lower"):
            self._parts[f"{name}_teeth"] = Teeth(name, frame)
        self._parts["tongue"] = Tongue(frame)

    def curves(self, name: str) -> FloatArray:
        """(K, M, 3) closed curves of a part at rest, metres.

        Raises:
            InputError: no part has that name.
        """
        return np.array(self._parts[part(name).name].rest)

    def moved(self, name: str, outline: Outline, weights: Mapping[str, float]) -> FloatArray:
        """(K, M, 3) displacement of a part's curves, metres, linear in ``(outline, weights)``.

        Args:
            name: of the part.
            outline: displacement of the margins from where they rest.
            weights: values of ARKit's expressions by name; those that move no part are ignored.

        Raises:
            InputError: no part has that name.
        """
        return self._parts[part(name).name].moved(outline, weights)


def placed(rest: Outline, lids: Sequence[Outline] = ()) -> Anatomy:
    """The parts of a person with this outline at rest.

    Args:
        rest: the outline of the face at rest.
        lids: outlines with other positions of the lids, such as half and wholly closed, which the
            eyeballs keep clear of as well.
    """
    return Anatomy(rest, lids)
