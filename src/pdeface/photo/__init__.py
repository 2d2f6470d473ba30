"""Faces from photographs: landmarks, the person's shape, and a texture.

    from pdeface.photo import find_faces, photo_views, textured
    from pdeface.texture import read_photo

    photo = read_photo("me.jpg")
    views = photo_views([photo], [find_faces(photo)[0]])
    person = textured(views[0].shape.face, views)

The landmarks are found by MediaPipe (extra ``photo``) on this machine; nothing is sent anywhere.
Its model is fetched once, by :func:`model_file`, unless it is given.
"""

from __future__ import annotations

from pdeface.photo.bundled import portrait_face
from pdeface.photo.covering import COVERED, covered
from pdeface.photo.doubts import doubts
from pdeface.photo.found import PhotoFace, choose
from pdeface.photo.landmarker import find_faces, glances
from pdeface.photo.lens import focal_length
from pdeface.photo.model import model_file
from pdeface.photo.person import TextureWay, photo_views, portrait_person, textured
from pdeface.photo.points import feature_points
from pdeface.photo.reporting import photo_report
from pdeface.photo.shape import PhotoShape, fit_shape, fit_shapes
from pdeface.photo.texturing import PhotoView, projected_texture

__all__ = [
    "COVERED",
    "PhotoFace",
    "PhotoShape",
    "PhotoView",
    "TextureWay",
    "choose",
    "covered",
    "doubts",
    "feature_points",
    "find_faces",
    "fit_shape",
    "fit_shapes",
    "focal_length",
    "glances",
    "model_file",
    "photo_report",
    "photo_views",
    "portrait_face",
    "portrait_person",
    "projected_texture",
    "textured",
]
