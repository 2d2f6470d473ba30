"""How near a fit is to its scan, and the scan to the fit."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from pdeface.pde import GridEvaluator
from pdeface.scan.fitting import ScanFit
from pdeface.scan.nearest import Target, flat
from pdeface.scan.surface import Scan

__all__ = ["FRONT", "Away", "Measures", "Spread", "distances", "measure"]

FloatArray = NDArray[np.float64]

FRONT = (np.pi / 6, 5 * np.pi / 6)
"""The front of the face, in v: what numbers are told of."""

_ROWS, _COLUMNS = 271, 241
_HOLE = 5.0e-3
"""Metres from the scan from which on a sample counts as one that the scan does not have."""

_BRIDGE = 0.5e-3, 60.0
"""Metres and degrees by which a sample over a small hole, as a nostril, differs from its rim."""


@dataclass(frozen=True)
class Spread:
    """Distances, millimetres."""

    rms: float
    median: float
    p95: float
    largest: float

    @classmethod
    def of(cls, metres: FloatArray) -> Spread:
        """Of (n,) distances in metres."""
        d = 1e3 * metres
        if not len(d):
            return cls(*[float("nan")] * 4)
        rms, median, p95 = np.sqrt(np.mean(d**2)), np.median(d), np.percentile(d, 95)
        return cls(float(rms), float(median), float(p95), float(d.max()))


@dataclass(frozen=True, eq=False)
class Measures:
    """How near face and scan are over the front of the face.

    Attributes:
        to_scan: from samples of the surface to the scan.
        to_face: from the scan's vertices to the surface.
        normal: median angle between the normals of surface and scan, degrees.
        coverage: share of the samples that the scan has.
        grid: (U, V, 3) the samples of the whole face.
        away, angle: (U, V) distance (metres) and angle (degrees) there.
        known: (U, V) whether the scan has the sample.
    """

    to_scan: Spread
    to_face: Spread
    normal: float
    coverage: float
    grid: FloatArray
    away: FloatArray
    angle: FloatArray
    known: NDArray[np.bool_]


class Away(NamedTuple):
    """How far places of a face are from a scan.

    Attributes:
        metres, degrees: (n,) distance, and angle between the normals of face and scan.
        known: (n,) whether the scan has the place.
    """

    metres: FloatArray
    degrees: FloatArray
    known: NDArray[np.bool_]


def distances(target: Target, points: FloatArray, normals: FloatArray) -> Away:
    """How far (n, 3) places of a face, with (n, 3) unit normals, are from a scan, metres.

    The scan has no place that is 5 mm or further from it, nor one further than half a millimetre
    whose nearest place faces elsewhere.
    """
    found = target.nearest(points)
    alike = (found.normals * normals).sum(axis=1)
    angle = np.degrees(np.arccos(alike.clip(-1.0, 1.0)))
    bridging = (found.away > _BRIDGE[0]) & (angle > _BRIDGE[1])
    return Away(found.away, angle, (found.away < _HOLE) & ~bridging)


def measure(fit: ScanFit) -> Measures:
    """Compare the smooth surface of a fit with its scan.

    Distances are to the flat triangles of the scan, angles to its vertices' normals, interpolated.
    Samples 5 mm or further from the scan lie over holes in it, and so do those further than half a
    millimetre whose nearest place faces elsewhere: over nostrils. They count in the coverage alone.
    """
    curves = fit.face.curves
    u, v = np.linspace(0.0, 1.0, _ROWS), (np.arange(_COLUMNS) + 0.5) * (np.pi / _COLUMNS)
    grid = GridEvaluator(curves.shape, u, v)
    points, normals = (flat(of) for of in grid.positions_and_normals(curves.points))
    found = distances(Target(fit.scan), points, normals)
    away, angle = (of.reshape(_ROWS, _COLUMNS) for of in (found.metres, found.degrees))
    known = found.known.reshape(away.shape)
    points = points.reshape(_ROWS, _COLUMNS, 3)
    front = np.broadcast_to((v > FRONT[0]) & (v < FRONT[1]), away.shape)
    to_face = _back(fit.scan, points)
    return Measures(
        Spread.of(away[front & known]),
        Spread.of(to_face),
        float(np.median(angle[front & known])) if (front & known).any() else float("nan"),
        float(known[front].mean()),
        points,
        away,
        angle,
        known,
    )


def _back(scan: Scan, grid: FloatArray) -> FloatArray:
    """Distance to the face of the vertices of the scan that lie before its front."""
    rows, columns = grid.shape[:2]
    index = np.arange(rows * columns).reshape(rows, columns)
    a, b, c, d = index[:-1, :-1], index[1:, :-1], index[1:, 1:], index[:-1, 1:]
    triangles = np.concatenate([np.stack([a, b, c], -1), np.stack([a, c, d], -1)]).reshape(-1, 3)
    face = Scan(grid.reshape(-1, 3), triangles)
    step = max(1, len(scan.vertices) // 60_000)
    found = Target(face).nearest(scan.vertices[::step])
    column = (found.corners % columns * found.weights).sum(axis=1) / (columns - 1)
    row = (found.corners // columns * found.weights).sum(axis=1) / (rows - 1)
    inside = (column > FRONT[0] / np.pi) & (column < FRONT[1] / np.pi)
    inside &= (row > 0.004) & (row < 0.996) & (found.away < _HOLE)
    alike = (found.normals * scan.normals[::step]).sum(axis=1)
    inside &= (found.away < _BRIDGE[0]) | (alike > np.cos(np.radians(_BRIDGE[1])))
    return found.away[inside]
