"""Outlines of the openings of a face, and closed loops through them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from pdeface.errors import InputError
from pdeface.template import openings

__all__ = ["OPENINGS", "SAMPLES", "Loop", "Margins", "Outline", "outline_uv"]

FloatArray = NDArray[np.float64]

Surface = Callable[[Any, Any], FloatArray]

SAMPLES = len(openings()[0].v)
"""Samples of each margin."""

OPENINGS = MappingProxyType({opening.name: opening for opening in openings()})
"""The openings of the face by name."""


def outline_uv(name: str, samples: int = SAMPLES) -> tuple[FloatArray, FloatArray]:
    """Where the margins of an opening lie on the face.

    Returns:
        (2, samples) values of u, the upper margin's and the lower's; (samples,) values of v from
        the subject's right to left, ``v_mid - h cos(pi i / (samples - 1))``, dense at the corners.
    """
    opening = OPENINGS[name]
    start, end = opening.corners
    cosine = np.cos(np.pi * np.arange(samples) / (samples - 1))
    v = 0.5 * (start + end) - 0.5 * (end - start) * cosine
    v[0], v[-1] = start, end
    return np.stack(opening.lines(v)), v


class Margins(NamedTuple):
    """The two sides of an opening, or displacements of them, metres.

    Attributes:
        upper, lower: (n, 3) each, from the subject's right corner to the left.
    """

    upper: FloatArray
    lower: FloatArray


@dataclass(frozen=True, eq=False)
class Outline:
    """The margins of the three openings, or displacements of them.

    Raises:
        InputError: arrays of other shapes, or numbers that are not finite.
    """

    right_eye: Margins
    left_eye: Margins
    mouth: Margins

    def __post_init__(self) -> None:
        for name in OPENINGS:
            margins = np.asarray(getattr(self, name), dtype=np.float64)
            if margins.ndim != 3 or len(margins) != 2 or margins.shape[1:] != (SAMPLES, 3):
                raise InputError(
                    f"the outline of {name} needs two margins of ({SAMPLES}, 3) points, got "
                    f"{margins.shape}; sample the face at outline_uv({name!r})"
                )
            if not np.isfinite(margins).all():
                raise InputError(
                    f"the outline of {name} must be finite numbers, got NaN or infinity; "
                    "sample a face that is finite"
                )
            object.__setattr__(self, name, Margins(*margins))

    @classmethod
    def sampled(cls, surface: Surface, parting: Surface | None = None) -> Outline:
        """The outline of a face.

        Args:
            surface: S(u, v) of the face, (..., 3) for any u and v.
            parting: what parts lids and lips, added to it; each margin moves as the curve of its
                side does there.
        """
        margins = {}
        for name, opening in OPENINGS.items():
            u, v = outline_uv(name)
            places = surface(u, np.broadcast_to(v, u.shape))
            if parting is not None:
                on_curves = [opening.belonging(u[i], v, upper=i == 0) for i in (0, 1)]
                places = places + parting(np.stack(on_curves), np.broadcast_to(v, u.shape))
            margins[name] = Margins(*places)
        return cls(**margins)

    def less(self, other: Outline) -> Outline:
        """How far this outline is displaced from another."""
        mine, theirs = ([np.array(getattr(each, n)) for n in OPENINGS] for each in (self, other))
        return Outline(*(Margins(*(a - b)) for a, b in zip(mine, theirs, strict=True)))


class Loop:
    """The closed loop round an opening: M points, equal steps on the upper side and on the lower.

    It starts half-way up the side of the right corner, runs along the upper margin to the left
    corner and along the lower one back. Points are linear in the margins; the weights are those
    of the margins at rest, so that a displacement of the margins displaces the loop.

    Args:
        rest: the margins at rest.
        count: M, an even number.
    """

    def __init__(self, rest: Margins, count: int) -> None:
        self.count = count
        self._weights = [_resampling(side, other, count // 2) for side, other in _sides(rest)]
        self.across = (np.arange(count // 2) + 0.5) / (count // 2)
        """(M / 2,) how far across each point of the upper half lies, 0 to 1."""

    def __call__(self, margins: Margins) -> FloatArray:
        """(M, 3) points of the loop through these margins."""
        upper, lower = (
            weights @ _chain(side, other)
            for weights, (side, other) in zip(self._weights, _sides(margins), strict=True)
        )
        return np.concatenate([upper, lower[::-1]])

    def taper(self, reach: float) -> FloatArray:
        """(M, 1) 0 at the corners, rising smoothly to 1 over this fraction of the width."""
        near = (np.minimum(self.across, 1.0 - self.across) / reach).clip(0.0, 1.0)
        rise = near * near * (3.0 - 2.0 * near)
        return np.concatenate([rise, rise[::-1]])[:, None]


def middle(loop: FloatArray) -> FloatArray:
    """(M, 3) points half-way between each point of a loop and the one across the opening."""
    return 0.5 * (loop + loop[::-1])


def _sides(margins: Margins) -> tuple[tuple[FloatArray, FloatArray], ...]:
    return (margins.upper, margins.lower), (margins.lower, margins.upper)


def _chain(side: FloatArray, other: FloatArray) -> FloatArray:
    """A margin with half of the side of each corner: n + 2 points."""
    ends = 0.5 * (side[[0, -1]] + other[[0, -1]])
    return np.concatenate([ends[:1], side, ends[1:]])


def _resampling(side: FloatArray, other: FloatArray, count: int) -> FloatArray:
    """(count, n + 2) weights of equal steps along the chain of a margin."""
    chain = _chain(side, other)
    steps = np.linalg.norm(np.diff(chain, axis=0), axis=1)
    length = np.concatenate([[0.0], np.cumsum(steps)])
    wanted = (np.arange(count) + 0.5) / count * length[-1]
    unit = np.eye(len(chain))
    return np.stack([np.interp(wanted, length, row) for row in unit], axis=1)
