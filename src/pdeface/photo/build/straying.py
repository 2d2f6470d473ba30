"""Random heads that are no mixture of those that were measured.

What is learnt from mixtures of one set of heads trusts whatever tells these apart. Real heads are
no such mixture, so most of the heads that are learnt from are bent: every point of space is moved
by a random field that is smooth at several lengths, and mostly alike on both sides. The identity
that is then to be found is of the mixture that comes nearest to the bent face.

Nor does everybody smile alike: what an expression moves is moved more here and less there.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from pdeface.controls.measured import IDENTITIES
from pdeface.photo.build.heads import Head, HeadSpace
from pdeface.photo.mirrors import ACROSS

__all__ = ["FACE", "MIXTURE", "Nearest", "bend", "vary"]

FloatArray = NDArray[np.float64]

MIXTURE = 0.8
"""Standard deviation of the weights of a head before it is bent: bending adds to them."""

_FIELDS = ((0.06, 2.0e-3), (0.03, 1.2e-3), (0.015, 0.6e-3))
"""Lengths over which the fields vary, and standard deviations on an axis, metres."""

_STRONGEST, _ONE_SIDED = 1.3, 0.3
_WAVES = 24
_NOISE, _POINTS = 0.7e-3, 100
"""What the nearest mixture is expected to be off by, metres, at so many independent points."""

_VARIED, _ACROSS = 0.25, 0.04
"""Standard deviation of how much an expression moves, and the length over which it differs."""

FACE = 0.93, 1.2
"""The part of the head that counts as its face: u up to here, and as far from the midline in v,
radians."""


def bend(rng: np.random.Generator, vertices: FloatArray) -> FloatArray:
    """(V, 3) displacements of a head's vertices, metres, strong or hardly any."""
    strength = rng.uniform(0.0, _STRONGEST)
    moved = np.zeros_like(vertices)
    for length, size in _FIELDS:
        waves = rng.normal(0.0, 1.0 / length, (_WAVES, 3))
        phases = rng.uniform(0.0, 2.0 * np.pi, _WAVES)
        sizes = rng.normal(0.0, strength * size * np.sqrt(2.0 / _WAVES), (_WAVES, 3))
        one, other = (np.cos(x @ waves.T + phases) @ sizes for x in (vertices, vertices * ACROSS))
        even, odd = one + other * ACROSS, one - other * ACROSS
        moved += (even + _ONE_SIDED * odd) / np.sqrt(2.0)
    return moved


def vary(rng: np.random.Generator, vertices: FloatArray, displacement: FloatArray) -> FloatArray:
    """(V, 3) an expression's displacement of vertices as one person has it."""
    waves = rng.normal(0.0, 1.0 / _ACROSS, (_WAVES, 3))
    phases = rng.uniform(0.0, 2.0 * np.pi, _WAVES)
    sizes = rng.normal(0.0, _VARIED * np.sqrt(2.0 / _WAVES), (_WAVES, 3))
    return np.asarray(displacement * (1.0 + np.cos(vertices @ waves.T + phases) @ sizes))


class Nearest:
    """Weights of the identity modes that come nearest to a displacement of a head.

    By least squares over the face, with weights that are expected to be about 1 and a rest of
    which some is expected to stay; a head's size and place do not count.

    Args:
        space: the heads.
    """

    def __init__(self, space: HeadSpace) -> None:
        self._face = _face(space.neutral)
        places = space.neutral.vertices[self._face]
        middle = places - places.mean(axis=0)
        modes = [space.head(mode).vertices - space.neutral.vertices
                 for mode in np.eye(space.modes)[:IDENTITIES]]  # fmt: skip
        turns = [np.cross(axis, middle) for axis in np.eye(3)]
        shifts = [np.broadcast_to(axis, middle.shape) for axis in np.eye(3)]
        ways = [*(m[self._face] for m in modes), *(w / 0.05 for w in (middle, *turns)), *shifts]
        self._ways = np.array(ways).reshape(len(ways), -1)
        cost = np.zeros(len(ways))
        cost[:IDENTITIES] = len(places) / _POINTS * _NOISE**2
        self._gram = self._ways @ self._ways.T
        self._cost = np.diag(cost + 1e-12)

    def __call__(self, displacement: FloatArray) -> FloatArray:
        """(50,) weights for (V, 3) displacements of the neutral head, metres."""
        products = self._ways @ displacement[self._face].ravel()
        return np.asarray(np.linalg.solve(self._gram + self._cost, products)[:IDENTITIES])


def _face(head: Head) -> NDArray[np.int64]:
    """The vertices of a head's face."""
    u, v = head.texcoords[:, 1], np.pi * head.texcoords[:, 0]
    face = (u > 0.0) & (u < FACE[0]) & (v > 0.0) & (np.abs(v - np.pi / 2) < FACE[1])
    return np.intersect1d(np.flatnonzero(face), np.unique(head.skin))
