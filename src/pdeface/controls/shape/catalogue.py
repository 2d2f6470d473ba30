"""Every shape control by name, and the displacement of the curves that it stands for."""

from __future__ import annotations

import difflib
from collections.abc import Mapping
from functools import lru_cache
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from pdeface.controls.control import Control
from pdeface.controls.shape.fields import ShapeField
from pdeface.controls.shape.frontal import FRONTAL
from pdeface.controls.shape.head import HEAD
from pdeface.controls.shape.mandible import MANDIBLE
from pdeface.controls.shape.maxilla import MAXILLA
from pdeface.controls.shape.nasal import NASAL
from pdeface.controls.shape.orbital import ORBITAL
from pdeface.controls.shape.sites import sites
from pdeface.controls.shape.zygomatic import ZYGOMATIC
from pdeface.curves import mirror_points
from pdeface.errors import InputError

__all__ = ["COMBINABLE_RANGE", "SHAPE_CONTROLS", "displacement"]

FloatArray = NDArray[np.float64]

_GROUPS: Mapping[str, tuple[ShapeField, ...]] = MappingProxyType(
    {
        "frontal": FRONTAL,
        "orbital": ORBITAL,
        "nasal": NASAL,
        "zygomatic": ZYGOMATIC,
        "maxilla": MAXILLA,
        "mandible": MANDIBLE,
        "head": HEAD,
    }
)

SHAPE_CONTROLS: Mapping[str, Control] = MappingProxyType(
    {field.name: field.control(group) for group, fields in _GROUPS.items() for field in fields}
)
"""The conformation controls by name, -1 to 1, grouped by the bones of the skull (section 2.3)."""

COMBINABLE_RANGE = 1.0
"""Values within +- this may be combined at random: of 2,000 combinations of all the controls, drawn
evenly, none folds a cell of the 28 x 46 neutral face on a 109 x 161 mesh (``python -m
benchmarks.combinations``, which has the finer levels, too)."""

_FIELDS = {field.name: field.field for fields in _GROUPS.values() for field in fields}


@lru_cache(maxsize=256)
def displacement(name: str, shape: tuple[int, int]) -> FloatArray:
    """Displacement of K curves of M points by a shape control at +1.

    Args:
        name: one of :data:`SHAPE_CONTROLS`.
        shape: (K, M), with an even M.

    Returns:
        (K, M, 3) metres, read-only; closed by reflection like the curves.

    Raises:
        InputError: no such control, or curves that cannot be their own reflection.
    """
    if name not in _FIELDS:
        raise InputError(f"expected a shape control, got {name!r}; {_nearest(name)}")
    curves, points = shape
    if curves < 2 or points < 4 or points % 2:
        raise InputError(
            "shape controls need 2 curves or more with an even number of points, 4 or more, "
            f"got {curves} x {points}; give (28, 46), for example"
        )
    half = _FIELDS[name](sites((curves, points)))
    closed = mirror_points(half)
    closed.setflags(write=False)
    return closed


def _nearest(name: str) -> str:
    """Advice on an unknown name."""
    by_lower = {known.lower(): known for known in SHAPE_CONTROLS}
    near = difflib.get_close_matches(name.lower(), by_lower, n=3, cutoff=0.5)
    if near:
        return f"did you mean {' or '.join(by_lower[each] for each in near)}?"
    return f"the shape controls are {', '.join(SHAPE_CONTROLS)}"
