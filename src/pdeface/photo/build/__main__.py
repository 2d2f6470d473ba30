"""Measure where on the face the landmarks lie: ``python -m pdeface.photo.build``.

MediaPipe looks at pictures of the neutral face and of random people from random sides. A landmark's
(u, v) is the point of the surface that is nearest to its finds in all of them together. How these
differ from it, together with other landmarks' and alone, is what the fit expects of a photo's.
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
from pdeface.photo.build.measure import common_errors, places_on_face
from pdeface.photo.build.renders import Rendered, people
from pdeface.photo.landmarker import find_faces
from pdeface.photo.model import model_file

FloatArray = NDArray[np.float64]


def main() -> int:
    """Build the file of landmarks on the face."""
    parser = argparse.ArgumentParser(prog="pdeface.photo.build", description=__doc__)
    parser.add_argument("-o", "--out", type=Path, default=DATA, help="file to write")
    parser.add_argument("--model", type=Path, help="MediaPipe's face_landmarker.task")
    parser.add_argument("--people", type=int, default=240, help="how many to look at")
    options = parser.parse_args()
    found, places = _finds(people(options.people), model_file(options.model))
    write(options.out, found, places)
    print(f"looked at {len(found)} pictures")
    print(f"wrote {options.out.name}, {options.out.stat().st_size / 1024:.0f} kB")
    return 0


def write(path: Path, found: FloatArray, places: FloatArray) -> None:
    """Measure, from (n, 478, 2) landmarks and (n, vertices, 2) places, and write the file."""
    uv = places_on_face(found, places).astype(np.float32)
    modes, spread = common_errors(found, places, uv.astype(np.float64))
    numbers = {"uv": uv, "spread": spread.astype(np.float32), "modes": modes.astype(np.float16)}
    with atomic_path(path) as temporary, open(temporary, "wb") as file:
        np.savez_compressed(file, **numbers)  # type: ignore[arg-type]


def _finds(pictures: Iterable[Rendered], model: Path) -> tuple[FloatArray, FloatArray]:
    """(n, 478, 2) landmarks and (n, vertices, 2) places, both in eye distances."""
    found, places = [], []
    for rendered in pictures:
        for face in find_faces(rendered.picture, model)[:1]:
            found.append(face.landmarks[:, :2] / face.eye_distance)
            places.append(rendered.places / face.eye_distance)
    return np.array(found), np.array(places)


if __name__ == "__main__":
    sys.exit(main())
