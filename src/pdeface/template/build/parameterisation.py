"""Rows and columns of the template: which (s, t) each (u, v) means.

Columns crowd smoothly towards the midline. Rows lie on the lids, the lips and the base of the nose,
pass the midline at chosen heights, and are otherwise as straight as these allow.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline
from scipy.ndimage import gaussian_filter1d

from pdeface.template.build.chart import Chart
from pdeface.template.build.closing import ClosedHead
from pdeface.template.build.head import Head
from pdeface.template.build.rows import Bump, Pins, RowMap
from pdeface.template.layout import PAPER_ROWS, ROWS

__all__ = ["Parameterisation"]

FloatArray = NDArray[np.float64]
Pin = tuple[float, float, float, float]

LAST = PAPER_ROWS - 1
CROWDING = 0.03
"""Amplitude of ``sin 2v`` in s(v): 0 spreads the columns evenly over s."""

# Height y of each inner row on the midline, metres; where the nose overhangs, (y, z).
MIDLINE: dict[int, float | tuple[float, float]] = {
    **{1: 0.086, 2: 0.071, 3: 0.0595, 4: 0.051, 5: 0.045, 6: 0.041, 7: 0.0375, 8: 0.0335},
    **{9: 0.0295, 10: 0.0255, 11: 0.0205, 12: 0.0130, 13: (0.0045, 0.1306)},
    **{14: (-0.0065, 0.1257), 15: -0.0142, 16: -0.0190, 17: -0.0250, 18: -0.0333, 19: -0.0340},
    **{20: -0.0438, 21: -0.0505, 22: -0.0585, 23: -0.0665, 24: -0.0740},
}
# Multi-PIE landmarks that a row passes through, counted from 0.
ON_LANDMARKS = {
    "upper_lip_border": (49, 50, 52, 53),
    "lower_lip_border": (55, 56, 58, 59),
    "subnasale": (31, 32, 34, 35),
}
FEATURE, LANDMARK, ON_MIDLINE, ON_SIDE, STRAIGHT = 1.0, 0.4, 0.15, 0.1, 0.03
# Rows that nothing else holds are kept straighter.
STRAIGHTER = {
    **{1: 0.15, 2: 0.15, 3: 0.12, 4: 0.08, 11: 0.05, 12: 0.05, 16: 0.05},
    **{22: 0.1, 23: 0.1, 24: 0.1, 25: 0.1, 26: 0.1},
}
LID_STRIP = 0.011
"""How far, in t, the rows beside the lid margins lie from them: 2 mm."""
SEAM_GAP = 0.007
"""How far, in t, each row of the mouth seam parts from it towards the corners."""
SEAM_HALF_WIDTH = 0.0215


class Parameterisation:
    """The map (u, v) -> (s, t), and from there to the face."""

    def __init__(self, head: Head, closed: ClosedHead, chart: Chart) -> None:
        self.chart = chart
        self._head, self._closed = head, closed
        self._midline, self._side = self._heights()
        pins = [*self._middle(), *self._sides(), *self._straight(), *self._lids()]
        pins += [*self._seam(), *self._landmarks()]
        self._rows = RowMap(self._bumps(), Pins(*np.array(pins).T))

    def st(self, u: FloatArray, v: FloatArray) -> tuple[FloatArray, FloatArray]:
        """(U, V) values of s and of t."""
        t = self._rows(u, v)
        return np.broadcast_to(_s_of_v(v), t.shape), t

    def points(self, u: FloatArray, v: FloatArray) -> FloatArray:
        """(U, V, 3) positions on the face, made symmetric.

        The head is symmetric but for its triangulation, so v must be too.
        """
        points = self.chart.points(*self.st(u, v))
        return 0.5 * (points + points[:, ::-1] * np.array([-1.0, 1.0, 1.0]))

    def uv_of(self, points: FloatArray) -> FloatArray:
        """(Q, 2) parameters (u, v) of points on the face."""
        found = []
        for s, t in self.chart.of(points):
            v = _v_of_s(float(s))
            found.append((self._rows.inverse(float(t), v), v))
        return np.array(found)

    def _heights(self) -> tuple[FloatArray, FloatArray]:
        """(28,) values of t of the rows on the midline and at the sides, where they spread."""
        t = np.linspace(0.0005, 0.9995, 2001)
        line = self.chart.points(np.full_like(t, 0.5), t)
        rows, heights = [0], [0.0]
        for row, place in MIDLINE.items():
            if isinstance(place, tuple):
                index = int(np.linalg.norm(line[:, 1:] - place, axis=1).argmin())
            else:
                index = int(np.argmax((line[:-1, 1] > place) & (line[1:, 1] <= place)))
            rows.append(row)
            heights.append(float(t[index]))
        spline = CubicSpline([*rows, LAST], [*heights, 1.0], bc_type="natural")
        midline = spline(np.arange(PAPER_ROWS))
        steps = gaussian_filter1d(np.diff(midline), 3.0, mode="nearest")
        side = np.concatenate([[0.0], np.cumsum(steps / steps.sum())])
        return midline, side

    def _bumps(self) -> list[Bump]:
        lid = [self._away(self._head.landmark(corner)) for corner in (39, 36)]
        mouth = self._away(self._closed.lips[0][0])
        return [
            Bump(18.5, 0.55, -9.0, mouth + 0.03),
            Bump(6.5, 0.7, *lid),
            Bump(9.5, 0.7, *lid),
        ]

    def _away(self, point: FloatArray) -> float:
        """Distance of a point from the midline, radians of v."""
        return abs(_v_of_s(float(self.chart.of(point)[0, 0])) - np.pi / 2)

    def _middle(self) -> list[Pin]:
        return [(row / LAST, np.pi / 2, self._midline[row], ON_MIDLINE) for row in MIDLINE]

    def _sides(self) -> list[Pin]:
        rows = range(1, LAST)
        return [(row / LAST, v, self._side[row], ON_SIDE) for row in rows for v in (0.0, 0.25)]

    def _straight(self) -> list[Pin]:
        pins = []
        for row in range(1, LAST):
            for v in np.linspace(0.25, np.pi / 2, 15):
                share = _smooth_step(v / 0.9)
                t = (1.0 - share) * self._side[row] + share * self._midline[row]
                pins.append((row / LAST, v, t, STRAIGHTER.get(row, STRAIGHT)))
        return pins

    def _lids(self) -> list[Pin]:
        pins: list[Pin] = []
        strips = ("upper_lid", -LID_STRIP, 0), ("lower_lid", LID_STRIP, 1)
        margins = ("upper_lid_margin", 0.0, 0), ("lower_lid_margin", 0.0, 1)
        for lines in self._closed.lids.values():
            middle = []
            for name, offset, line in (*margins, *strips):
                points = lines[line]
                x = np.abs(points[:, 0])  # from the inner corner outwards
                place = (x.max() - x) / (x.max() - x.min())
                low, high = (0.12, 0.9) if offset == 0.0 else (0.2, 0.8)
                st = self.chart.of(points)
                kept = st[(place > low) & (place < high)][::2]
                pins += self._on_row(name, kept + np.array([0.0, offset]), FEATURE)
                middle.append(st)
            s = np.linspace(middle[0][:, 0].min(), middle[0][:, 0].max(), 9)[2:-2]
            t = np.mean([np.interp(s, line[:, 0], line[:, 1]) for line in middle[:2]], axis=0)
            pins += self._on_row("mid_eye", np.stack([s, t], axis=1), FEATURE)
        return pins

    def _seam(self) -> list[Pin]:
        pins: list[Pin] = []
        for name, points, sign in zip(
            ("mouth_seam_upper", "mouth_seam_lower"), self._closed.lips, (-1.0, 1.0), strict=True
        ):
            x = np.abs(points[:, 0])
            st = self.chart.of(points)
            st[:, 1] += sign * SEAM_GAP * np.array([_smooth_step((d - 0.010) / 0.011) for d in x])
            pins += self._on_row(name, st[(x < SEAM_HALF_WIDTH) & (x > 1e-4)][::2], FEATURE)
        return pins

    def _landmarks(self) -> list[Pin]:
        pins: list[Pin] = []
        for name, marks in ON_LANDMARKS.items():
            points = np.array([self._head.landmark(mark) for mark in marks])
            pins += self._on_row(name, self.chart.of(points), LANDMARK)
        return pins

    @staticmethod
    def _on_row(name: str, st: FloatArray, weight: float) -> list[Pin]:
        """Pins of one row, all on the right half: the rows are symmetric."""
        u = ROWS[name] / LAST
        return [(u, _fold(_v_of_s(float(s))), float(t), weight) for s, t in st]


def _s_of_v(v: FloatArray) -> FloatArray:
    return v / np.pi + CROWDING * np.sin(2.0 * v)


def _v_of_s(s: float) -> float:
    v = np.linspace(0.0, np.pi, 4001)
    return float(np.interp(s, _s_of_v(v), v))


def _fold(v: float) -> float:
    return min(v, np.pi - v)


def _smooth_step(x: float) -> float:
    x = min(max(x, 0.0), 1.0)
    return x * x * (3.0 - 2.0 * x)
