"""Pictures of random people from random sides, of which the truth is known."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pdeface.face import Face, neutral, random
from pdeface.pictures import render
from pdeface.pictures.picture import face_camera
from pdeface.texture import portrait, uv_texture

__all__ = ["GRID", "Rendered", "people"]

FloatArray = NDArray[np.float64]

GRID = 217, 325
"""Rows and columns of the uv mesh whose vertices are seen in the pictures."""

_SIZE = 480, 600
_MOST_ASIDE, _MOST_UP = 25.0, 12.0


@dataclass(frozen=True, eq=False)
class Rendered:
    """A picture and what it shows.

    Attributes:
        face: the person.
        picture: (H, W, 3) uint8.
        places: (rows * columns, 2) where the vertices of the uv mesh ``GRID`` are in it, pixels.
    """

    face: Face
    picture: NDArray[np.uint8]
    places: FloatArray


def people(count: int, first_seed: int = 0) -> Iterator[Rendered]:
    """The neutral face, if ``first_seed`` is 0, and random people, all with one texture."""
    texture = uv_texture(*portrait(), margins=False).image
    for seed in range(first_seed, first_seed + count):
        face = (random(seed) if seed else neutral()).with_texture(texture)
        aside, up = np.random.default_rng([seed, 1]).uniform(-1.0, 1.0, 2)
        view = float(aside * _MOST_ASIDE), float(up * _MOST_UP)
        picture = render(face, view=view, size=_SIZE, light="soft", mesh=(161, 241))
        places, _ = face_camera(face, view, _SIZE).project(face.mesh(*GRID).vertices, _SIZE)
        yield Rendered(face, picture, places)
