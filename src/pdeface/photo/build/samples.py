"""What MediaPipe finds in pictures of random heads, beside what these are."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from pdeface.photo import _views
from pdeface.photo.build.heads import Head, HeadSpace
from pdeface.photo.build.scenes import Scene, photograph, random_scene
from pdeface.photo.build.skins import Skin, random_skin
from pdeface.photo.build.spoiling import spoiled
from pdeface.photo.build.straying import MIXTURE, Nearest, bend, vary
from pdeface.photo.build.wardrobe import random_covers, random_ground
from pdeface.photo.found import PhotoFace
from pdeface.photo.landmarker import faces_both_ways, faces_in, landmarker
from pdeface.photo.network import Network, square
from pdeface.pictures.raster_vtk import Canvas

__all__ = ["random_expression", "sample"]

FloatArray = NDArray[np.float64]
Numbers = dict[str, NDArray[Any]]

_EXPRESSIVE = 0.65
_SMILE = "mouthSmile", "cheekSquint"
_SPOILS = 7  # besides a round's seed


def sample(
    folder: Path, model: Path, count: int, views: int, seed: int = 0, bent: bool = False
) -> Numbers:
    """Landmarks of random heads.

    Args:
        folder: ICT-FaceKit's, as for :class:`HeadSpace`.
        model: MediaPipe's face landmarker.
        count: how many people.
        views: pictures of each, each of another expression, from another side and in other light.
        seed: other people for another.
        bent: whether they are no mixtures (:mod:`pdeface.photo.build.straying`).

    Returns:
        Arrays with a row a picture: ``person``, ``identity`` (100 weights), ``expression`` (53),
        ``landmarks`` (478, 3), ``scores`` (51), ``pose`` (4, 4), ``focal`` (pixels), and ``inner``
        (4, 8192): what the network makes of the face, of its mirror image, and of both spoiled.
    """
    rows: dict[str, list[Any]] = {}
    network = Network(model)
    with landmarker(model) as detect:
        heads = _people(HeadSpace(folder), count, seed, bent)
        pictures = _pictures(heads, detect, views)
        for row, (number, picture, face, truth) in enumerate(pictures):
            rng = np.random.default_rng([seed, row, _SPOILS])
            found = {
                "person": number,
                "landmarks": face.landmarks.astype(np.float32),
                "scores": np.array([face.scores[name] for name in sorted(face.scores)]),
                "pose": face.pose,
                "inner": _inner(network, square(picture, face.landmarks), rng),
                **truth,
            }
            for name, value in found.items():
                rows.setdefault(name, []).append(value)
    return {name: np.array(values) for name, values in rows.items()}


class _Person(NamedTuple):
    """Somebody to photograph: by expression, and the identity that is to be found."""

    number: int
    identity: FloatArray
    skin: Skin
    head: Callable[[FloatArray], Head]
    expressions: list[str]
    rng: np.random.Generator


def _people(space: HeadSpace, count: int, seed: int, bent: bool) -> Iterator[_Person]:
    nearest = Nearest(space) if bent else None
    for number in range(count):
        rng = np.random.default_rng([seed, number])
        identity = rng.normal(size=space.modes)
        skin, head = random_skin(rng), partial(space.head, identity)
        if nearest is not None:
            identity = MIXTURE * identity
            moved = bend(rng, space.head(identity).vertices)
            head = partial(_bent, space, identity, moved)
            more = nearest(moved)
            identity = np.concatenate([identity[: len(more)] + more, identity[len(more) :]])
        yield _Person(number, identity, skin, head, space.expressions, rng)


def _bent(
    space: HeadSpace, identity: FloatArray, moved: FloatArray, expression: FloatArray
) -> Head:
    head = space.head(identity, expression)
    return replace(head, vertices=head.vertices + moved)


def _pictures(
    people: Iterable[_Person], detect: Any, views: int
) -> Iterator[tuple[int, NDArray[np.uint8], PhotoFace, Numbers]]:
    canvas = Canvas()
    for person in people:
        for _ in range(views):
            expression = random_expression(person.rng, person.expressions)
            scene = random_scene(person.rng)
            head = _expressive(person, expression)
            covers = random_covers(person.rng, head, person.skin.tone)
            ground = random_ground(person.rng, scene.size)
            picture = photograph(head, person.skin, scene, canvas, covers, ground)
            face = found_in(picture, detect)
            if face is not None:
                truth = {"identity": person.identity, "expression": expression,
                         "focal": _focal(scene)}  # fmt: skip
                yield person.number, picture, face, truth


def _expressive(person: _Person, expression: FloatArray) -> Head:
    """The person's head with an expression, in a way of their own."""
    rest, head = person.head(np.zeros_like(expression)), person.head(expression)
    moved = vary(person.rng, rest.vertices, head.vertices - rest.vertices)
    return replace(head, vertices=rest.vertices + moved)


def _inner(
    network: Network, seen: NDArray[np.uint8], rng: np.random.Generator
) -> NDArray[np.float16]:
    """(4, 8192) values for a square, its mirror image, and both of it spoiled."""
    both = [seen, spoiled(seen, rng)]
    squares = [np.ascontiguousarray(p) for each in both for p in (each, each[:, ::-1])]
    return network.inner(squares).astype(np.float16)


def found_in(picture: NDArray[np.uint8], detect: Any) -> PhotoFace | None:
    """The face in a picture of one face, looked at alone, as photos are."""
    whole = _views.View(picture, (0.0, 0.0), (picture.shape[1], picture.shape[0]))
    for face in faces_in([whole], detect, picture.shape)[:1]:
        for closer in faces_both_ways([_views.around(face, picture)], detect, picture.shape)[:1]:
            return closer
    return None


def random_expression(
    rng: np.random.Generator, names: list[str], expressive: float = _EXPRESSIVE
) -> FloatArray:
    """(n,) weights by name: nothing, a smile, or a few anythings, mostly alike on both sides."""
    weights = dict.fromkeys(names, 0.0)
    if rng.random() < expressive:
        if rng.random() < 0.4:
            strength = rng.uniform(0.2, 1.0)
            weights |= {f"{n}_{side}": strength for n in _SMILE for side in "LR"}
            weights["jawOpen"] = rng.uniform(0.0, 0.3)
        for name in rng.choice(names, rng.integers(0, 4), replace=False):
            strength, both = rng.uniform(0.0, 0.8), rng.random() < 0.7
            pair = {name, name[:-2] + ("_R" if name.endswith("_L") else "_L")}
            weights |= {n: strength for n in (pair if both else {name}) if n in weights}
    return np.array(list(weights.values()))


def _focal(scene: Scene) -> NDArray[np.float64]:
    """Of its camera, pixels."""
    return np.array(0.5 * scene.size[1] / np.tan(0.5 * np.radians(scene.camera.fov)))
