"""Faces from photographs: landmarks, and the paper's feature points from them.

    from pdeface.photo import feature_points, find_faces
    from pdeface.texture import read_photo, uv_texture

    photo = read_photo("me.jpg")
    face = find_faces(photo)[0]
    texture = uv_texture(photo, feature_points(face))

The landmarks are found by MediaPipe (extra ``photo``) on this machine; nothing is sent anywhere.
Its model is fetched once, by :func:`model_file`, unless it is given.
"""

from __future__ import annotations

from pdeface.photo.doubts import doubts
from pdeface.photo.found import PhotoFace, choose
from pdeface.photo.landmarker import find_faces
from pdeface.photo.model import model_file
from pdeface.photo.points import feature_points

__all__ = ["PhotoFace", "choose", "doubts", "feature_points", "find_faces", "model_file"]
