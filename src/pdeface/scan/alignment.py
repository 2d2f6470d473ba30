"""From landmarks in space to a first face: similarity and identity."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from pdeface.photo.anchors import anchors
from pdeface.scan.model import IDENTITIES, Places, places

__all__ = ["Alignment", "Landmarks", "align", "procrustes", "template_landmarks"]

FloatArray = NDArray[np.float64]

_ROUNDS = 12
_OUTLIER = 2.0
"""Standard deviations from which on a landmark loses weight."""

_PIECE = 90
_NEAR = 6.0e-3
_NOISE = 2.0e-3
"""Usual distance of a found landmark from where the face has it, metres."""


@dataclass(frozen=True, eq=False)
class Landmarks:
    """Landmarks in the scan's frame, and where on the face they lie.

    Attributes:
        uv: (n, 2).
        points: (n, 3) in the scan's frame and unit.
        trust: (n,) inverse variances, 1 for a usual one, 0 for one that is not seen.
    """

    uv: FloatArray
    points: FloatArray
    trust: FloatArray


@dataclass(frozen=True, eq=False)
class Alignment:
    """Where the face is in the scan: ``template = scale * scan @ rotation.T + shift``.

    Attributes:
        weights: (modes,) identity, standard deviations.
        error: root mean square distance of the landmarks, metres.
        inliers: share of the landmarks that are within 6 mm.
    """

    rotation: FloatArray
    scale: float
    shift: FloatArray
    weights: FloatArray
    error: float
    inliers: float

    def apply(self, points: FloatArray) -> FloatArray:
        """Points of the scan in the frame of the template, metres."""
        return np.asarray(self.scale * points @ self.rotation.T + self.shift)


def align(landmarks: Landmarks, scale: float | None = None, *, identity: bool = True) -> Alignment:
    """Similarity and identity that bring the landmarks nearest to the face's.

    Alternates the best similarity with identity weights by ridge regression (a Gaussian prior);
    landmarks far off lose weight (Geman and McClure's weights).

    Args:
        scale: metres to the scan's unit; None to find it with the rest.
        identity: find the person's identity too, not the neutral face's place alone.
    """
    model = template_landmarks(landmarks.uv)
    weights, trust, seen = np.zeros(IDENTITIES), landmarks.trust, landmarks.trust > 0.0
    sigma = _NOISE / np.sqrt(np.where(seen, trust, 1.0))
    for _ in range(_ROUNDS):
        target = model.of(weights)
        rotation, size, shift = procrustes(landmarks.points, target, trust, scale)
        moved = size * landmarks.points @ rotation.T + shift
        off = np.linalg.norm(moved - target, axis=1)
        usual = np.maximum(sigma, 0.5 * np.median(off[seen]))
        robust = 1.0 / (1.0 + (off / (_OUTLIER * usual)) ** 2) ** 2
        trust = robust * landmarks.trust
        if identity:
            weights = _identity(model, moved, np.where(seen, np.sqrt(robust) / sigma, 0.0))
    off = np.linalg.norm(moved - model.of(weights), axis=1)
    error = float(np.sqrt((robust * off**2)[seen].sum() / robust[seen].sum()))
    return Alignment(rotation, size, shift, weights, error, float((seen & (off < _NEAR)).mean()))


def _identity(model: Places, moved: FloatArray, confidence: FloatArray) -> FloatArray:
    system = (model.modes * confidence[:, None]).reshape(IDENTITIES, -1)
    wanted = ((moved - model.neutral) * confidence[:, None]).ravel()
    # Neighbouring landmarks err together: four of them are worth one.
    # In pieces that BLAS does not share out among threads, which would wait for one another.
    pieces = np.array_split(system, -(-system.shape[1] // _PIECE), axis=1)
    normal = 0.25 * np.sum([piece @ piece.T for piece in pieces], axis=0) + np.eye(IDENTITIES)
    return np.asarray(np.linalg.solve(normal, 0.25 * system @ wanted))


def procrustes(
    points: FloatArray, target: FloatArray, trust: FloatArray, scale: float | None = None
) -> tuple[FloatArray, float, FloatArray]:
    """Rotation, scale and shift that bring points nearest to a target (Umeyama 1991)."""
    share = trust / trust.sum()
    middle, goal = share @ points, share @ target
    away, there = points - middle, target - goal
    left, sizes, right = np.linalg.svd((there * share[:, None]).T @ away)
    flip = np.array([1.0, 1.0, np.sign(np.linalg.det(left @ right))])
    rotation = (left * flip) @ right
    if scale is None:
        scale = float((sizes * flip).sum() / (share @ (away**2).sum(axis=1)))
    return rotation, scale, goal - scale * rotation @ middle


@lru_cache(maxsize=8)
def _kept(key: bytes, count: int) -> Places:
    uv = np.frombuffer(key).reshape(count, 2)
    return places(uv[:, 0], uv[:, 1])


def template_landmarks(uv: FloatArray) -> Places:
    """The face at (n, 2) places, worked out once."""
    return _kept(np.ascontiguousarray(uv, np.float64).tobytes(), len(uv))


def detected_uv() -> tuple[FloatArray, FloatArray]:
    """(468, 2) places of MediaPipe's landmarks and (468,) how far each is to be trusted."""
    known = anchors()
    spread = known.spread[:468] / np.median(known.spread[:468])
    return known.uv[:468], 1.0 / spread.clip(0.6, 4.0) ** 2
