"""Animation: weights of the morph targets and rotation of the head over time, as a glTF clip."""

from __future__ import annotations

import difflib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pdeface.controls import ARKIT
from pdeface.errors import InputError
from pdeface.formats._gltf_builder import GltfBuilder

__all__ = ["Animation", "add_animation", "quaternions"]

Float64 = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Animation:
    """What a face does over time. Between samples, straight lines; the head turns evenly.

    Attributes:
        name: of the clip.
        times: (T,) seconds, not negative and strictly increasing, in single precision too.
        weights: (T,) weights, 0..1, by ARKit name.
        head: (T, 3) yaw, pitch and roll, radians: ``R = R_y(yaw) R_x(pitch) R_z(roll)``, the axes
            those of docs/conventions.md. None for a head that does not turn.

    Raises:
        InputError: not such arrays, an unknown name, or a number out of range.
    """

    name: str
    times: Float64
    weights: Mapping[str, Float64]
    head: Float64 | None = None

    def __post_init__(self) -> None:
        times = _times(self.times)
        weights = {name: _weights(name, w, len(times)) for name, w in self.weights.items()}
        object.__setattr__(self, "times", times)
        object.__setattr__(self, "weights", weights)
        if self.head is not None:
            head = _numbers(self.head, "head", (len(times), 3))
            object.__setattr__(self, "head", head)


def add_animation(
    document: GltfBuilder,
    animation: Animation,
    names: Sequence[str],
    resting: Sequence[float],
    face: int,
    head: int,
) -> None:
    """Add the clip: a channel for all morph targets, and one for the head if it turns.

    Args:
        document: to which it is added.
        animation: what happens. Expressions that are no target are left out.
        names: the morph targets.
        resting: their weights, which those keep of which the animation says nothing.
        face: the node with the morph targets.
        head: the node that turns.

    Raises:
        InputError: nothing of the animation is left.
    """
    if animation.head is None and not set(names) & set(animation.weights):
        raise InputError(
            f"the animation {animation.name!r} moves nothing that the file has: it turns no head, "
            "and none of its expressions is a morph target; choose others"
        )
    times = document.add_accessor(animation.times.astype(np.float32), bounds=True)
    samplers: list[dict[str, Any]] = []
    channels: list[dict[str, Any]] = []

    def add(node: int, path: str, values: Float64) -> None:
        output = document.add_accessor(values.astype(np.float32))
        channels.append({"sampler": len(samplers), "target": {"node": node, "path": path}})
        samplers.append({"input": times, "output": output, "interpolation": "LINEAR"})

    if names:
        constant = np.broadcast_to(np.asarray(resting), (len(animation.times), len(names)))
        pairs = zip(names, constant.T, strict=True)
        table = [animation.weights.get(name, rest) for name, rest in pairs]
        add(face, "weights", np.stack(table, axis=1).ravel())
    if animation.head is not None:
        add(head, "rotation", quaternions(animation.head))
    document.add("animations", name=animation.name, channels=channels, samplers=samplers)


def quaternions(angles: Float64) -> Float64:
    """(T, 4) unit quaternions x, y, z, w of (T, 3) yaw, pitch and roll, radians.

    A quaternion and its negative are the same rotation; of the two, each is the one nearer to that
    before it, so that no reader goes the long way round.
    """
    sy, sx, sz = np.sin(0.5 * angles).T
    cy, cx, cz = np.cos(0.5 * angles).T
    result = np.stack(
        [
            cy * sx * cz + sy * cx * sz,
            sy * cx * cz - cy * sx * sz,
            cy * cx * sz - sy * sx * cz,
            cy * cx * cz + sy * sx * sz,
        ],
        axis=1,
    )
    result /= np.linalg.norm(result, axis=1, keepdims=True)
    apart = np.einsum("ij,ij->i", result[1:], result[:-1]) < 0.0
    result[1:] *= np.where(np.cumsum(apart) % 2, -1.0, 1.0)[:, np.newaxis]
    return result


def _times(value: ArrayLike) -> Float64:
    times = _numbers(value, "times", None)
    if times.ndim != 1 or not len(times) or times[0] < 0:
        raise InputError(
            "times of an animation need shape (samples,), one or more, from 0 seconds on, got "
            f"shape {times.shape}{f' from {times.flat[0]:g}' if times.size else ''}"
        )
    stuck = np.flatnonzero(np.diff(times.astype(np.float32)) <= 0)
    if len(stuck):
        sample = int(stuck[0]) + 1
        raise InputError(
            f"times of an animation must increase, in single precision, got {times[sample]!r} "
            f"after {times[sample - 1]!r} at sample {sample}; leave samples out or begin at 0"
        )
    return times


def _weights(name: str, value: ArrayLike, count: int) -> Float64:
    if name not in ARKIT:
        near = difflib.get_close_matches(str(name), ARKIT, n=3, cutoff=0.5)
        hint = f"did you mean {', '.join(near)}?" if near else "see pdeface.controls.ARKIT"
        raise InputError(f"no expression is called {name!r}; {hint}")
    weights = _numbers(value, name, (count,))
    wrong = np.flatnonzero((weights < 0) | (weights > 1))
    if len(wrong):
        raise InputError(
            f"weights lie within 0 and 1, got {weights[wrong[0]]:g} for {name} at sample "
            f"{wrong[0]}; clamp it"
        )
    return weights


def _numbers(value: ArrayLike, what: str, shape: tuple[int, ...] | None) -> Float64:
    """A read-only copy, finite and of this shape."""
    try:
        array = np.array(value, dtype=np.float64)
    except (TypeError, ValueError) as error:
        raise InputError(f"{what} of an animation must be an array of numbers") from error
    if shape is not None and array.shape != shape:
        raise InputError(
            f"{what} of an animation of {shape[0]} samples needs shape {shape}, got {array.shape}"
        )
    if not np.isfinite(array).all():
        raise InputError(f"{what} of an animation must be finite; remove or replace what is not")
    array.setflags(write=False)
    return array
