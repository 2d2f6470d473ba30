"""The shape of a photo's person: camera, identity and expression from the landmarks."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from pdeface.controls import CONTROLS
from pdeface.face import neutral
from pdeface.photo.anchors import anchors
from pdeface.photo.camera import PARAMETERS, PhotoCamera
from pdeface.photo.found import PhotoFace

__all__ = ["PhotoShape", "fit_shape"]

FloatArray = NDArray[np.float64]

_MESH_LANDMARKS = 468  # the irises' five each, after these, move with the gaze
_DOUBT = 4.0
"""What the landmarks' spread is multiplied by: they err together, in much fewer ways than 468."""

_EXPRESSION_SPREAD = 0.3
"""Standard deviation of an expression from the detector's score for it."""

_OUTLIER = 2.5
"""Standard deviations from which on a landmark loses weight."""

_MOST, _ROUNDS = 3.0, 12


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
    weighed down if it is an outlier (Cauchy's weights), with identity weights that are normally
    distributed, and expressions about those that the detector names. Gauss and Newton's method,
    weights kept in their ranges.

    Args:
        face: found in a photo.
    """
    basis = _basis()
    target = face.landmarks[:_MESH_LANDMARKS, :2]
    sigma = _DOUBT * anchors().spread[:_MESH_LANDMARKS] * face.eye_distance
    mean, spread, low, high = _priors(basis, face)
    camera, values = _first_camera(face, basis), np.clip(mean, low, high)
    for _ in range(_ROUNDS):
        points = basis.at(values)
        off = (target - camera.project(points)) / sigma[:, None]
        slopes = np.concatenate([camera.own_moves(points), camera.moves(points, basis.moves)])
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
    away = np.linalg.norm(target - camera.project(basis.at(values)), axis=1)
    weights = list(zip(basis.names, values.tolist(), strict=True))
    return PhotoShape(
        identity=dict(weights[: basis.identities]),
        expression=dict(weights[basis.identities :]),
        camera=camera,
        error=float(np.sqrt((away**2).mean()) / face.eye_distance),
    )


def _priors(basis: _Basis, face: PhotoFace) -> tuple[FloatArray, ...]:
    """Mean, standard deviation, lowest and highest value of each control."""
    expressions = basis.names[basis.identities :]
    scores = np.array([face.scores.get(name, 0.0) for name in expressions])
    ones, nothing = np.ones(basis.identities), np.zeros(basis.identities)
    return (
        np.concatenate([nothing, scores]),
        np.concatenate([ones, np.full(len(scores), _EXPRESSION_SPREAD)]),
        np.concatenate([-_MOST * ones, np.zeros(len(scores))]),
        np.concatenate([_MOST * ones, np.ones(len(scores))]),
    )


def _first_camera(face: PhotoFace, basis: _Basis) -> PhotoCamera:
    """The camera by MediaPipe's pose, scaled and shifted onto the landmarks."""
    left, _, right = np.linalg.svd(face.pose[:3, :3])
    camera = PhotoCamera(left @ right, 1.0, np.zeros(2))
    seen, target = camera.project(basis.neutral), face.landmarks[:_MESH_LANDMARKS, :2]
    middles = seen.mean(axis=0), target.mean(axis=0)
    scale = float(np.linalg.norm(target - middles[1]) / np.linalg.norm(seen - middles[0]))
    return PhotoCamera(left @ right, scale, middles[1] - scale * middles[0])
