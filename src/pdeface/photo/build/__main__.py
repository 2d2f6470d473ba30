"""Measure where on the face the landmarks lie: ``python -m pdeface.photo.build``.

MediaPipe looks at pictures of the neutral face and of random people from random sides. A landmark's
(u, v) is the point of the surface that is nearest to its finds in all of them together; how far
these are from it on average is what the fit trusts it by.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Iterable
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from pdeface.files import atomic_path
from pdeface.photo.anchors import DATA
from pdeface.photo.build.renders import GRID, Rendered, people
from pdeface.photo.landmarker import find_faces
from pdeface.photo.model import model_file

FloatArray = NDArray[np.float64]


def main() -> int:
    """Build the file of landmarks on the face."""
    parser = argparse.ArgumentParser(prog="pdeface.photo.build", description=__doc__)
    parser.add_argument("-o", "--out", type=Path, default=DATA, help="file to write")
    parser.add_argument("--model", type=Path, help="MediaPipe's face_landmarker.task")
    parser.add_argument("--people", type=int, default=200, help="how many to look at")
    options = parser.parse_args()
    found, places = _finds(people(options.people), model_file(options.model))
    uv, spread = anchors(found, places)
    with atomic_path(options.out) as temporary, open(temporary, "wb") as file:
        np.savez_compressed(file, uv=uv.astype(np.float32), spread=spread.astype(np.float32))
    print(f"{len(found)} pictures; spread {100 * np.median(spread):.1f} per cent of eye distances")
    print(f"wrote {options.out.name}, {options.out.stat().st_size / 1024:.0f} kB")
    return 0


def _finds(pictures: Iterable[Rendered], model: Path) -> tuple[FloatArray, FloatArray]:
    """(n, 478, 2) landmarks and (n, vertices, 2) places, both in eye distances."""
    found, places = [], []
    for rendered in pictures:
        for face in find_faces(rendered.picture, model)[:1]:
            found.append(face.landmarks[:, :2] / face.eye_distance)
            places.append(rendered.places / face.eye_distance)
    return np.array(found), np.array(places)


def anchors(found: FloatArray, places: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Where on the face landmarks lie that were found in n pictures.

    Args:
        found: (n, landmarks, 2) in each picture.
        places: (n, vertices, 2) where the vertices of the uv mesh ``GRID`` are in each.

    Returns:
        (landmarks, 2) u and v, and (landmarks,) root mean square distances on one axis.
    """
    count = len(found)
    squares = np.einsum("nvx,nvx->v", places, places)[None]
    flat_found = found.transpose(1, 0, 2).reshape(found.shape[1], -1)
    flat_places = places.transpose(1, 0, 2).reshape(places.shape[1], -1)
    cost = squares - 2.0 * flat_found @ flat_places.T + (flat_found**2).sum(axis=1)[:, None]
    cost = cost.reshape(-1, *GRID)
    row, column = np.divmod(cost.reshape(len(cost), -1).argmin(axis=1), GRID[1])
    row, column = np.clip(row, 1, GRID[0] - 2), np.clip(column, 1, GRID[1] - 2)
    at = np.arange(len(cost))
    u = row + _valley(*(cost[at, row + step, column] for step in (-1, 0, 1)))
    v = column + _valley(*(cost[at, row, column + step] for step in (-1, 0, 1)))
    uv = np.stack([u / (GRID[0] - 1), np.pi * v / (GRID[1] - 1)], axis=1)
    return uv, np.sqrt(np.maximum(cost[at, row, column], 0.0) / (2 * count))


def _valley(before: FloatArray, middle: FloatArray, after: FloatArray) -> FloatArray:
    """Where the parabola through three neighbours has its minimum, from the middle one."""
    bend = before - 2.0 * middle + after
    step = 0.5 * (before - after) / np.where(bend > 0.0, bend, np.inf)
    return np.clip(step, -0.5, 0.5)


if __name__ == "__main__":
    sys.exit(main())
