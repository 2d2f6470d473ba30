"""How like its photos a face is when it is drawn again as it was taken.

Every node of a fine uv mesh that a photo shows is looked up twice: in the photo, where the fitted
camera puts the fitted face, and in the texture that was made of it. Light is part of the texture,
so that a face that lay where it should would differ by what the texture blurs and blends alone.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from scipy.ndimage import map_coordinates

from pdeface.photo import PhotoView, projected_texture
from pdeface.photo.visibility import trust

MESH, SHOWN = (217, 325), 0.5
SIZE = (1024, 1024)


def image_difference(views: Sequence[PhotoView]) -> float:
    """Mean absolute difference of the colours of photos and drawn faces, of 0 to 1.

    Args:
        views: photos of one person with the shapes fitted to them, the best first.
    """
    texture = projected_texture(views, SIZE, margins=False)
    return float(np.mean([_difference(view, texture) for view in views]))


def _difference(view: PhotoView, texture: np.ndarray) -> float:
    face = view.shape.face.with_weights(view.shape.expression)
    mesh, camera = face.mesh(*MESH), view.shape.camera
    points, normals = (
        a.reshape(*MESH, 3) @ camera.rotation.T for a in (mesh.vertices, mesh.normals)
    )
    mask = trust(points, normals, camera.distance).ravel() > SHOWN
    v, u = mesh.texcoords[mask].T
    height, width = texture.shape[:2]
    drawn = _read(texture, np.stack([v * width, u * height], axis=1))
    taken = _read(view.photo, camera.project(mesh.vertices[mask]))
    return float(np.abs(drawn - taken).mean()) / 255.0


def _read(image: np.ndarray, places: np.ndarray) -> np.ndarray:
    """(n, 3) colours at (n, 2) places in pixels from the corner, bilinear."""
    at = places.T[::-1] - 0.5
    channels = (image[..., k].astype(np.float32) for k in range(3))
    return np.stack([map_coordinates(c, at, order=1, mode="nearest") for c in channels], axis=1)
