"""Textures from photos: feature points, the two-pass mesh warp, and the paper's five steps.

    from pdeface.texture import portrait, uv_texture

    photo, points = portrait()
    texture = uv_texture(photo, points)
    face = face.with_texture(texture.image)

Image coordinates are pixels, x to the right and y down from the top-left corner of an image, so
that the centre of pixel [row, column] is at (column + 1/2, row + 1/2).
"""

from __future__ import annotations

from pdeface.texture._result import UVTexture
from pdeface.texture.five_steps import photo_mesh, uv_texture
from pdeface.texture.photos import read_photo, write_image
from pdeface.texture.points import POINT_NAMES, FeaturePoints
from pdeface.texture.portrait import portrait
from pdeface.texture.projection import PhotoLayer, project, shown
from pdeface.texture.warp import warp

__all__ = [
    "POINT_NAMES",
    "FeaturePoints",
    "PhotoLayer",
    "UVTexture",
    "photo_mesh",
    "portrait",
    "project",
    "read_photo",
    "shown",
    "uv_texture",
    "warp",
    "write_image",
]
