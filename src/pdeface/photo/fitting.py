"""Camera and expression of a face whose identity is given, from its landmarks."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from pdeface.controls import CONTROLS, slits
from pdeface.face import neutral
from pdeface.pde.scattered import point_weights
from pdeface.photo.anchors import anchors
from pdeface.photo.camera import PARAMETERS, PhotoCamera
from pdeface.photo.found import PhotoFace

__all__ = ["MESH_LANDMARKS", "Basis", "Fit", "basis", "fit_view"]

FloatArray = NDArray[np.float64]

MESH_LANDMARKS = 468
"""The irises' five each, after these, move with the gaze."""

_DOUBT = 6.0
"""What the landmarks' own spread is multiplied by: photos differ more than the pictures did."""

_EXPRESSION_SPREAD = 0.3
"""Standard deviation of an expression from the detector's score for it."""

_OUTLIER = 2.5
"""Standard deviations from which on a landmark loses weight."""

_ERRORS, _MOST_ERROR = 1.0, 5.0
"""Standard deviation of the modes in which they err together, of those in the pictures, and the
most of one."""

_ROUNDS = 12
_NEAREST = 0.2
"""Metres to the camera, at least."""


@dataclass(frozen=True, eq=False)
class Basis:
    """Where the landmarks are on the face, and how controls move them.

    Attributes:
        names: of the identity modes, then of the expressions.
        identities: how many modes there are.
        neutral: (n, 3) metres.
        moves: (controls, n, 3) metres.
    """

    names: tuple[str, ...]
    identities: int
    neutral: FloatArray
    moves: FloatArray

    @property
    def expressions(self) -> FloatArray:
        """(expressions, n, 3) the moves of these alone."""
        return self.moves[self.identities :]


@dataclass(frozen=True, eq=False)
class Fit:
    """What a view of a known person shows.

    Attributes:
        camera: the camera.
        expression: (n,) values of the expressions.
        points: (468, 3) where the landmarks are on the face, metres.
        weight: (468,) how far each is believed, 0 to 1.
    """

    camera: PhotoCamera
    expression: FloatArray
    points: FloatArray
    weight: FloatArray


@lru_cache(maxsize=1)
def basis() -> Basis:
    """The landmarks' places on the neutral face, and their displacements by its controls."""
    face = neutral()
    shape, places = face.curves.shape, anchors().uv[:MESH_LANDMARKS].T
    kinds = {k: [n for n, c in CONTROLS.items() if c.kind == k] for k in ("identity", "expression")}
    names = (*kinds["identity"], *kinds["expression"])
    smooth, slit = (point_weights(shape, *places, continuity=c) for c in ({}, slits(shape[0])))
    by = [face.with_weights({name: 1.0}).displacement for name in names]
    moves = [smooth @ d.smooth.reshape(-1, 3) + slit @ d.parting.reshape(-1, 3) for d in by]
    middle = smooth @ face.curves.points.reshape(-1, 3)
    return Basis(names, len(kinds["identity"]), middle, np.array(moves))


def fit_view(face: PhotoFace, rest: FloatArray, focal: float | None = None) -> Fit:
    """Camera and expression that explain the landmarks best.

    Least squares on the distances in the photo, each divided by what is usual for its landmark and
    weighed down if it is an outlier (Cauchy's weights). Expressions are expected to be about those
    that the detector names, and the landmarks to err together in the ways in which they did in
    pictures of known heads. Gauss and Newton's method, all values kept in their ranges.

    Args:
        face: found in a photo.
        rest: (468, 3) where the landmarks are on the person at rest, metres.
        focal: focal length in pixels; None if it is not known: then the camera is 1 m away.
    """
    moves = basis().expressions
    target, errors = face.landmarks[:MESH_LANDMARKS, :2], _errors(face)
    sigma = _DOUBT * anchors().spread[:MESH_LANDMARKS] * face.eye_distance
    mean, spread, low, high = _priors(face)
    camera, values = _first_camera(face, rest), mean
    expressions, weight = len(moves), np.ones(len(rest))
    for _ in range(_ROUNDS):
        if focal is not None:
            camera = replace(camera, distance=max(focal / camera.scale, _NEAREST))
        points = rest + np.tensordot(values[:expressions], moves, 1)
        found = camera.project(points) + np.tensordot(values[expressions:], errors, 1)
        off = (target - found) / sigma[:, None]
        slopes = np.concatenate([camera.own_moves(points), camera.moves(points, moves), errors])
        slopes = (slopes / sigma[:, None]).reshape(len(slopes), -1)
        weight = 1.0 / (1.0 + (off**2).sum(axis=1) / _OUTLIER**2)
        weighed = slopes * np.repeat(weight, 2)
        stiffness, pull = np.zeros((2, len(slopes)))
        stiffness[PARAMETERS:] = 1.0 / spread**2
        pull[PARAMETERS:] = (mean - values) / spread**2
        step = np.linalg.solve(
            weighed @ slopes.T + np.diag(stiffness), weighed @ off.ravel() + pull
        )
        camera = camera.stepped(step[:PARAMETERS])
        values = np.clip(values + step[PARAMETERS:], low, high)
    points = rest + np.tensordot(values[:expressions], moves, 1)
    return Fit(camera, values[:expressions], points, weight)


def _priors(face: PhotoFace) -> tuple[FloatArray, ...]:
    """Mean, standard deviation, lowest and highest value of each expression and error."""
    names = basis().names[basis().identities :]
    scores = np.array([face.scores.get(name, 0.0) for name in names])
    one, error = np.ones(len(scores)), np.ones(len(anchors().modes))
    return (
        np.concatenate([scores, 0.0 * error]),
        np.concatenate([_EXPRESSION_SPREAD * one, _ERRORS * error]),
        np.concatenate([0.0 * one, -_MOST_ERROR * error]),
        np.concatenate([one, _MOST_ERROR * error]),
    )


def _errors(face: PhotoFace) -> FloatArray:
    """(modes, n, 2) how the landmarks err together, in pixels of the photo."""
    x, y = face.across * face.eye_distance
    level = anchors().modes[:, :MESH_LANDMARKS]
    return np.stack([level @ (x, -y), level @ (y, x)], axis=-1)


def _first_camera(face: PhotoFace, rest: FloatArray) -> PhotoCamera:
    """The camera by MediaPipe's pose, scaled and shifted onto the landmarks."""
    left, _, right = np.linalg.svd(face.pose[:3, :3])
    camera = PhotoCamera(left @ right, 1.0, np.zeros(2))
    seen, target = camera.project(rest), face.landmarks[:MESH_LANDMARKS, :2]
    middles = seen.mean(axis=0), target.mean(axis=0)
    scale = float(np.linalg.norm(target - middles[1]) / np.linalg.norm(seen - middles[0]))
    return PhotoCamera(left @ right, scale, middles[1] - scale * middles[0])
