"""The texture of a person from photos in which the face was found and fitted."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from pdeface.errors import InputError
from pdeface.photo.alignment import seen
from pdeface.photo.found import PhotoFace
from pdeface.photo.shape import PhotoShape
from pdeface.photo.visibility import trust
from pdeface.texture import PhotoLayer, project

__all__ = ["PhotoView", "projected_texture"]


class PhotoView(NamedTuple):
    """A photo, the face in it, and the shape fitted to that.

    Attributes:
        photo: (H, W, 3 or 4) uint8.
        found: the face in it.
        shape: its camera, identity and expression.
    """

    photo: NDArray[np.uint8]
    found: PhotoFace
    shape: PhotoShape


def projected_texture(
    views: Sequence[PhotoView],
    size: tuple[int, int] | None = None,
    *,
    margins: bool = True,
    delight: bool = False,
) -> NDArray[np.uint8]:
    """A texture read from photos through the fitted, posed, expressive face.

    Teeth of a smile lie between the lips of that face, not on them, and what a cheek hides is not
    painted on what it hides.

    Args:
        views: photos of one person, the one to whose light the others are matched first.
        size: (height, width); by default what keeps the photos' detail, 512 to 4096.
        margins: whether to clean the skin beside lids and lips, as for
            :func:`pdeface.texture.uv_texture`.
        delight: whether to divide out the light on the face, as far as it can be estimated.

    Returns:
        (H, W, 3) uint8, in the layout of every texture: row u H, column v W / pi.

    Raises:
        InputError: no photo.
    """
    if not views:
        raise InputError("a texture needs at least one photo, got none; give one")
    layers, nodes = [], np.zeros((0, 0, 2))
    for view in views:
        face = seen(view.found, view.shape)
        sure = trust(face.points, face.normals, view.shape.camera.distance)
        layers.append(PhotoLayer(view.photo, face.places, sure, face.normals))
        nodes = face.nodes
    return project(layers, nodes, size, margins=margins, delight=delight)
