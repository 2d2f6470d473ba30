"""The shape of a photo's person: camera, identity and expression from the landmarks."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from pdeface.controls import CONTROLS
from pdeface.face import Face, neutral
from pdeface.photo.anchors import anchors
from pdeface.photo.camera import PARAMETERS, PhotoCamera
from pdeface.photo.found import PhotoFace

__all__ = ["PhotoShape", "fit_shape"]

FloatArray = NDArray[np.float64]

_MESH_LANDMARKS = 468  # the irises' five each, after these, move with the gaze
_DOUBT = 6.0
"""What the landmarks' own spread is multiplied by: photos differ more than the pictures did."""

_EXPRESSION_SPREAD = 0.3
"""Standard deviation of an expression from the detector's score for it."""

_OUTLIER = 2.5
"""Standard deviations from which on a landmark loses weight."""

_ERRORS = 1.0
"""Standard deviations of the modes in which they err together, of those in the pictures."""

_MOST, _MOST_ERROR, _ROUNDS = 3.0, 5.0, 12


@dataclass(frozen=True, eq=False)
class PhotoShape:
    """What the landmarks say of a face.

    Attributes:
        identity: weights of the identity modes by name, standard deviations.
        expression: weights of the expressions that the photo shows, by name.
        camera: the camera that took it.
        error: root mean square distance of the landmarks from where the fitted face has them,
            in eye distances.
    """

    identity: dict[str, float]
    expression: dict[str, float]
    camera: PhotoCamera
    error: float

    @property
    def face(self) -> Face:
        """The person at rest, with the neutral face's curves."""
        return neutral().with_weights(self.identity)


@dataclass(frozen=True, eq=False)
class _Basis:
    """Where the landmarks are on the face, and how controls move them."""

    names: tuple[str, ...]
    identities: int
    neutral: FloatArray  # (n, 3)
    moves: FloatArray  # (controls, n, 3)

    def at(self, values: FloatArray) -> FloatArray:
        """(n, 3) points of the face with these values of the controls."""
        return np.asarray(self.neutral + np.tensordot(values, self.moves, 1))


@lru_cache(maxsize=1)
def _basis() -> _Basis:
    face = neutral()
    u, v = anchors().uv[:_MESH_LANDMARKS].T
    kinds = {k: [n for n, c in CONTROLS.items() if c.kind == k] for k in ("identity", "expression")}
    names = (*kinds["identity"], *kinds["expression"])
    middle = face.surface()(u, v)
    moved = np.array([face.with_weights({name: 1.0}).surface()(u, v) for name in names])
    return _Basis(names, len(kinds["identity"]), middle, moved - middle)


def fit_shape(face: PhotoFace) -> PhotoShape:
    """Camera, identity and expression that explain the landmarks best.

    Least squares on the distances in the photo, each divided by what is usual for its landmark and
    weighed down if it is an outlier (Cauchy's weights). Identity weights are expected to be
    normally distributed, expressions to be about those that the detector names, and the landmarks
    to err together in the ways in which they did in pictures of known heads. Gauss and Newton's
    method, all values kept in their ranges.

    Args:
        face: found in a photo.
    """
    basis = _basis()
    target = face.landmarks[:_MESH_LANDMARKS, :2]
    errors = _errors(face)
    sigma = _DOUBT * anchors().spread[:_MESH_LANDMARKS] * face.eye_distance
    mean, spread, low, high = _priors(basis, face)
    camera, values = _first_camera(face, basis), np.clip(mean, low, high)
    controls = len(basis.names)
    for _ in range(_ROUNDS):
        points = basis.at(values[:controls])
        found = camera.project(points) + np.tensordot(values[controls:], errors, 1)
        off = (target - found) / sigma[:, None]
        moves = camera.own_moves(points), camera.moves(points, basis.moves), errors
        slopes = np.concatenate(moves)
        slopes = (slopes / sigma[:, None]).reshape(len(slopes), -1)
        weight = 1.0 / (1.0 + (off**2).sum(axis=1) / _OUTLIER**2)
        weighed = slopes * np.repeat(weight, 2)
        stiffness, pull = np.zeros((2, len(slopes)))
        stiffness[PARAMETERS:] = 1.0 / spread**2
        pull[PARAMETERS:] = (mean - values) / spread**2
        normal = weighed @ slopes.T + np.diag(stiffness)
        step = np.linalg.solve(normal, weighed @ off.ravel() + pull)
        camera = camera.stepped(step[:PARAMETERS])
        values = np.clip(values + step[PARAMETERS:], low, high)
    away = np.linalg.norm(target - camera.project(basis.at(values[:controls])), axis=1)
    weights = list(zip(basis.names, values[:controls].tolist(), strict=True))
    return PhotoShape(
        identity=dict(weights[: basis.identities]),
        expression=dict(weights[basis.identities :]),
        camera=camera,
        error=float(np.sqrt((away**2).mean()) / face.eye_distance),
    )


def _priors(basis: _Basis, face: PhotoFace) -> tuple[FloatArray, ...]:
    """Mean, standard deviation, lowest and highest value of each control and error."""
    expressions = basis.names[basis.identities :]
    scores = np.array([face.scores.get(name, 0.0) for name in expressions])
    one = np.ones(basis.identities), np.ones(len(scores)), np.ones(len(anchors().modes))
    return (
        np.concatenate([0.0 * one[0], scores, 0.0 * one[2]]),
        np.concatenate([one[0], _EXPRESSION_SPREAD * one[1], _ERRORS * one[2]]),
        np.concatenate([-_MOST * one[0], 0.0 * one[1], -_MOST_ERROR * one[2]]),
        np.concatenate([_MOST * one[0], one[1], _MOST_ERROR * one[2]]),
    )


def _errors(face: PhotoFace) -> FloatArray:
    """(modes, n, 2) how the landmarks err together, in pixels of the photo."""
    x, y = face.across * face.eye_distance
    level = anchors().modes[:, :_MESH_LANDMARKS]
    return np.stack([level @ (x, -y), level @ (y, x)], axis=-1)


def _first_camera(face: PhotoFace, basis: _Basis) -> PhotoCamera:
    """The camera by MediaPipe's pose, scaled and shifted onto the landmarks."""
    left, _, right = np.linalg.svd(face.pose[:3, :3])
    camera = PhotoCamera(left @ right, 1.0, np.zeros(2))
    seen, target = camera.project(basis.neutral), face.landmarks[:_MESH_LANDMARKS, :2]
    middles = seen.mean(axis=0), target.mean(axis=0)
    scale = float(np.linalg.norm(target - middles[1]) / np.linalg.norm(seen - middles[0]))
    return PhotoCamera(left @ right, scale, middles[1] - scale * middles[0])
