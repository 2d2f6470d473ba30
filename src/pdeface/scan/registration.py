"""The face laid onto a scan: identity, then landmarks, then all of the surface, coarse to fine."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pdeface.scan.alignment import Landmarks, template_landmarks
from pdeface.scan.fields import normals
from pdeface.scan.laying import lay, met
from pdeface.scan.model import IDENTITIES, Grid, grid
from pdeface.scan.nearest import Target
from pdeface.scan.surface import Scan
from pdeface.scan.thinning import thinned

__all__ = ["Registered", "register"]

FloatArray = NDArray[np.float64]
OnRound = Callable[[FloatArray], None]

COARSE, FINE = (55, 46), (217, 184)
"""Rows and columns on which identity is found, and on which the surface is laid."""

_BREADTH = 8.0e-3
_ROUNDS = 8
_FIRST_CUTOFF, _LAST_CUTOFF = 12.0e-3, 3.0e-3
_SIGMA = 0.5e-3
"""Metres that a scan usually lies from the identity modes' nearest face."""

_WORTH = 0.05
"""What one sample of the surface counts in the identity: neighbours err together."""

_LANDMARK = 0.02
_COARSE = 4.0e-3
"""Metres between vertices from which on flat triangles would show as facets."""

_MANY, _COARSEST = 100_000, 1.0e-3
"""Vertices from which on identity is found by one of them a cube of so many metres."""


@dataclass(frozen=True, eq=False)
class Registered:
    """The face on a scan.

    Attributes:
        scan: its outside, in the frame of the template.
        rotation, shift: what moved it there from where it was given.
        weights: (modes,) identity.
        points: (U, V, 3) the grid on the scan.
        trust: (U, V) 1 where the scan was met, 0 in holes.
        rounded: whether the curved surface was met that the triangles stand for.
    """

    scan: Scan
    rotation: FloatArray
    shift: FloatArray
    weights: FloatArray
    points: FloatArray
    trust: FloatArray
    rounded: bool


def register(
    scan: Scan,
    landmarks: Landmarks,
    weights: FloatArray,
    *,
    rounded: bool | None = None,
    on_round: OnRound = lambda points: None,
) -> Registered:
    """Lay the face onto a scan.

    Args:
        scan: its outside, in the frame of the template as far as landmarks tell.
        landmarks: in that frame.
        weights: first identity.
        rounded: as for :func:`pdeface.scan.laying.lay`; None for it where triangles are coarse.
        on_round: given the (U, V, 3) face after each round, in the frame of the scan as given.
    """
    target = Target(thinned(scan, _COARSEST) if len(scan.vertices) > _MANY else scan, _BREADTH)
    rotation, shift, weights = identity(target, landmarks, weights, on_round)
    scan = scan.moved(rotation, 1.0, shift)
    points = landmarks.points @ rotation.T + shift
    face = grid(*FINE)
    if rounded is None:
        rounded = not scan.is_cloud and scan.spacing > _COARSE
    marks = Landmarks(landmarks.uv, points, landmarks.trust)

    def back(points: FloatArray) -> None:
        on_round((points - shift) @ rotation)

    laid, trust = lay(face.of(weights), scan, marks, rounded=rounded, on_round=back)
    return Registered(scan, rotation, shift, weights, laid, trust, rounded)


def identity(
    target: Target,
    landmarks: Landmarks,
    weights: FloatArray,
    on_round: OnRound = lambda points: None,
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Rigid motion of the scan and identity weights that bring face and scan together.

    Gauss and Newton's method on distances along the normals to the nearest compatible places
    (robustly, the cutoff annealed) and on the landmarks, with a Gaussian prior.
    """
    face, marks = grid(*COARSE), template_landmarks(landmarks.uv)
    rotation, shift = np.eye(3), np.zeros(3)
    for round_ in range(_ROUNDS):
        share = round_ / (_ROUNDS - 1)
        cutoff = _FIRST_CUTOFF ** (1.0 - share) * _LAST_CUTOFF**share
        points = face.of(weights)
        facing = normals(points).reshape(-1, 3)
        flat = points.reshape(-1, 3)
        found = target.nearest((flat - shift) @ rotation, facing @ rotation)
        there, there_facing = found.points @ rotation.T + shift, found.normals @ rotation.T
        trust = met(found.away, (there_facing * facing).sum(axis=1), cutoff)
        system, off = _plane_rows(face, weights, there, facing, np.sqrt(_WORTH * trust) / _SIGMA)
        own = landmarks.points @ rotation.T + shift
        more, more_off = _mark_rows(marks.modes, marks.of(weights), own, landmarks.trust)
        system, off = np.concatenate([system, more]), np.concatenate([off, more_off])
        normal = system.T @ system
        normal[np.diag_indices(IDENTITIES)] += 1.0
        pull = system.T @ off
        pull[:IDENTITIES] -= weights
        step = np.linalg.solve(normal + 1e-9 * np.eye(len(normal)), pull)
        weights = (weights + step[:IDENTITIES]).clip(-4.0, 4.0)
        turn = _rotation(step[IDENTITIES : IDENTITIES + 3])
        rotation, shift = turn @ rotation, turn @ shift + step[IDENTITIES + 3 :]
        on_round((face.of(weights) - shift) @ rotation)
    return rotation, shift, weights


def _plane_rows(
    face: Grid, weights: FloatArray, there: FloatArray, facing: FloatArray, worth: FloatArray
) -> tuple[FloatArray, FloatArray]:
    points = face.of(weights).reshape(-1, 3)
    modes = face.modes.reshape(IDENTITIES, -1, 3)
    system = np.empty((len(there), IDENTITIES + 6))
    system[:, :IDENTITIES] = np.einsum("mni,ni->nm", modes, facing)
    system[:, IDENTITIES : IDENTITIES + 3] = -np.cross(there, facing)
    system[:, IDENTITIES + 3 :] = -facing
    off = ((there - points) * facing).sum(axis=1)
    return system * worth[:, None], off * worth


def _mark_rows(
    modes: FloatArray, points: FloatArray, there: FloatArray, trust: FloatArray
) -> tuple[FloatArray, FloatArray]:
    off = there - points
    length = np.linalg.norm(off, axis=1)
    worth = np.sqrt(_LANDMARK * trust) / 2.0e-3 / (1.0 + (length / 4.0e-3) ** 2)
    system = np.zeros((len(there), 3, IDENTITIES + 6))
    system[:, :, :IDENTITIES] = modes.transpose(1, 2, 0)
    for axis in range(3):
        about = np.eye(3)[axis]
        system[:, :, IDENTITIES + axis] = -np.cross(about, there)
        system[:, axis, IDENTITIES + 3 + axis] = -1.0
    system, off = system * worth[:, None, None], off * worth[:, None]
    return system.reshape(-1, IDENTITIES + 6), off.ravel()


def _rotation(turn: NDArray[np.floating]) -> FloatArray:
    from scipy.spatial.transform import Rotation

    return np.asarray(Rotation.from_rotvec(turn).as_matrix())
