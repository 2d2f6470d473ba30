"""A person from photos, in one call."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from pdeface.errors import InputError
from pdeface.face import Face
from pdeface.photo.bundled import portrait_face
from pdeface.photo.found import PhotoFace
from pdeface.photo.points import feature_points
from pdeface.photo.shape import fit_shapes
from pdeface.photo.texturing import PhotoView, projected_texture
from pdeface.texture import portrait, uv_texture

__all__ = ["TextureWay", "photo_views", "portrait_person", "textured"]

TextureWay = Literal["project", "warp"]


def photo_views(
    photos: Sequence[NDArray[np.uint8]],
    found: Sequence[PhotoFace],
    focals: Sequence[float | None] | None = None,
) -> tuple[PhotoView, ...]:
    """The photos of one person with the shape fitted to all, the one seen from the front first.

    Args:
        photos: (H, W, 3 or 4) uint8 each.
        found: the person's face in each of them.
        focals: their focal lengths (:func:`pdeface.photo.focal_length`), None where not known.

    Raises:
        InputError: no photo, or not one face for each.
    """
    if not photos or len(photos) != len(found):
        raise InputError(
            f"a person needs photos and one face in each, got {len(photos)} photos and "
            f"{len(found)} faces; give one face for each photo"
        )
    shapes = fit_shapes(found, focals)
    views = [PhotoView(*view) for view in zip(photos, found, shapes, strict=True)]
    return tuple(sorted(views, key=lambda view: abs(view.found.yaw) + abs(view.found.pitch)))


def textured(
    face: Face,
    views: Sequence[PhotoView],
    *,
    texture: TextureWay = "project",
    delight: bool = False,
) -> Face:
    """A face with the texture of these photos.

    Args:
        face: any; textures fit every face.
        views: from :func:`photo_views`.
        texture: ``"project"``, or ``"warp"`` for the paper's five steps on the first photo.
        delight: whether to divide out the light; for projected textures.

    Raises:
        InputError: another way, no photo, or a head turned too far for the warp.
    """
    if texture == "project":
        return face.with_texture(projected_texture(views, delight=delight))
    if texture != "warp":
        raise InputError(f"a texture is made by 'project' or by 'warp', got {texture!r}")
    if delight:
        raise InputError("light is divided out of projected textures alone; leave delight out")
    first = views[0]
    return face.with_texture(uv_texture(first.photo, feature_points(first.found)).image)


def portrait_person() -> tuple[Face, tuple[PhotoView, ...]]:
    """The person in the bundled portrait, and what was found in it; needs no model."""
    views = photo_views([portrait()[0]], [portrait_face()])
    return textured(views[0].shape.face, views).with_name("portrait"), views
