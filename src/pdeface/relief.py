"""Reliefs: what a few curves leave out of a face, as heights over its surface on the uv mesh."""

from __future__ import annotations

import io
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pdeface.errors import FileFormatError, InputError, require
from pdeface.files import PathLike, atomic_write
from pdeface.uvmesh import FaceMesh

__all__ = ["Relief", "load_relief", "save_relief"]

FloatArray = NDArray[np.float64]

_KEY = "relief, metres"
_MIDDLE, _STEPS = 32768, 32767
_MOST, _HIGHEST = 8192, 0.1


@dataclass(frozen=True, eq=False)
class Relief:
    """Heights over a face.

    Attributes:
        heights: (H, W) metres along the surface's normals. Texel [i, j] lies at
            u = (i + 1/2) / H and v = (j + 1/2) pi / W, as those of a texture.

    Raises:
        InputError: not such an array, or heights of no face.
    """

    heights: FloatArray

    def __post_init__(self) -> None:
        heights = np.asarray(self.heights, dtype=np.float64)
        if heights.ndim != 2 or not 1 <= min(heights.shape) <= max(heights.shape) <= _MOST:
            raise InputError(
                f"a relief is an array of heights, 1 to {_MOST} along each side, got the shape "
                f"{heights.shape}; resample it"
            )
        if not np.abs(heights).max() <= _HIGHEST:  # or not a number
            raise InputError(
                f"heights of a relief are metres, {_HIGHEST} at most, got {np.abs(heights).max()}; "
                "check their unit"
            )
        object.__setattr__(self, "heights", heights)

    def at(self, texcoords: FloatArray) -> FloatArray:
        """(n,) heights at (n, 2) texture coordinates (v / pi, u), bilinear."""
        size = np.array(self.heights.shape[::-1])
        place = (texcoords * size - 0.5).clip(0.0, size - 1.0)
        first = np.minimum(place.astype(np.int64), np.maximum(size - 2, 0))
        (j, i), (f, g) = first.T, (place - first).T
        right, below = np.minimum(j + 1, size[0] - 1), np.minimum(i + 1, size[1] - 1)
        upper = self.heights[i, j] * (1.0 - f) + self.heights[i, right] * f
        lower = self.heights[below, j] * (1.0 - f) + self.heights[below, right] * f
        return np.asarray(upper * (1.0 - g) + lower * g)

    def raised(self, mesh: FaceMesh) -> FaceMesh:
        """The mesh with the relief on it; its normals turn as those of its triangles do."""
        height = self.at(mesh.texcoords)[:, None]
        vertices = mesh.vertices + height * mesh.normals
        turn = _of_triangles(vertices, mesh.triangles) - _of_triangles(
            mesh.vertices, mesh.triangles
        )
        return replace(mesh, vertices=vertices, normals=_unit(mesh.normals + turn))


def save_relief(path: PathLike, relief: Relief) -> None:
    """Write a relief as a PNG of 16 bits of grey, 32768 for no height; its text says the scale.

    Raises:
        InputError: a name that does not end in .png, or a place that cannot be written.
        MissingExtraError: Pillow is not installed.
    """
    if Path(path).suffix.lower() != ".png":
        raise InputError(f"a relief is a .png, got '{path}'; name it so")
    pillow = require("PIL.Image", "texture", "to write reliefs")
    texts = require("PIL.PngImagePlugin", "texture", "to write reliefs").PngInfo()
    largest = float(np.abs(relief.heights).max()) or 1e-6
    texts.add_text(_KEY, f"{largest:.9g}")
    grey = np.rint(relief.heights * (_STEPS / largest)).astype(np.int64) + _MIDDLE
    stream = io.BytesIO()
    pillow.fromarray(grey.astype(np.uint16)).save(stream, format="PNG", pnginfo=texts)
    atomic_write(path, stream.getvalue())


def load_relief(path: PathLike) -> Relief:
    """The relief in a file of :func:`save_relief`.

    Raises:
        InputError: no such file.
        FileFormatError: the file holds something else.
        MissingExtraError: Pillow is not installed.
    """
    pillow = require("PIL.Image", "texture", "to read reliefs")
    if not Path(path).is_file():
        raise InputError(f"expected a relief, found no file at {path}; check its name")
    try:
        with pillow.open(path, formats=("PNG",)) as image:
            image.load()
            return _read(image)
    except InputError:
        raise
    except Exception as error:  # Pillow's decoders raise nearly anything on damaged files
        raise FileFormatError(
            f"expected a relief, got {path}, which cannot be read as one "
            f"({' '.join(str(error).split())[:120]}); fit the scan again with --displacement"
        ) from error


def _read(image: Any) -> Relief:
    if not image.mode.startswith("I") or _KEY not in image.info:
        raise ValueError("no PNG of 16 bits of grey with the scale in its text")
    grey = np.array(image).astype(np.float64)
    return Relief((grey - _MIDDLE) * (float(image.info[_KEY]) / _STEPS))


def _of_triangles(vertices: FloatArray, triangles: NDArray[np.int32]) -> FloatArray:
    """(V, 3) unit normals, those of the triangles weighed by their area."""
    a, b, c = (vertices[corner] for corner in triangles.T)
    across = np.cross(b - a, c - a)
    corners, repeated = triangles.ravel(), np.repeat(across, 3, axis=0)
    sums = [np.bincount(corners, axis, len(vertices)) for axis in repeated.T]
    return _unit(np.stack(sums, axis=1))


def _unit(vectors: FloatArray) -> FloatArray:
    length = np.linalg.norm(vectors, axis=1, keepdims=True)
    return np.asarray(vectors / np.where(length > 0.0, length, 1.0))
