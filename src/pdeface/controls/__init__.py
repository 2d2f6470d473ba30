"""Controls: named displacements of the boundary curves, in which the surface is linear.

Three kinds: *shape* (conformation: who it is, by name), *identity* (who it is, by statistics) and
*expression* (what it does: ARKit's).
"""

from __future__ import annotations

import difflib
from collections.abc import Mapping
from math import isfinite
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from pdeface.controls import measured, shape
from pdeface.controls.arkit import ARKIT, EXPRESSIONS, SOURCES
from pdeface.controls.contact import BLINKS, COMPANY, expressed, together
from pdeface.controls.control import Control
from pdeface.controls.measured import IDENTITIES, Displacement, has_lids, slits
from pdeface.errors import InputError

__all__ = [
    "ARKIT",
    "BLINKS",
    "COMPANY",
    "CONTROLS",
    "Control",
    "Displacement",
    "checked_weights",
    "displacement",
    "expressed",
    "has_lids",
    "person",
    "posed",
    "random_weights",
    "slits",
    "together",
]

FloatArray = NDArray[np.float64]

IDENTITY_RANGE = 3.0
"""Identity weights are standard deviations."""


def _identity(index: int) -> Control:
    return Control(
        f"identity{index + 1:02d}",
        "identity",
        "identity",
        -IDENTITY_RANGE,
        IDENTITY_RANGE,
        f"mode {index + 1} of how heads differ, in standard deviations",
    )


CONTROLS: Mapping[str, Control] = MappingProxyType(
    {
        **shape.SHAPE_CONTROLS,
        **{control.name: control for control in map(_identity, range(IDENTITIES))},
        **EXPRESSIONS,
    }
)
"""Every control by name, in the order in which they are listed."""


def checked_weights(weights: Mapping[str, float], *, clamp: bool = False) -> dict[str, float]:
    """The weights by name, in the order of :data:`CONTROLS`, without those that are 0.

    Args:
        weights: values by name of control.
        clamp: bring values into their range instead of refusing them.

    Raises:
        InputError: an unknown name (the message offers the nearest), a value that is not a finite
            number, or one out of range.
    """
    for name in weights:
        if name not in CONTROLS:
            raise _unknown(name)
    values = {n: _checked(CONTROLS[n], weights[n], clamp) for n in CONTROLS if n in weights}
    return {name: value for name, value in values.items() if value != 0.0}


def person(weights: Mapping[str, float], size: tuple[int, int]) -> FloatArray:
    """(K, M, 3) displacement of K curves of M points by who it is: shape and identity."""
    return displacement(_of_kinds(weights, {"shape", "identity"}), size).smooth


def posed(
    points: FloatArray, weights: Mapping[str, float], a: float = 1.0, modes: int = 6
) -> Displacement:
    """Displacement of a face's curves by all controls, its lids and lips kept in contact.

    Args:
        points: (K, M, 3) data points of the face without any.
        weights: values by name.
        a, modes: as for :class:`pdeface.pde.PDESurface`.

    Raises:
        InputError: an expression and a K for which no curve lies on the lids and lips.
    """
    size = points.shape[0], points.shape[1]
    own = person(weights, size)
    moved = expressed(points + own, _of_kinds(weights, {"expression"}), a, modes)
    return moved._replace(smooth=own + moved.smooth)


def _of_kinds(weights: Mapping[str, float], kinds: set[str]) -> dict[str, float]:
    return {name: weight for name, weight in weights.items() if CONTROLS[name].kind in kinds}


def displacement(weights: Mapping[str, float], size: tuple[int, int]) -> Displacement:
    """Displacement of K curves of M points by all controls, as they were measured and added.

    :func:`posed` keeps lids and lips in contact besides.

    Args:
        weights: values by name.
        size: (K, M).

    Raises:
        InputError: an expression and a K for which no curve lies on the lids and lips.
    """
    by_kind: dict[str, dict[str, float]] = {"shape": {}, "identity": {}, "expression": {}}
    for name, weight in weights.items():
        by_kind[CONTROLS[name].kind][name] = weight
    smooth, parting = np.zeros((*size, 3)), np.zeros((*size, 3))
    for name, weight in by_kind["shape"].items():
        smooth += weight * shape.displacement(name, size)
    if by_kind["identity"]:
        modes = {int(n.removeprefix("identity")) - 1: w for n, w in by_kind["identity"].items()}
        smooth += measured.identities(modes, size)
    if by_kind["expression"]:
        sources = {s: w for n, w in by_kind["expression"].items() for s in SOURCES[n]}
        moved = measured.expressions(sources, size)
        smooth += moved.smooth
        parting += moved.parting
    return Displacement(smooth, parting)


def random_weights(seed: int | None = None) -> dict[str, float]:
    """Identity weights of a random person, each normally distributed and at most 3 deviations."""
    drawn = np.random.default_rng(seed).normal(size=IDENTITIES)
    values = drawn.clip(-IDENTITY_RANGE, IDENTITY_RANGE).tolist()
    return {_identity(index).name: value for index, value in enumerate(values)}


def _checked(control: Control, value: float, clamp: bool) -> float:
    try:
        number = float(value)
    except (TypeError, ValueError):
        number = float("nan")
    if not isfinite(number):
        raise InputError(f"{control.name} must be a finite number, got {value!r}")
    if clamp:
        return min(max(number, control.low), control.high)
    if not control.low <= number <= control.high:
        raise InputError(
            f"{control.name} must lie in [{control.low:g}, {control.high:g}], got {number:g}; "
            "choose a value inside, or clamp"
        )
    return number


def _unknown(name: str) -> InputError:
    near = difflib.get_close_matches(name, CONTROLS, n=3, cutoff=0.5)
    hint = f"did you mean {', '.join(near)}?" if near else "see pdeface.controls.CONTROLS"
    return InputError(f"no control is called {name!r}; {hint}")
