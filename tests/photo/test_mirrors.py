"""Faces found in mirror images, and the mean of both ways."""

from __future__ import annotations

import numpy as np
import pytest

from pdeface.photo import find_faces, portrait_face
from pdeface.photo.mirrors import evened, unmirrored
from pdeface.texture import portrait


def test_a_mirror_image_of_a_mirror_image_is_the_face() -> None:
    face = portrait_face()
    again = unmirrored(unmirrored(face, 100.0), 100.0)
    np.testing.assert_allclose(again.landmarks, face.landmarks, atol=1e-12)
    np.testing.assert_allclose(again.pose, face.pose, atol=1e-12)
    assert again.scores == face.scores


def test_left_and_right_change_places_in_a_mirror() -> None:
    face = portrait_face()
    other = unmirrored(face, 128.0)
    assert other.yaw == pytest.approx(-face.yaw)
    assert other.pitch == pytest.approx(face.pitch)
    assert other.scores["eyeBlinkLeft"] == face.scores["eyeBlinkRight"]
    assert other.across[0] > 0.0, "the right eye is still the one on the left of the picture"
    np.testing.assert_allclose(other.landmarks[:, 0].mean(), 256.0 - face.landmarks[:, 0].mean())


def test_faces_are_evened_with_those_near_by_alone() -> None:
    face = portrait_face()
    away = unmirrored(face, 1000.0)
    (same,) = evened([face], [away])
    assert same is face
    (mean,) = evened([face], [away, face])
    np.testing.assert_allclose(mean.landmarks, face.landmarks, atol=1e-12)
    np.testing.assert_allclose(mean.pose, face.pose, atol=1e-6)


def test_a_photo_and_its_mirror_image_show_the_same_face(model) -> None:
    photo = portrait()[0]
    (one,) = find_faces(photo, model)[:1]
    (other,) = find_faces(np.ascontiguousarray(photo[:, ::-1]), model)[:1]
    back = unmirrored(other, 0.5 * photo.shape[1])
    away = np.linalg.norm((back.landmarks - one.landmarks)[:, :2], axis=1) / one.eye_distance
    # Where the face is looked at from near by may differ by a pixel or two.
    assert np.sqrt((away**2).mean()) < 0.01
