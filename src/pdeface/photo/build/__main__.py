"""Measure what the fit knows of landmarks: ``python -m pdeface.photo.build landmarks|identity``.

``landmarks`` measures where on the face they lie. MediaPipe looks at pictures of the neutral face
and of random people from random sides. A landmark's (u, v) is the point of the surface that is
nearest to its finds in all of them together. How these differ from it, together with other
landmarks' and alone, is what the fit expects of a photo's.

``identity HEADS`` learns which person they belong to, from pictures of ICT-FaceKit's random heads
with random expressions, skins, lenses and light, from random sides.
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
from pdeface.photo.build import learning
from pdeface.photo.build.measure import common_errors, places_on_face
from pdeface.photo.build.nearness import shares_worse
from pdeface.photo.build.renders import Rendered, people
from pdeface.photo.build.rounds import ROUNDS, sample_rounds
from pdeface.photo.landmarker import find_faces
from pdeface.photo.model import model_file
from pdeface.photo.regression import IDENTITY
from pdeface.photo.traits import TRAITS

FloatArray = NDArray[np.float64]


def main() -> int:
    """Build the file of landmarks on the face, or the one of the regression."""
    parser = argparse.ArgumentParser(prog="pdeface.photo.build", description=__doc__)
    commands = parser.add_subparsers(dest="what", required=True)
    places = commands.add_parser("landmarks", help="where on the face they lie")
    places.add_argument("-o", "--out", type=Path, default=DATA, help="file to write")
    places.add_argument("--people", type=int, default=240, help="how many to look at")
    person = commands.add_parser("identity", help="which person they belong to")
    person.add_argument("heads", type=Path, help="ICT-FaceKit's folder")
    person.add_argument("-o", "--out", type=Path, default=IDENTITY, help="file to write")
    person.add_argument("--traits", type=Path, default=TRAITS, help="file of the traits to write")
    person.add_argument("--rounds", type=int, default=ROUNDS, help="of some 400 pictures each")
    person.add_argument("--cache", type=Path, help="folder to keep what was found in, for a rerun")
    for command in (places, person):
        command.add_argument("--model", type=Path, help="MediaPipe's face_landmarker.task")
    options = parser.parse_args()
    (_landmarks if options.what == "landmarks" else _identity)(options)
    print(f"wrote {options.out.name}, {options.out.stat().st_size / 1024:.0f} kB")
    return 0


def _landmarks(options: argparse.Namespace) -> None:
    found, places = _finds(people(options.people), model_file(options.model))
    write(options.out, found, places)
    print(f"looked at {len(found)} pictures")


def _identity(options: argparse.Namespace) -> None:
    found = sample_rounds(options.heads, model_file(options.model), options.rounds, options.cache)
    mean = learning.mean_landmarks(found)
    rows = learning.rows_of(found, mean)
    learnt, reading, held = learning.learn(rows, mean)
    learning.write(options.out, learnt)
    learning.write(options.traits, reading)
    pictures, persons = len(found["person"]), len(set(found["person"].tolist()))
    print(f"looked at {pictures} pictures of {persons} people")
    truth = rows.identity[:pictures, :10]
    for name, said in held._asdict().items():
        explained = 1.0 - ((said[:, :10] - truth) ** 2).sum() / (truth**2).sum()
        print(f"{name}: {100 * explained:.0f} per cent of the variance of kept-out people's ten "
              "first weights")  # fmt: skip
        some, near = shares_worse(said, rows.identity[:pictures])
        print(f"{name}: the neutral face is nearer to {100 * some:.1f} per cent of them, to "
              f"{100 * near:.1f} of the tenth that is nearest to it")  # fmt: skip


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
