"""Whole heads to photograph: their mesh, and where on it the face's texture lies."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from pdeface.face import neutral
from pdeface.photo.build.skins import Skin
from pdeface.pictures.camera import Camera
from pdeface.pictures.light import Rig, decode_srgb, light_up
from pdeface.pictures.solid import Solid
from pdeface.template.build.head import load_head

__all__ = ["Head", "HeadSpace", "eye_colors", "mesh_normals", "triangulated"]

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int32]

_DENSE = 433, 513
_CENTIMETRE = 0.01
_HAIRLINE = np.array([[0.0, 0.088], [0.045, 0.085], [0.068, 0.05], [0.2, 0.05]])
"""Height above which a head is hairy, by the distance from the midline, metres."""

_LIGHTEST = np.array([0.93, 0.92, 0.90])
_TEETH = np.array([0.88, 0.84, 0.76])
_GUMS = np.array([0.55, 0.25, 0.24])


@dataclass(frozen=True, eq=False)
class Head:
    """A head as triangles.

    Attributes:
        vertices: (V, 3) metres.
        skin: (T, 3) triangles of the skin.
        texcoords: (V, 2) where on the face's texture a vertex of the skin lies; outside 0 to 1
            beside the face.
        others: triangles by what they are: ``eyes``, ``teeth``, ``gums``.
        iris: (V,) how dark the eyes are there, 0 white, 1 the iris, 2 the pupil.
        hairy: (V,) whether hair grows there.
    """

    vertices: FloatArray
    skin: IntArray
    texcoords: FloatArray
    others: dict[str, IntArray]
    iris: NDArray[np.int64]
    hairy: NDArray[np.bool_]

    def solids(self, skin: Skin, camera: Camera, rig: Rig) -> list[Solid]:
        """The head, painted and lit."""
        normals = mesh_normals(self.vertices, self.skin)
        beside = np.abs(self.texcoords - 0.5).max(axis=1) > 0.5
        albedo = np.where(beside[:, None], decode_srgb(skin.tone), 1.0)
        if skin.hair is not None:
            albedo[self.hairy & beside] = decode_srgb(skin.hair)
        face = beside[self.skin].sum(axis=1) == 0
        lit = light_up(self.vertices, normals, albedo, camera, rig)
        bare = np.where(beside[:, None], albedo, decode_srgb(skin.tone))
        around = light_up(self.vertices, normals, bare, camera, rig)
        solids = [
            Solid(self.vertices, self.skin[face], lit, self.texcoords, skin.texture),
            Solid(self.vertices, self.skin[~face], around),
        ]
        eyes = np.stack([_LIGHTEST, decode_srgb(skin.iris), np.full(3, 0.003)])[self.iris]
        colors = {"eyes": eyes, "teeth": decode_srgb(_TEETH), "gums": decode_srgb(_GUMS)}
        for name, triangles in self.others.items():
            normals = mesh_normals(self.vertices, triangles)
            lit = light_up(self.vertices, normals, colors[name], camera, rig)
            solids.append(Solid(self.vertices, triangles, lit))
        return solids


class HeadSpace:
    """ICT-FaceKit's heads: identities and expressions of one mesh.

    Args:
        folder: with its neutral head, ``identities.npz`` and ``expressions.npz``.

    Attributes:
        neutral: the neutral head.
        landmarks: (68,) vertices of the Multi-PIE landmarks.
        expressions: names of the expressions, as measured.
    """

    def __init__(self, folder: Path) -> None:
        head = load_head(folder)
        groups = {"eyes": ("ScleraLeft", "ScleraRight"), "teeth": ("Teeth",),
                  "gums": ("GumsTongue",)}  # fmt: skip
        others = {k: np.concatenate([triangulated(head.parts[f"M_{n}"]) for n in names])
                  for k, names in groups.items()}  # fmt: skip
        skin = triangulated([*head.parts["M_Face"], *head.parts["M_BackHead"]])
        texcoords = _texcoords(head.vertices)
        x, y, _ = head.vertices.T
        hairy = y > np.interp(np.abs(x), *_HAIRLINE.T)
        iris = sum(eye_colors(head.vertices, triangulated(head.parts[f"M_Sclera{side}"]))
                   for side in ("Left", "Right"))  # fmt: skip
        self.neutral = Head(head.vertices, skin, texcoords, others, np.asarray(iris), hairy)
        self.landmarks = head.landmarks
        shapes = np.load(folder / "expressions.npz")
        self.expressions: list[str] = shapes["names"].tolist()
        self._expressions = _CENTIMETRE * shapes["offsets_cm"].astype(np.float32)
        modes = np.load(folder / "identities.npz")["offsets_cm"].astype(np.float32)
        self._modes = _CENTIMETRE * modes

    @property
    def modes(self) -> int:
        """How many identity modes there are."""
        return len(self._modes)

    def head(self, identity: FloatArray, expression: FloatArray | None = None) -> Head:
        """The head with weights of all modes, and of all expressions."""
        moved = np.tensordot(identity.astype(np.float32), self._modes, 1)
        if expression is not None:
            on = np.flatnonzero(expression)
            moved = moved + np.tensordot(
                expression[on].astype(np.float32), self._expressions[on], 1
            )
        return replace(self.neutral, vertices=self.neutral.vertices + moved)


def triangulated(polygons: Sequence[Sequence[int]]) -> IntArray:
    """(T, 3) triangles of polygons, each a fan about its first corner."""
    return np.array([(p[0], p[i], p[i + 1]) for p in polygons for i in range(1, len(p) - 1)],
                    dtype=np.int32)  # fmt: skip


def _texcoords(vertices: FloatArray) -> FloatArray:
    """(V, 2) by the nearest point of the neutral face; (-1, -1) where that is far away."""
    mesh = neutral("55x92").mesh(*_DENSE)
    distance, nearest = cKDTree(mesh.vertices).query(vertices)
    found = np.asarray(mesh.texcoords)[nearest]
    return np.where((distance < 4e-3)[:, None], found, -1.0)


def eye_colors(vertices: FloatArray, eyeball: IntArray) -> NDArray[np.int64]:
    """(V,) 1 on the iris of an eyeball that looks ahead, 2 on its pupil, 0 elsewhere."""
    own = np.unique(eyeball)
    ball = vertices[own]
    middle = 0.5 * (ball.min(axis=0) + ball.max(axis=0))
    away = np.linalg.norm((ball - middle)[:, :2], axis=1)
    front = ball[:, 2] > middle[2]
    kinds = np.zeros(len(vertices), dtype=np.int64)
    kinds[own] = front * ((away < 6e-3).astype(int) + (away < 2.2e-3))
    return kinds


def mesh_normals(vertices: FloatArray, triangles: IntArray) -> FloatArray:
    """(V, 3) unit normals, the mean of the triangles' by their areas."""
    a, b, c = (vertices[triangles[:, k]] for k in range(3))
    flat = np.cross(b - a, c - a)
    count = len(vertices)
    sums = np.stack(
        [sum(np.bincount(triangles[:, k], flat[:, x], count) for k in range(3)) for x in range(3)],
        1,
    )
    return np.asarray(sums / np.maximum(np.linalg.norm(sums, axis=1, keepdims=True), 1e-30))
