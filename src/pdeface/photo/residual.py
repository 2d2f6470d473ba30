"""What landmarks still differ by, as a smooth displacement of the curves.

Before the photos are seen, a displacement of the curves' points is a Gaussian process: alike in
neighbours, mostly along the surface, little out of it, and none at the edge of the face. The
surface is linear in the points and, for small displacements, the photo in the surface; so the
displacement that is expected once the landmarks are known is linear in what they are off by.
Along the surface it moves features to where the photos show them, and leaves the shape alone;
one view says little of what is out of it.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from pdeface.curves import curve_parameters, mirror_points
from pdeface.face import Face, neutral
from pdeface.pde import GridEvaluator
from pdeface.pde.scattered import point_weights
from pdeface.photo.anchors import anchors
from pdeface.photo.camera import PARAMETERS
from pdeface.photo.fitting import MESH_LANDMARKS, Fit, basis
from pdeface.photo.found import PhotoFace
from pdeface.photo.unfolding import unfolded

__all__ = ["FACING", "at_level", "curve_residual", "facing"]

FloatArray = NDArray[np.float64]

_ALONG, _OUT = 3.0e-3, 0.1e-3
"""Standard deviation of a displacement along the surface and out of it, metres."""

_LENGTH = 0.017
"""Over which it varies, metres."""

_NOISE = 0.005
"""Of a landmark that is fully believed and faces the camera, eye distances."""

FACING = 0.26
"""Cosine to the direction of the camera above which a landmark faces it: within 75 degrees."""

_CAMERA = 0.05
"""Standard deviation of a camera's turn, radians, of its scale and, in eye distances, shift."""

_EXPRESSION = 0.1
"""Standard deviation of an expression from what was fitted without the displacement."""

_ROUNDS = 6
"""How often what reaches the end of its range is left there, and the rest solved anew."""

_END, _EDGE = 0.15, 0.5
"""Over so much of u, and so many radians of v, displacements fade out towards the face's edge."""

_SEVEN = [33, 133, 362, 263, 2, 61, 291]
"""Corners of the eyes, the base of the nose, and corners of the mouth."""

_GROWTH = 0.5e-3
"""Standard deviation of how much larger these become together, beside 1."""


def curve_residual(
    face: Face, views: Sequence[tuple[PhotoFace, Fit]]
) -> tuple[FloatArray, list[Fit]]:
    """(K, M, 3) displacement of the curves of a person at rest, metres, and the views refitted.

    The cameras and the expressions may change a little with it, so that what one of them is off by
    is no displacement.

    Args:
        face: the person at rest, without it.
        views: the person's faces in photos, and what was fitted to each.
    """
    prior, parts = _prior_root(), []
    owns = np.zeros((0, 0))
    for found, fit in views:
        eye = found.eye_distance
        off = found.landmarks[:MESH_LANDMARKS, :2] - fit.camera.project(fit.points)
        seen = np.maximum(facing(face, fit), _NOISE) ** 2 * np.sqrt(fit.weight)
        owns = _side_by_side(owns, _own_slopes(found, fit) / eye)
        parts.append((_slopes(face, fit) / eye, off.ravel() / eye, _NOISE / np.repeat(seen, 2)))
    rows, off, noise = (np.concatenate(part) for part in zip(*parts, strict=True))
    slopes = np.hstack([rows @ prior, owns])
    grown = np.pad(_growth(face) @ prior, (0, owns.shape[1]))
    slopes, off, noise = np.vstack([slopes, grown]), np.append(off, 0.0), np.append(noise, _GROWTH)
    modes = prior.shape[1]
    room = np.hstack([_unbounded(modes), *(_room(fit) for _, fit in views)])
    best = _expected(slopes, off, noise, room)
    steps = best[modes:].reshape(len(views), -1)
    refitted = [_stepped(*view, step) for view, step in zip(views, steps, strict=True)]
    return unfolded(face, prior @ best[:modes]), refitted


def _expected(
    slopes: FloatArray, off: FloatArray, noise: FloatArray, room: FloatArray
) -> FloatArray:
    """(m,) the expectation of standard normal amounts.

    Those that would leave their room, (2, m) lowest and highest, stay at its end.
    """
    count = slopes.shape[1]
    amounts, free = np.zeros(count), np.ones(count, dtype=bool)
    weighed = slopes.T / noise**2
    normal, pull = weighed @ slopes + np.eye(count), weighed @ off
    for _ in range(_ROUNDS):
        left = pull[free] - normal[np.ix_(free, ~free)] @ amounts[~free]
        amounts[free] = np.linalg.solve(normal[np.ix_(free, free)], left)
        inside = np.clip(amounts, *room)
        beyond = free & (inside != amounts)
        amounts, free = inside, free & ~beyond
        if not beyond.any():
            break
    return amounts


def _own_slopes(found: PhotoFace, fit: Fit) -> FloatArray:
    """(936, 6 + n) derivatives of pixels by what is a photo's own, over its standard deviation."""
    camera = fit.camera.own_moves(fit.points) * _camera_sizes(found)[:, None, None]
    expression = _EXPRESSION * fit.camera.moves(fit.points, basis().expressions)
    return np.concatenate([camera, expression]).reshape(-1, 2 * MESH_LANDMARKS).T


def _unbounded(count: int) -> FloatArray:
    """(2, count) room without end."""
    return np.outer([-np.inf, np.inf], np.ones(count))


def _room(fit: Fit) -> FloatArray:
    """(2, 6 + n) how far down and up these may change, standard deviations."""
    ends = np.array([0.0, 1.0])[:, None] - fit.expression
    return np.hstack([_unbounded(PARAMETERS), ends / _EXPRESSION])


def _stepped(found: PhotoFace, fit: Fit, step: FloatArray) -> Fit:
    camera = fit.camera.stepped(step[:PARAMETERS] * _camera_sizes(found))
    expression = np.clip(fit.expression + _EXPRESSION * step[PARAMETERS:], 0.0, 1.0)
    points = fit.points + np.tensordot(expression - fit.expression, basis().expressions, 1)
    return replace(fit, camera=camera, expression=expression, points=points)


def _growth(face: Face) -> FloatArray:
    """(3 K M / 2,) derivative of the size of the seven landmarks together, beside 1.

    How large the features are beside the face, the regression has learnt better than one photo's
    landmarks show it; what these are off by in size is the camera's.
    """
    points = face.surface()(*anchors().uv[_SEVEN].T)
    middle = points - points.mean(axis=0)
    by = np.einsum("na,anh->ha", middle, _weights(face.curves.shape)[:, _SEVEN])
    return np.asarray(by.ravel() / (middle**2).sum())


def _camera_sizes(found: PhotoFace) -> FloatArray:
    """(6,) standard deviation of each of a camera's parameters."""
    return _CAMERA * np.array([1.0, 1.0, 1.0, 1.0, found.eye_distance, found.eye_distance])


def _side_by_side(one: FloatArray, other: FloatArray) -> FloatArray:
    """The two as blocks on a diagonal."""
    result = np.zeros(np.add(one.shape, other.shape))
    result[: len(one), : one.shape[1]] = one
    result[len(one) :, one.shape[1] :] = other
    return result


def facing(face: Face, fit: Fit) -> FloatArray:
    """(468,) cosine between a landmark's normal and the direction to the camera.

    Where it is 0 and less, the landmark lies on the outline or behind it, and what is found in the
    photo is the outline, or a guess.
    """
    camera = fit.camera
    eye = camera.distance * camera.rotation[2]
    towards = eye - fit.points
    normal = face.surface().normal(*anchors().uv[:MESH_LANDMARKS].T)
    return np.einsum("ni,ni->n", normal, towards) / np.linalg.norm(towards, axis=1)


def at_level(residual: FloatArray, shape: tuple[int, int]) -> FloatArray:
    """The displacement for curves of another number, read off its own surface."""
    if residual.shape[:2] == shape:
        return residual
    curves, count = shape
    u, v = np.linspace(0.0, 1.0, curves), curve_parameters(count)[: count // 2]
    own = residual.shape[0], residual.shape[1]
    half = GridEvaluator(own, u, v).positions(residual)
    return mirror_points(np.asarray(half, dtype=np.float64))


def _slopes(face: Face, fit: Fit) -> FloatArray:
    """(936, 3 K M / 2) derivatives of the landmarks' pixels by the front halves of the curves."""
    axes = np.broadcast_to(np.eye(3)[:, None], (3, MESH_LANDMARKS, 3))
    by_axis = fit.camera.moves(fit.points, axes)[..., None]
    weights = _weights(face.curves.shape)[:, :, None]
    slopes = np.stack([by * weight for by, weight in zip(by_axis, weights, strict=True)], axis=-1)
    return slopes.reshape(2 * MESH_LANDMARKS, -1)


@lru_cache(maxsize=2)
def _weights(shape: tuple[int, int]) -> FloatArray:
    """(3, n, K M / 2) weights of the front halves' points in each axis of the landmarks."""
    u, v = anchors().uv[:MESH_LANDMARKS].T
    weights = point_weights(shape, u, v).reshape(len(u), *shape)
    half = shape[1] // 2
    front, back = weights[:, :, :half], weights[:, :, half:][:, :, ::-1]
    both, across = ((front + sign * back).reshape(len(u), -1) for sign in (1.0, -1.0))
    return np.stack([both, both, across])


@lru_cache(maxsize=1)
def _prior_root() -> FloatArray:
    """(3 K M / 2, m) a root of the covariance of the front halves' displacement.

    That of the neutral face: another person's hardly differs.
    """
    face = neutral()
    curves, count = face.curves.shape
    half = count // 2
    v = curve_parameters(count)[:half]
    u = np.linspace(0.0, 1.0, curves)
    points = face.curves.points[:, :half].reshape(-1, 3)
    normal = face.surface().normal(*(x.ravel() for x in np.meshgrid(u, v, indexing="ij")))
    values, ways = np.linalg.eigh(_alike(points))
    keep = values > 1e-3 * values[-1]
    root = ways[:, keep] * np.sqrt(values[keep])
    fade = np.outer(_fade(u, 1.0, _END), _fade(v, np.pi, _EDGE)).reshape(-1, 1, 1, 1)[:, 0]
    out = normal[:, :, None] * normal[:, None, :]
    sizes = fade * (_ALONG * (np.eye(3) - out) + _OUT * out)
    return np.asarray(np.einsum("pab,pm->pamb", sizes, root).reshape(3 * len(points), -1))


def _alike(points: FloatArray) -> FloatArray:
    """(n, n) correlations, by a Gaussian of the distance."""
    square = (points**2).sum(axis=1)
    apart = square[:, None] + square - 2.0 * points @ points.T
    return np.asarray(np.exp(-0.5 * np.maximum(apart, 0.0) / _LENGTH**2))


def _fade(at: FloatArray, end: float, reach: float) -> FloatArray:
    """0 at 0 and at the end, 1 from ``reach`` on."""
    away = np.clip(np.minimum(at, end - at) / reach, 0.0, 1.0)
    return np.asarray(away**2 * (3.0 - 2.0 * away))
