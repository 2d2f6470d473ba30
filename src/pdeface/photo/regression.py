"""Which person landmarks most likely belong to, learnt from pictures of heads that are known.

The landmarks, with their depths, are turned, scaled and moved onto the mean of all faces. The
principal ways in which they then differ from it, the same by how far the head is turned, the pose,
the detector's scores and, where the focal length is known, how near the camera is, are mapped to
weights of the identity modes by a ridge regression, together with the values of an inner layer of
the detector's network (:mod:`pdeface.photo.traits`). What the detector gets wrong in the same way
every time is so taken out, and what it cannot see is left at the mean. The numbers in
``data/identity.npz`` were learnt by ``python -m pdeface.photo.build identity``.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from pdeface.controls import CONTROLS
from pdeface.photo.found import PhotoFace

__all__ = [
    "IDENTITY",
    "Learnt",
    "expected_identity",
    "features",
    "levelled",
    "regressors",
    "score_names",
]

FloatArray = NDArray[np.float64]

IDENTITY = Path(__file__).parent / "data" / "identity.npz"

_FLIP = (1.0, -1.0, -1.0)
"""From a photo's axes (right, down, away) to a head's (left, up, towards the camera)."""

_UNSEEN = "tongueOut"

_STRANGE = 0.05
"""Variance of a weight by which a person's photos, all alike, are off besides: photos are not the
pictures that were learnt from, and how these agree was measured on few people. By heads kept out,
MakeHuman's as much as others."""

_POSED, _POSES = 60, (0, 1, 2)
"""How many ways count differently by pose, and which features say so: yaw, pitch, yaw squared."""


class Learnt(NamedTuple):
    """What was learnt.

    Attributes:
        mean: (478, 3) the mean of all faces' landmarks, of size 1 about their middle.
        modes: (k, 1434) principal ways in which they differ, each over its standard deviation.
        centre, spread: (f,) mean and standard deviation of the other features: six of the pose,
            the scores by name, and how near the camera is.
        readout: (2, 2, r, 50) the identity by the regressors (:func:`regressors`): alone and beside
            the traits, without and with the focal length.
        variance: (2, 50, 50) covariance of the identity that is read out of one photo, alone and
            beside the traits.
        common: (2, 50, 50) the same between what is read out of two photos of one person.
    """

    mean: FloatArray
    modes: FloatArray
    centre: FloatArray
    spread: FloatArray
    readout: FloatArray
    variance: FloatArray
    common: FloatArray


@lru_cache(maxsize=1)
def learnt() -> Learnt:
    """What ships with the package."""
    with np.load(IDENTITY, allow_pickle=False) as file:
        return Learnt(*(file[name].astype(np.float64) for name in Learnt._fields))


def expected_identity(faces: Sequence[PhotoFace], focals: Sequence[float | None]) -> FloatArray:
    """(50,) weights of the identity modes that are expected of a person.

    Each photo says r = W x of its features x, and t more by its traits if all have some. Of n
    photos the mean m is taken; the person expected then is V (V / n + (1 - 1 / n) C + q)^-1 m with
    the covariance V of what one photo says, C of what two say, and q for what was never learnt: the
    more photos agree, the less is left at the mean.

    Args:
        faces: one person's, in one or more photos.
        focals: the focal length of each photo in pixels, or None.
    """
    known, read = learnt(), []
    beside = int(all(face.traits is not None for face in faces))
    for face, focal in zip(faces, focals, strict=True):
        shape, rest = features(face, focal, known.mean)
        ways = known.modes @ shape
        others = (rest - known.centre) / known.spread
        if focal is None:
            others[-1] = 0.0
        told = regressors(ways, others) @ known.readout[beside, int(focal is not None)]
        read.append(told if face.traits is None or not beside else told + face.traits)
    share = 1.0 / len(read)
    variance, common = known.variance[beside], known.common[beside]
    sure = share * variance + (1.0 - share) * common + _STRANGE * np.eye(len(variance))
    return np.asarray(variance @ np.linalg.solve(sure, np.mean(read, axis=0)))


def regressors(ways: FloatArray, others: FloatArray) -> FloatArray:
    """(..., r) what the identity is linear in: 1, all features, and ways by pose.

    Args:
        ways: (..., k) how far the landmarks differ in each principal way.
        others: (..., f) the other features, standardised.
    """
    one = np.ones((*ways.shape[:-1], 1))
    posed = [ways[..., :_POSED] * others[..., at, None] for at in _POSES]
    return np.concatenate([one, ways, others, *posed], axis=-1)


def features(
    face: PhotoFace, focal: float | None, mean: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """(1434,) how the levelled landmarks differ from their mean, and (f,) the other features."""
    marks, turn, size = levelled(face.landmarks * _FLIP, mean)
    yaw = float(np.arctan2(turn[2, 0], turn[2, 2]))
    pitch = float(np.arcsin(np.clip(-turn[2, 1], -1.0, 1.0)))
    pose = (yaw, pitch, yaw**2, pitch**2, yaw * pitch, abs(yaw))
    scores = [face.scores.get(name, 0.0) for name in score_names()]
    near = size / focal if focal else 0.0
    return (marks - mean).ravel(), np.array([*pose, *scores, near])


def levelled(marks: FloatArray, mean: FloatArray) -> tuple[FloatArray, FloatArray, float]:
    """Landmarks by the similarity that brings them nearest to the mean.

    Args:
        marks: (n, 3) right, up, towards the camera.
        mean: (n, 3).

    Returns:
        (n, 3) landmarks, (3, 3) the rotation that was applied from the right, and their size.
    """
    middle = marks - marks.mean(axis=0)
    left, sizes, right = np.linalg.svd(middle.T @ mean)
    sizes[2] *= np.sign(np.linalg.det(left @ right))
    left[:, 2] *= np.sign(np.linalg.det(left @ right))
    turn = left @ right
    scale = float(sizes.sum() / (middle**2).sum())
    return scale * middle @ turn, turn, 1.0 / scale


@lru_cache(maxsize=1)
def score_names() -> tuple[str, ...]:
    """Those that the detector has: it does not look for the tongue."""
    return tuple(sorted(n for n, c in CONTROLS.items() if c.kind == "expression" and n != _UNSEEN))
