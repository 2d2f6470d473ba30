"""What a control is: a named displacement of the boundary curves, with a range."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

__all__ = ["Control", "Kind"]

Kind = Literal["shape", "identity", "expression"]


@dataclass(frozen=True)
class Control:
    """A named displacement of the boundary curves; the surface is linear in its value.

    Attributes:
        name: camelCase; left and right are the subject's.
        group: what it belongs to, such as ``"nasal"`` or ``"eyes"``.
        kind: ``"shape"`` (who it is, by name), ``"identity"`` (who it is, by statistics) or
            ``"expression"`` (what it does).
        low, high: documented range; at 0 nothing happens.
        description: what it does at ``high``, in a few words.
    """

    name: str
    group: str
    kind: Kind
    low: float
    high: float
    description: str
