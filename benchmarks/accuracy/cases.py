"""What the benchmark photographs, and what comes of each picture."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

import pdeface
from benchmarks.accuracy.likeness import image_difference
from benchmarks.accuracy.makehuman import makehuman
from benchmarks.accuracy.scans import Randoms, Subject
from benchmarks.accuracy.scoring import Score
from pdeface.photo import PhotoFace, find_faces, photo_views
from pdeface.photo.build.samples import random_expression
from pdeface.photo.build.scenes import Scene, photograph
from pdeface.photo.build.skins import random_skin
from pdeface.photo.build.wardrobe import Cover, random_covers, random_ground
from pdeface.photo.landmarker import landmarker
from pdeface.pictures.light import RIGS
from pdeface.pictures.raster_vtk import Canvas

SEED = 90_000
"""Nobody with such a seed took part in learning anything."""

YAWS, THREE = (0.0, 20.0, 40.0), (-30.0, 0.0, 30.0)
FOCALS, LIGHTS = (35.0, 50.0, 85.0), ("studio", "soft")
DIAGONAL = 43.267


@dataclass(frozen=True, eq=False)
class Result:
    """One or three pictures of a head and the face that came of them.

    Attributes:
        group: which heads it belongs to.
        subject: its name.
        views: how it was photographed, for tables.
        fitted, scaled, neutral: scores of the fitted face, of the neutral face scaled by the
            landmarks, and of the neutral face as it is.
        error: reprojection, shares of the eye distance.
        most: the largest identity weight.
        image: how far the pictures drawn of the face differ from those taken, 0 to 1.
    """

    group: str
    subject: str
    views: str
    fitted: Score
    scaled: Score
    neutral: Score
    error: float
    most: float
    image: float


def subjects(folder: Path, model: Path, people: int) -> Iterator[tuple[str, Subject]]:
    """Random people, every other one with an expression, and MakeHuman's heads."""
    randoms = Randoms(folder / "ict_facekit")
    for number in range(people):
        rng = np.random.default_rng([SEED, number])
        identity = rng.normal(size=randoms.space.modes)
        expression = random_expression(rng, randoms.space.expressions, expressive=number % 2)
        group = "random, expressive" if number % 2 else "random, at rest"
        yield group, randoms.subject(identity, expression, f"random {number}")
    with landmarker(model) as detect:
        heads = makehuman(folder / "makehuman", detect)
    yield from (("MakeHuman", head) for head in heads)


class Sitting:
    """A head that sits for its pictures.

    Args:
        subject: who.
        number: decides the skin, the sides, the lenses and the lights.
        dressed: whether it has hair and clothes, and something behind it.
    """

    def __init__(self, subject: Subject, number: int, dressed: bool = False) -> None:
        self.subject, self.number, self.dressed = subject, number, dressed
        self._skin = random_skin(np.random.default_rng([SEED, number, 1]))
        rng = np.random.default_rng([SEED, number, 2])
        self._covers: list[Cover] = (
            random_covers(rng, subject.head, self._skin.tone) if dressed else []
        )

    def photo(self, scene: Scene, canvas: Canvas) -> np.ndarray:
        """A picture."""
        rng = np.random.default_rng([SEED, self.number, 3])
        ground = random_ground(rng, scene.size) if self.dressed else None
        return photograph(self.subject.head, self._skin, scene, canvas, self._covers, ground)


def results(group: str, sitting: Sitting, model: Path, canvas: Canvas) -> Iterator[Result]:
    """One picture from each side, and then three together."""
    neutral, scan, number = pdeface.neutral(), sitting.subject.scan, sitting.number
    bases = Score(neutral, scan), Score(neutral, scan, scaled=False)
    singles = [[_scene(yaw, number + k)] for k, yaw in enumerate(YAWS)]
    for scenes in (*singles, [_scene(yaw, number, plain=True) for yaw in THREE]):
        result = _result(group, sitting, scenes, bases, model, canvas)
        if result is not None:
            yield result


def _scene(yaw: float, number: int, plain: bool = False) -> Scene:
    """Sides, lenses and lights take turns."""
    side = 1.0 if plain or number % 2 else -1.0
    return Scene(
        yaw=side * yaw,
        pitch=(-6.0, 0.0, 6.0)[number % 3],
        focal=FOCALS[number % len(FOCALS)],
        rig=RIGS[LIGHTS[number // 2 % len(LIGHTS)]],
        filling=0.7,
        size=(640, 800),
    )


def _result(
    group: str,
    sitting: Sitting,
    scenes: Sequence[Scene],
    bases: tuple[Score, Score],
    model: Path,
    canvas: Canvas,
) -> Result | None:
    """None where MediaPipe finds no face."""
    found: list[PhotoFace] = []
    photos = [sitting.photo(scene, canvas) for scene in scenes]
    for photo in photos:
        faces = find_faces(photo, model)
        if not faces:
            return None
        found.append(faces[0])
    views = photo_views(photos, found, [_focal(scene) for scene in scenes])
    shapes = [view.shape for view in views]
    error = float(np.sqrt(np.mean([shape.error**2 for shape in shapes])))
    most = max(map(abs, shapes[0].identity.values()))
    fitted = Score(shapes[0].face, sitting.subject.scan)
    name = "three" if len(scenes) > 1 else f"{abs(scenes[0].yaw):.0f}"
    image = image_difference(views)
    return Result(group, sitting.subject.name, name, fitted, *bases, error, most, image)


def _focal(scene: Scene) -> float:
    """As EXIF would say it: by the diagonal."""
    width, height = scene.size
    return scene.focal / 36.0 * height / np.hypot(width, height) * DIAGONAL
