"""Where a photo shows the face, to the landmark: the fitted face and what it is off by.

A fitted face comes near its landmarks, not onto them. What is left is a smooth field over the
face: a Gaussian process with the covariance of Matern (order 3/2), whose noise is the landmarks'
own. Distances are those on a face with open eyes and mouth, so that lids and lips, close together
and far apart in a photo, do not pull at each other. Landmarks on the edges of lids and lips belong
to the lines along which a mesh is cut, wherever the calibration has them.
"""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor
from functools import lru_cache
from types import MappingProxyType
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from pdeface.face import neutral
from pdeface.openings import Cut
from pdeface.photo.anchors import anchors
from pdeface.photo.fitting import MESH_LANDMARKS
from pdeface.photo.found import PhotoFace
from pdeface.photo.shape import PhotoShape
from pdeface.uvmesh import UVMesh

__all__ = ["LINES", "Seen", "seen"]

FloatArray = NDArray[np.float64]
Floats = NDArray[np.floating[Any]]

GRID = (163, 241)
"""Rows and columns of the uv mesh on which all this is worked out."""

LINES = MappingProxyType(
    {
        "mouth": (
            (78, 191, 80, 81, 82, 13, 312, 311, 310, 415, 308),
            (78, 95, 88, 178, 87, 14, 317, 402, 318, 324, 308),
        ),
        "right_eye": (
            (33, 246, 161, 160, 159, 158, 157, 173, 133),
            (33, 7, 163, 144, 145, 153, 154, 155, 133),
        ),
        "left_eye": (
            (362, 398, 384, 385, 386, 387, 388, 466, 263),
            (362, 382, 381, 380, 374, 373, 390, 249, 263),
        ),
    }
)
"""MediaPipe's landmarks along the upper and the lower line of each opening, v increasing."""

_LENGTH = 0.03
"""Metres over which the field varies."""

_SIZE = 0.05
"""Its standard deviation, in eye distances: twice what fits of photos leave."""

_NOISE, _LINE_NOISE = 2.0, 0.002
"""Noise of a landmark, of its spread in pictures of known heads; and on a line, eye distances."""

_OPEN = MappingProxyType({"jawOpen": 1.0, "eyeWideLeft": 1.0, "eyeWideRight": 1.0})


class Seen(NamedTuple):
    """A face on a cut uv mesh as a photo shows it.

    Attributes:
        mesh: the uv mesh.
        nodes: (R, C, 2) u and v of its nodes.
        places: (R, C, 2) where they are in the photo, pixels.
        points: (R, C, 3) where they are in the camera's axes, metres.
        normals: (R, C, 3) unit normals there.
        error: root mean square distance of the landmarks from where this puts them, eye distances.
    """

    mesh: UVMesh
    nodes: FloatArray
    places: FloatArray
    points: FloatArray
    normals: FloatArray
    error: float


@lru_cache(maxsize=8)
def seen(found: PhotoFace, shape: PhotoShape) -> Seen:
    """Where the nodes of the uv mesh are in the photo in which a face was found and fitted."""
    face = shape.face.with_weights(shape.expression)
    uv_mesh = face.uv_mesh(*GRID)
    sampled = face.mesh(*GRID)
    points = sampled.vertices.reshape(*GRID, 3)
    apart = _coordinates()
    on_face, on_apart = (_landmarks(values, uv_mesh) for values in (points, apart))
    eye, camera = found.eye_distance, shape.camera
    off = (found.landmarks[:MESH_LANDMARKS, :2] - camera.project(on_face)) / eye
    covariance = _covariance(on_apart, on_apart)
    weights = np.linalg.solve(covariance + np.diag(_noise() ** 2), off)
    places = camera.project(points) + eye * _field(apart, on_apart, weights)
    left = off - covariance @ weights
    return Seen(
        mesh=uv_mesh,
        nodes=uv_mesh.nodes.reshape(*GRID, 2),
        places=places,
        points=points @ camera.rotation.T,
        normals=sampled.normals.reshape(*GRID, 3) @ camera.rotation.T,
        error=float(np.sqrt((left**2).sum(axis=1).mean())),
    )


def _field(apart: Floats, marks: Floats, weights: Floats) -> Floats:
    """(R, C, 2) the field at the nodes; single precision errs by 1e-5 eye distances."""
    nodes, marks, weights = (a.astype(np.float32) for a in (apart, marks, weights))
    with ThreadPoolExecutor() as pool:  # numpy lets threads run
        rows = pool.map(lambda row: _covariance(row, marks) @ weights, nodes)
        return np.array(list(rows))


@lru_cache(maxsize=1)
def _coordinates() -> FloatArray:
    """(R, C, 3) the nodes on a face whose lids and lips are apart."""
    return neutral().with_weights(_OPEN).mesh(*GRID).vertices.reshape(*GRID, 3)


def _landmarks(values: FloatArray, mesh: UVMesh) -> FloatArray:
    """(468, k) values at the landmarks, those on lines read along the lines."""
    uv = anchors().uv[:MESH_LANDMARKS]
    result = _bilinear(values, uv, mesh)
    for cut in mesh.cuts:
        lines = LINES[cut.opening.name]
        for numbers, rows in zip(lines, (cut.upper, cut.lower), strict=True):
            line = values[rows, cut.columns]
            v = _along(uv[list(numbers), 1], cut)
            result[list(numbers)] = _read_line(line, mesh.v[cut.columns], v)
    return result


def _along(v: FloatArray, cut: Cut) -> FloatArray:
    """The landmarks' v, stretched from corner to corner."""
    start, end = cut.opening.corners
    return np.asarray(start + (v - v[0]) / (v[-1] - v[0]) * (end - start))


def _read_line(line: FloatArray, at: FloatArray, v: FloatArray) -> FloatArray:
    return np.stack([np.interp(v, at, values) for values in line.T], axis=1)


def _bilinear(values: FloatArray, uv: FloatArray, mesh: UVMesh) -> FloatArray:
    """(n, k) values between four nodes, by row and column."""
    row = uv[:, 0] * (mesh.rows - 1)
    column = np.interp(uv[:, 1], mesh.v, np.arange(mesh.columns))
    i = np.minimum(row.astype(int), mesh.rows - 2)
    j = np.minimum(column.astype(int), mesh.columns - 2)
    x, y = (column - j)[:, None], (row - i)[:, None]
    upper = values[i, j] * (1.0 - x) + values[i, j + 1] * x
    lower = values[i + 1, j] * (1.0 - x) + values[i + 1, j + 1] * x
    return np.asarray(upper * (1.0 - y) + lower * y)


def _noise() -> FloatArray:
    """(468,) standard deviation of each landmark, eye distances."""
    noise = _NOISE * anchors().spread[:MESH_LANDMARKS]
    noise[[n for lines in LINES.values() for line in lines for n in line]] = _LINE_NOISE
    return np.asarray(noise)


def _covariance(one: Floats, other: Floats) -> Floats:
    """(n, m) covariances of the field between (n, 3) and (m, 3) points."""
    one, other = one / _LENGTH, other / _LENGTH
    square = (one**2).sum(axis=1)[:, None] + (other**2).sum(axis=1) - 2.0 * one @ other.T
    distance = np.sqrt(3.0 * np.maximum(square, 0.0))
    return np.asarray(_SIZE**2 * (1.0 + distance) * np.exp(-distance))
