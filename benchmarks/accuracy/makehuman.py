"""MakeHuman's heads, which are no mixture of the heads that anything was learnt from.

Where on them the face's (u, v) lie is not given. MediaPipe finds its landmarks in pictures of the
bare heads from several sides; (u, v) are smoothly interpolated between these. They serve to paint
the heads, to tell the regions apart and to align them; the distances are from the mesh itself.
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from scipy.interpolate import RBFInterpolator
from scipy.spatial import cKDTree

from benchmarks.accuracy.scans import Spread, Subject, in_sight, lattice
from pdeface.photo.anchors import anchors
from pdeface.photo.build.heads import Head, eye_colors, triangulated
from pdeface.photo.build.samples import found_in
from pdeface.photo.build.scenes import Scene, photograph
from pdeface.photo.build.skins import Skin
from pdeface.pictures.raster_vtk import Canvas

EYEBALL = 72
"""Vertices of each of the two eyeballs, which come last."""

NEAR, PAINTED, HAIRLINE = 0.02, 0.06, 0.1
EYES = np.array([0.0, 0.0361, 0.0799])
"""Between the eyeballs of ICT-FaceKit's head, whose frame the pictures are taken in."""

VIEWS = ((0.0, 0.0), (18.0, 0.0), (-18.0, 0.0), (0.0, 10.0), (0.0, -10.0))
LANDMARKS = (33, 133, 362, 263, 2, 61, 291)
"""MediaPipe's for the seven of :data:`benchmarks.accuracy.scoring.SEVEN`."""

PLAIN = Skin(np.full((8, 8, 3), 190, np.uint8), np.array([0.8, 0.65, 0.55]), None,
             np.array([0.3, 0.2, 0.1]))  # fmt: skip


def makehuman(folder: Path, detect: Any) -> list[Subject]:
    """All heads of the folder, by name."""
    return [_subject(path, detect) for path in sorted(folder.glob("*.obj"))]


def _subject(path: Path, detect: Any) -> Subject:
    bare = _load(path)
    surface = lattice(bare.vertices, bare.skin)
    surface = surface[in_sight(surface, surface)]
    known = _landmarks(bare, surface, detect)
    uv = anchors().uv[: len(known)]
    to_uv = RBFInterpolator(known, uv, neighbors=60, smoothing=1e-6)
    away = cKDTree(known).query(bare.vertices)[0]
    near = (away < NEAR) & in_sight(bare.vertices, surface)
    seven = known[list(LANDMARKS)]
    spread = Spread(_mapped(bare, near, to_uv), cKDTree(bare.vertices).query(seven)[1])
    scan = replace(spread.scan(bare.vertices), seven=seven, seven_uv=uv[list(LANDMARKS)])
    # Skins fade out towards the texture's edge, which lies beyond the landmarks.
    return Subject(path.stem, scan, _mapped(bare, away < PAINTED, to_uv))


def _mapped(head: Head, some: np.ndarray, to_uv: RBFInterpolator) -> Head:
    """The head with the texture's place for some of its vertices."""
    texcoords = np.full((len(head.vertices), 2), -1.0)
    texcoords[some] = (to_uv(head.vertices[some]) / (1.0, np.pi))[:, ::-1]
    return replace(head, texcoords=texcoords)


def _landmarks(head: Head, surface: np.ndarray, detect: Any) -> np.ndarray:
    """(468, 3) where the landmarks lie on a head, in the middle of what several views say."""
    canvas, found = Canvas(), []
    for yaw, pitch in VIEWS:
        scene = Scene(yaw=yaw, pitch=pitch, filling=0.75, focal=70.0, size=(480, 600))
        face = found_in(photograph(head, PLAIN, scene, canvas), detect)
        if face is None:
            raise ValueError("MediaPipe finds no face in a picture of a MakeHuman head")
        places, depth = scene.camera.project(surface, scene.size)
        near = cKDTree(places).query(face.landmarks[:468, :2], k=12)[1]
        nearest = np.take_along_axis(near, depth[near].argmin(axis=1)[:, None], 1)[:, 0]
        found.append(surface[nearest])
    return np.median(found, axis=0)


def _load(path: Path) -> Head:
    vertices, polygons = [], []
    for line in path.read_text().splitlines():
        words = line.split()
        if words and words[0] == "v":
            vertices.append([float(word) for word in words[1:4]])
        elif words and words[0] == "f":
            polygons.append([int(word.split("/")[0]) - 1 for word in words[1:]])
    triangles, first = triangulated(polygons), len(vertices) - 2 * EYEBALL
    points, eyes = np.array(vertices), triangles[(triangles >= first).all(axis=1)]
    points = points - points[first:].mean(axis=0) + EYES
    balls = (eyes[eyes.max(axis=1) < first + EYEBALL], eyes[eyes.min(axis=1) >= first + EYEBALL])
    iris = np.sum([eye_colors(points, ball) for ball in balls], axis=0)
    beside, hairy = np.full((len(points), 2), -1.0), points[:, 1] > HAIRLINE
    return Head(points, triangles[(triangles < first).all(axis=1)], beside, {"eyes": eyes}, iris,
                hairy)  # fmt: skip
