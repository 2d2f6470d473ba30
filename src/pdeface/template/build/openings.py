"""Where the openings of the eyes and of the mouth lie on the template."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from pdeface.template.build.closing import ClosedHead
from pdeface.template.build.parameterisation import Parameterisation

__all__ = ["measure_openings"]

FloatArray = NDArray[np.float64]

ANGLES = 41
"""Columns of an opening, at ``v = middle - half width cos(angle)``, angles in even steps."""
SINES = 8
"""The lines are a straight one from corner to corner and so many sines of the angle: smoother than
the vertices of the head, which scatter by a tenth of a millimetre, and pointed at the corners."""


def measure_openings(face: Parameterisation, closed: ClosedHead) -> FloatArray:
    """(3, 3, columns) v, u of the upper and u of the lower line of right eye, left eye and mouth.

    The eyes open along the lid margins. The lips are one line at rest, halfway between those along
    which the head's lips part. Right and left are each other's reflections.
    """
    right, left = (_lines(face, closed.lids[side]) for side in ("right", "left"))
    right = 0.5 * (right + _reflected(left))
    mouth = _lines(face, closed.lips)
    mouth = 0.5 * (mouth + _reflected(mouth))
    mouth[1:] = mouth[1:].mean(axis=0)
    return np.array([right, _reflected(right), mouth])


def _lines(face: Parameterisation, pair: tuple[FloatArray, FloatArray]) -> FloatArray:
    upper, lower = (face.uv_of(line) for line in pair)
    (u_start, start), (u_end, end) = upper[0], upper[-1]
    angle = np.linspace(0.0, np.pi, ANGLES)
    # The sine vanishes at the ends in theory only; the two lines shall meet to the last bit.
    sines = np.sin(np.multiply.outer(angle, np.arange(1.0, SINES + 1)))
    sines[[0, -1]] = 0.0
    along = 0.5 - 0.5 * np.cos(angle)
    v = start + (end - start) * along
    v[-1] = end
    straight = u_start + (u_end - u_start) * along
    return np.array([v, *(straight + sines @ _fitted(line, start, end) for line in (upper, lower))])


def _fitted(line: FloatArray, start: float, end: float) -> FloatArray:
    """(SINES,) coefficients of a line's distance from the straight one."""
    along = ((line[:, 1] - start) / (end - start)).clip(0.0, 1.0)
    angle = np.arccos(1.0 - 2.0 * along)
    away = line[:, 0] - (line[0, 0] + (line[-1, 0] - line[0, 0]) * along)
    order = np.arange(1.0, SINES + 1)
    sines = np.sin(np.multiply.outer(angle, order))
    # Vertices stand close together at the corners; a little stiffness keeps the sines from ringing.
    stiff = 1e-3 * np.diag(order**2)
    system = np.concatenate([sines, stiff])
    return np.asarray(np.linalg.lstsq(system, np.append(away, np.zeros(SINES)), rcond=None)[0])


def _reflected(lines: FloatArray) -> FloatArray:
    reflected = lines[:, ::-1].copy()
    reflected[0] = np.pi - reflected[0]
    return reflected
