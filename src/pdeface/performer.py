"""A face that performs: set up once for a uv mesh, then moved by 52 weights a frame."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import DTypeLike, NDArray

from pdeface.controls import (
    ARKIT,
    COMPANY,
    CONTROLS,
    Displacement,
    checked_weights,
    expressed,
    person,
    slits,
)
from pdeface.errors import InputError
from pdeface.face import Face
from pdeface.pde import GridEvaluator, Join, ShapeBasis
from pdeface.uvmesh import UVMesh

__all__ = ["Performer"]

Array = NDArray[np.floating]
FloatArray = NDArray[np.float64]

PAPER_MESH = UVMesh(28, 41)


class Performer:
    """The nodes of a uv mesh on a face, for frame after frame of expression weights.

    Shape, identity and the uv mesh are worked out when the object is made. A frame is the sum of
    what each expression does alone, as in a viewer of morph targets: to rounding the same positions
    as ``face.with_weights(...).mesh(..., openings="none")``, but for a blink among others and for
    ``mouthClose``, which a face adapts to what else it does (:func:`pdeface.controls.expressed`).

    Args:
        face: who performs. Its shape and identity stay; its expressions are what a mapping of
            weights leaves out.
        mesh: the uv mesh; 28 x 41 by default.
        join: ``"smooth"`` (C2) or ``"patchwise"`` (the paper's).
        dtype: precision of the positions: float32, which rounds to 0.0001 mm, or float64.

    Attributes:
        names: ARKit's 52 names, in the order of the weights in an array. What no face can do yet
            is ignored.
        face, mesh: as given.

    Raises:
        InputError: no curves of the face lie on lids and lips, so that no expression moves it, or
            a uv mesh that is cut.

    Example:
        >>> import numpy as np, pdeface
        >>> performer = pdeface.Performer(pdeface.neutral())
        >>> performer.positions({"jawOpen": 0.5}).shape
        (28, 41, 3)
        >>> performer.positions(np.zeros((100, 52))).shape
        (100, 28, 41, 3)
    """

    def __init__(
        self,
        face: Face,
        mesh: UVMesh = PAPER_MESH,
        *,
        join: Join = "smooth",
        dtype: DTypeLike = np.float32,
    ) -> None:
        if mesh.openings:
            raise InputError("a performer moves the nodes of a whole uv mesh; leave openings out")
        self.face, self.mesh, self.names = face, mesh, ARKIT
        columns = [i for i, name in enumerate(ARKIT) if name in CONTROLS]
        # Reading a slice takes no time; a list would.
        first = slice(len(columns))
        self._columns = first if columns == list(range(len(columns))) else columns
        self._own = np.array([face.weights.get(name, 0.0) for name in ARKIT])
        parts = join == "smooth"
        shape = face.curves.shape
        evaluator = GridEvaluator(
            shape,
            mesh.u,
            mesh.v,
            a=face.a,
            modes=face.modes,
            join=join,
            parting=slits(shape[0]) if parts else None,
            mirrored=face.curves.is_mirrored,
            dtype=dtype,
        )
        rest = face.curves.points + person(face.weights, shape)
        moved = [_layers(_alone(face, rest, ARKIT[i]), parts) for i in columns]
        base = _layers(Displacement(rest, np.zeros_like(rest)), parts)
        self._basis = ShapeBasis(evaluator, np.stack([*moved, base]))

    def empty(self, *batch: int) -> Array:
        """(*batch, rows, columns, 3) uninitialised memory for ``out``."""
        return self._basis.empty(*batch)

    def positions(self, weights: Mapping[str, float] | Any, *, out: Array | None = None) -> Array:
        """(..., rows, columns, 3) positions of the nodes, metres: views of planar memory.

        Args:
            weights: (..., 52) numbers from 0 to 1 in the order of :attr:`names`, leading axes
                being a batch of frames; or one frame as a mapping from names, in which the
                face's own expressions stand for the names left out.
            out: memory from :meth:`empty` to write over, which is faster than new memory.

        Raises:
            InputError: weights out of range or of another number, an unknown name, or ``out``
                that did not come from :meth:`empty`.
        """
        frames = self._named(weights) if isinstance(weights, Mapping) else _in_range(weights)
        full = np.empty((*frames.shape[:-1], self._basis.count), self._basis.dtype)
        full[..., :-1] = frames[..., self._columns]
        full[..., -1] = 1.0
        return self._basis.positions(full, out=out)

    def _named(self, weights: Mapping[str, float]) -> FloatArray:
        for name in weights:
            if name not in ARKIT and name in CONTROLS:
                raise InputError(
                    f"a performer moves expressions, got {name!r}; set it on the face beforehand"
                )
        given = {**dict.fromkeys(weights, 0.0), **checked_weights(weights)}
        return np.array([given.get(n, own) for n, own in zip(ARKIT, self._own, strict=True)])


def _in_range(weights: Any) -> Array:
    """(..., 52) weights, checked."""
    frames: Array = np.asarray(weights)
    if frames.dtype.kind not in "fiub" or frames.shape[-1:] != (len(ARKIT),):
        raise InputError(
            f"weights are {len(ARKIT)} numbers a frame, (..., {len(ARKIT)}), in ARKit's order, "
            f"got {frames.dtype} of shape {frames.shape}; see Performer.names"
        )
    # Not written the other way round: a nan is in no range.
    flat = frames.reshape(-1)
    if flat.size and not (np.minimum.reduce(flat) >= 0.0 and np.maximum.reduce(flat) <= 1.0):
        low, high = flat.min(), flat.max()
        raise InputError(f"weights lie in [0, 1], got some from {low:g} to {high:g}; clip them")
    return frames


def _alone(face: Face, rest: FloatArray, name: str) -> Displacement:
    """What an expression adds to the curves at full weight, as a morph target does."""
    company = COMPANY.get(name, {})
    before = expressed(rest, company, face.a, face.modes)
    return expressed(rest, {**company, name: 1.0}, face.a, face.modes).less(before)


def _layers(moved: Displacement, parts: bool) -> FloatArray:
    """(2 K, M, 3) displacement for a surface that parts; (K, M, 3) for the paper's."""
    if parts:
        return np.concatenate([moved.smooth, moved.parting])
    return moved.smooth + moved.parting
