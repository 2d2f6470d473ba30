"""Morph targets: what each expression at full weight adds to positions and normals of a mesh.

The surface is linear in every expression, so that these displacements reproduce it exactly at any
weights. Normals are not linear: they are exact with one expression at weight 0 or 1.
"""

from __future__ import annotations

import difflib
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from pdeface.controls import COMPANY, CONTROLS, Displacement, expressed, person, slits
from pdeface.controls.visemes import VISEMES
from pdeface.errors import InputError
from pdeface.face import Face
from pdeface.formats._sample import Sample
from pdeface.pde import Join
from pdeface.sampler import sampler

__all__ = ["Expressions", "MorphTargets", "expression_names", "target_names"]

Float32 = NDArray[np.float32]
Float64 = NDArray[np.float64]

Expressions = Literal["all"] | Sequence[str] | None
"""Which expressions become morph targets: ``"all"``, some by name, or None for the default."""

# Differences of all targets together: 52 of them on a mesh of 877,000 vertices.
_LARGEST = 1 << 30
# Numbers evaluated in one batch.
_BATCH = 1 << 23


def expression_names(face: Face, expressions: Expressions) -> tuple[str, ...]:
    """The expressions that become morph targets of ``face``, in their order in a file.

    Args:
        face: the face.
        expressions: ``"all"``; some by name; or None for all that the face can make, which
            are none if its curves do not lie on lids and lips.

    Raises:
        InputError: a name of no expression, or expressions that the face cannot make.
    """
    every = tuple(name for name, control in CONTROLS.items() if control.kind == "expression")
    if expressions is None:
        return every if face.has_lids else ()
    if isinstance(expressions, str) and expressions == "all":
        names = every
    elif isinstance(expressions, str) or not isinstance(expressions, Sequence):
        raise InputError(
            "expressions are 'all' or a sequence of names, such as ('jawOpen',), "
            f"got {expressions!r}"
        )
    else:
        names = tuple(dict.fromkeys(expressions))
    for name in names:
        if name not in every:
            raise _unknown(name, every)
    if names:
        slits(face.curves.shape[0])
    return names


def target_names(face: Face, expressions: Sequence[str], visemes: bool) -> tuple[str, ...]:
    """The morph targets of a file: these expressions, and after them the visemes if asked for.

    Raises:
        InputError: visemes, and a face that cannot make them.
    """
    if not visemes:
        return tuple(expressions)
    slits(face.curves.shape[0])
    return (*expressions, *VISEMES)


@dataclass(frozen=True, eq=False)
class MorphTargets:
    """Expressions and visemes as displacements of the vertices and normals of a sampled face.

    Attributes:
        face: without these expressions.
        surface: the face sampled.
        join: how its patches meet.
        names: the expressions and visemes.
        weights: of these, in the order of their names.
        raised: the face sampled with a relief on it, which is what a file shows.

    Raises:
        InputError: more than a gigabyte of displacements.
    """

    face: Face
    surface: Sample
    join: Join
    names: tuple[str, ...]
    weights: tuple[float, ...]
    raised: Sample | None = None

    def __post_init__(self) -> None:
        rows, columns = self.surface.uv_mesh.rows, self.surface.uv_mesh.columns
        size = 24 * len(self.names) * rows * columns
        if size > _LARGEST:
            raise InputError(
                f"{len(self.names)} morph targets on a mesh of {rows} x {columns} would take up to "
                f"{size / 2**30:.1f} GiB, and {_LARGEST >> 30} is the most; "
                "choose a coarser mesh, or fewer expressions"
            )

    def differences(self) -> Iterator[tuple[Float32, Float32]]:
        """(V, 3) positions, metres, and (V, 3) normals that each target adds."""
        shape, count = self.face.curves.shape, len(self.surface.vertices)
        own = self.face.displacement
        moved = self.moved
        parts = self.join == "smooth"
        base = _layers(self.face.curves.points + own.smooth, own.parting, parts)
        points = np.array([_layers(one.smooth, one.parting, parts) for one in moved])
        margins = np.array([one.margins for one in moved])
        mirrored = self.face.curves.is_mirrored
        evaluator = sampler(
            shape, self.surface.uv_mesh, self.face.a, self.face.modes, self.join, parts, mirrored
        )
        step = max(1, _BATCH // (6 * count))
        for start in range(0, len(points), step):
            some, edges = points[start : start + step], margins[start : start + step]
            positions = evaluator.positions(some, edges)
            normals = evaluator.normals(some + base, edges + own.margins)
            for position, normal in zip(positions, normals, strict=True):
                yield position.astype(np.float32), self._turned(normal)

    @cached_property
    def moved(self) -> list[Displacement]:
        """What each target adds to the curves at full weight."""
        return list(self._moved())

    def controls(self, name: str) -> Mapping[str, float]:
        """The expressions that a target stands for."""
        return VISEMES.get(name, {name: 1.0})

    def _moved(self) -> Iterator[Displacement]:
        face = self.face
        rest = face.curves.points + person(face.weights, face.curves.shape)
        kept = {n: w for n, w in face.weights.items() if CONTROLS[n].kind == "expression"}
        before = expressed(rest, kept, face.a, face.modes)
        for name in self.names:
            company = {**kept, **COMPANY.get(name, {})}
            alone = expressed(rest, company, face.a, face.modes) if company != kept else before
            after = expressed(rest, {**company, **self.controls(name)}, face.a, face.modes)
            yield after.less(alone)

    def _turned(self, normals: NDArray[np.floating]) -> Float32:
        """Normals less those of the face; 0 where the surface is pinched and has none."""
        turned = (normals - self.surface.normals).astype(np.float32)
        turned[np.einsum("ij,ij->i", normals, normals) < 0.5] = 0.0
        return turned


def _layers(smooth: Float64, parting: Float64, parts: bool) -> Float64:
    """(2 K, M, 3) for a surface that parts; (K, M, 3) for the paper's, which is creased anyway."""
    return np.concatenate([smooth, parting]) if parts else smooth + parting


def _unknown(name: object, every: Sequence[str]) -> InputError:
    near = difflib.get_close_matches(str(name), every, n=3, cutoff=0.5)
    hint = f"did you mean {', '.join(near)}?" if near else "see pdeface.controls.ARKIT"
    return InputError(f"no expression is called {name!r}; {hint}")
