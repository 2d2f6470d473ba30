"""Faces from photographs: landmarks, the paper's feature points and the person's shape from them.

    from pdeface.photo import feature_points, find_faces, fit_shape
    from pdeface.texture import read_photo, uv_texture

    photo = read_photo("me.jpg")
    face = find_faces(photo)[0]
    texture = uv_texture(photo, feature_points(face))
    person = pdeface.neutral().with_weights(fit_shape(face).identity).with_texture(texture.image)

The landmarks are found by MediaPipe (extra ``photo``) on this machine; nothing is sent anywhere.
Its model is fetched once, by :func:`model_file`, unless it is given.
"""

from __future__ import annotations

from pdeface.photo.doubts import doubts
from pdeface.photo.found import PhotoFace, choose
from pdeface.photo.landmarker import find_faces
from pdeface.photo.model import model_file
from pdeface.photo.points import feature_points
from pdeface.photo.shape import PhotoShape, fit_shape
from pdeface.photo.texturing import PhotoView, projected_texture

__all__ = [
    "PhotoFace",
    "PhotoShape",
    "PhotoView",
    "choose",
    "doubts",
    "feature_points",
    "find_faces",
    "fit_shape",
    "model_file",
    "projected_texture",
]
