"""The two arches of teeth of the head, in polar coordinates."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from pdeface.template.build.head import Head

__all__ = ["AXIS_Z", "lower_and_upper", "measure_arch"]

FloatArray = NDArray[np.float64]
IndexArray = NDArray[np.int64]

AXIS_Z = 0.062
STATIONS = 25
CROWN = 0.006
"""Height of the part of a tooth by which its faces are measured, from the biting edge, metres."""


def lower_and_upper(head: Head) -> tuple[IndexArray, IndexArray]:
    """Vertices of the lower and of the upper teeth.

    Each tooth is a connected component; the upper ones have their middle above the height at
    which all teeth have theirs.
    """
    teeth = components(head.parts["M_Teeth"])
    heights = np.array([head.vertices[tooth, 1].mean() for tooth in teeth])
    is_lower = heights < 0.5 * (heights.min() + heights.max())
    lower = [tooth for tooth, low in zip(teeth, is_lower, strict=True) if low]
    upper = [tooth for tooth, low in zip(teeth, is_lower, strict=True) if not low]
    return np.concatenate(lower), np.concatenate(upper)


def components(polygons: list[tuple[int, ...]]) -> list[IndexArray]:
    """Vertices of each connected component of some polygons."""
    root: dict[int, int] = {}

    def find(vertex: int) -> int:
        while root.setdefault(vertex, vertex) != vertex:
            root[vertex] = root[root[vertex]]
            vertex = root[vertex]
        return vertex

    for polygon in polygons:
        first = find(polygon[0])
        for corner in polygon[1:]:
            root[find(corner)] = first
    groups: dict[int, list[int]] = {}
    for vertex in sorted(root):
        groups.setdefault(find(vertex), []).append(vertex)
    return [np.array(group) for group in groups.values()]


def measure_arch(head: Head, teeth: IndexArray, name: str) -> tuple[FloatArray, FloatArray]:
    """Stations along an arch and the gaps between its teeth, both exactly symmetric.

    Returns:
        (4, STATIONS) angle, outer and inner radius, height of the biting edge; (gaps,) angles.
    """
    points = head.vertices[teeth]
    angle, radius = _polar(points)
    up = -1.0 if name == "lower" else 1.0
    reach = np.quantile(np.abs(angle), 0.995)
    stations = np.linspace(-reach, reach, STATIONS)
    half = 1.1 * (stations[1] - stations[0])
    rows = []
    for station in stations:
        near = np.abs(angle - station) < half
        height = up * points[near, 1]
        edge = np.quantile(height, 0.03)
        crown = radius[near][height < edge + CROWN]
        rows.append((np.quantile(crown, 0.97), np.quantile(crown, 0.05), up * edge))
    profile = np.array(rows).T
    profile = 0.5 * (profile + profile[:, ::-1])
    members = set(teeth.tolist())
    spans = [
        _polar(head.vertices[tooth])[0][_crown_of(head, tooth, up)]
        for tooth in components(head.parts["M_Teeth"])
        if tooth[0] in members
    ]
    return np.vstack([stations, profile]), _gaps(spans)


def _polar(points: FloatArray) -> tuple[FloatArray, FloatArray]:
    x, z = points[:, 0], points[:, 2] - AXIS_Z
    return np.arctan2(x, z), np.hypot(x, z)


def _crown_of(head: Head, tooth: IndexArray, up: float) -> NDArray[np.bool_]:
    height = up * head.vertices[tooth, 1]
    return height < height.min() + CROWN


def _gaps(spans: list[FloatArray]) -> FloatArray:
    """Half-way between the end of each tooth and the start of the next."""
    ends = sorted((float(span.min()), float(span.max())) for span in spans)
    inner = [0.5 * (a[1] + b[0]) for a, b in pairwise(ends)]
    gaps = np.array([ends[0][0], *inner, ends[-1][1]])
    return 0.5 * (gaps - gaps[::-1])
