"""A scan in, curves out."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from pdeface.errors import InputError
from pdeface.face import Face
from pdeface.files import PathLike
from pdeface.scan.alignment import Alignment, Landmarks, align
from pdeface.scan.landmarks import find_landmarks
from pdeface.scan.levels import check_level, fit_level
from pdeface.scan.registration import Registered, register
from pdeface.scan.surface import Scan
from pdeface.scan.visible import outside

__all__ = ["ScanFit", "Units", "fit_scan"]

FloatArray = NDArray[np.float64]
Progress = Callable[[str], None]
OnRound = Callable[[Scan, FloatArray], None]
Units = Literal["m", "cm", "mm"]

METRES = {"m": 1.0, "cm": 0.01, "mm": 0.001}
EYES_APART = 0.063
"""Metres between the pupils of a usual adult, where the scan's unit is none that is known."""

_HUMAN = 0.045, 0.085
_WORST = 7.0e-3
_MET = 0.35
_LEAST_FOUND = 0.3


@dataclass(frozen=True, eq=False)
class ScanFit:
    """A face fitted to a scan.

    Attributes:
        face: the face, without expression and texture.
        registered: the scan in the face's frame, and the dense samples on it.
        rotation, scale, shift: what moved the scan there: ``scale * scan @ rotation.T + shift``.
        unit: of the scan, as it was given or found; None if it is none of m, cm and mm.
    """

    face: Face
    registered: Registered
    rotation: FloatArray
    scale: float
    shift: FloatArray
    unit: Units | None

    @property
    def scan(self) -> Scan:
        """The outside of the scan in the frame of the face, metres."""
        return self.registered.scan

    @property
    def coverage(self) -> float:
        """Share of the face's samples that the scan has."""
        return float(self.registered.trust.mean())

    @property
    def rounded(self) -> bool:
        """Whether the curved surface is fitted that the scan's triangles stand for."""
        return self.registered.rounded

    def at_level(self, curves: int, points: int) -> ScanFit:
        """The best fit of so many curves of so many points to the same samples."""
        changed = self.face.with_curves(fit_level(self.registered.points, (curves, points)))
        rest = self.registered, self.rotation, self.scale, self.shift, self.unit
        return ScanFit(changed, *rest)


def fit_scan(
    scan: Scan,
    level: tuple[int, int] = (55, 92),
    *,
    landmarks: Landmarks | None = None,
    units: Units | None = None,
    rounded: bool | None = None,
    model: PathLike | None = None,
    progress: Progress | None = None,
    on_round: OnRound | None = None,
) -> ScanFit:
    """Curves whose surface lies on a scan, with rows and columns on its features.

    Args:
        scan: of any scale and in any orientation.
        level: (K, M) curves and points on each; K = 27 n + 1.
        landmarks: points of the face on it; None to find them.
        units: of the scan. None for those of m, cm and mm in which its eyes are as far apart as a
            person's, or, if there are none, for such a scale that they are 63 mm apart.
        rounded: fit the curved surface that a coarse scan's triangles stand for, with whose normals
            it is shaded, instead of their flat faces; None for that from triangles of 4 mm on.
        model: MediaPipe's model; None for the one that :func:`pdeface.photo.model_file` finds.
        progress: called with a line of text before each step.
        on_round: called after each round of the fit, with the scan about in the frame of the face,
            and with (U, V, 3) places of the face as it lies on the scan by then: u from 0 to 1, v
            at (j + 1/2) pi / V, metres.

    Raises:
        InputError: a level that there is not, or no face in the scan.
        MissingExtraError: SciPy or MediaPipe is not installed.
    """
    check_level(level)
    say = progress or (lambda text: None)
    if landmarks is None:
        landmarks = find_landmarks(scan, model, say)
    say("aligning the scan with the neutral face")
    first = align(landmarks)
    unit, scale = _unit(first, units)
    alignment = align(landmarks, scale)
    _check(alignment)
    say("finding the outside of the scan")
    moved = outside(scan.moved(alignment.rotation, alignment.scale, alignment.shift))
    own = Landmarks(landmarks.uv, alignment.apply(landmarks.points), landmarks.trust)
    say("laying the face onto the scan")
    watch = partial(on_round, moved) if on_round else lambda points: None
    registered = register(moved, own, alignment.weights, rounded=rounded, on_round=watch)
    if registered.trust.mean() < _MET:
        raise InputError(
            f"only {100 * registered.trust.mean():.0f} per cent of a face lies on the scan; give "
            "points on it with --landmarks (docs/scans.md), or use a more complete scan"
        )
    say(f"fitting {level[0]} curves of {level[1]} points")
    face = Face(fit_level(registered.points, level))
    rotation = registered.rotation @ alignment.rotation
    shift = registered.rotation @ alignment.shift + registered.shift
    return ScanFit(face, registered, rotation, alignment.scale, shift, unit)


def _unit(first: Alignment, units: Units | None) -> tuple[Units | None, float]:
    """The scan's unit and the metres to it.

    The alignment's scale is what a person of usual size has; identity is found along with it, so
    that it says little of the size.
    """
    if units is not None:
        if units not in METRES:
            raise InputError(f"units are one of {', '.join(METRES)}, got {units!r}")
        return units, METRES[units]
    for name, metres in METRES.items():
        apart = EYES_APART * metres / first.scale
        if _HUMAN[0] < apart < _HUMAN[1]:
            return name, metres  # type: ignore[return-value]
    return None, first.scale


def _check(alignment: Alignment) -> None:
    if alignment.error > _WORST or alignment.inliers < _LEAST_FOUND:
        raise InputError(
            f"the points are no face's: they lie {1e3 * alignment.error:.1f} mm from where a face "
            "has them; check --landmarks and --units"
        )
