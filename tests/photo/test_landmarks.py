"""Faces are found where they are, whatever the photo; nothing else is a face."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from pdeface.controls import ARKIT
from pdeface.errors import InputError
from pdeface.photo import choose, doubts, find_faces
from pdeface.photo.found import LANDMARKS

MOST_ASIDE = 0.03
"""Of the eye distance: what the detector's answers differ by from one picture size to another."""


def on_grey(photo, size, corner):
    """The photo on a grey picture of (height, width), its top-left corner at (x, y)."""
    wide = np.full((*size, 3), 128, np.uint8)
    x, y = corner
    wide[y : y + photo.shape[0], x : x + photo.shape[1]] = photo
    return wide


def aside(face, other, offset=(0.0, 0.0), scale=1.0) -> float:
    """Mean distance of the landmarks of one from those of another, in eye distances."""
    expected = other.landmarks[:, :2] * scale + offset
    away = np.linalg.norm(face.landmarks[:, :2] - expected, axis=1)
    return float(away.mean() / face.eye_distance)


def test_a_face_is_landmarks_expressions_and_a_pose(collins) -> None:
    assert collins.landmarks.shape == (LANDMARKS, 3)
    assert set(collins.scores) <= set(ARKIT)
    assert len(collins.scores) == 51  # all but the tongue
    assert collins.scores["mouthSmileLeft"] > 0.7 > 0.3 > collins.scores["jawOpen"]
    rotation = collins.pose[:3, :3]
    np.testing.assert_allclose(rotation @ rotation.T, np.eye(3), atol=1e-3)
    assert collins.image_size == (256, 256)


def test_depth_is_smallest_at_the_nose(collins) -> None:
    assert collins.landmarks[:468, 2].argmin() in (1, 4, 5)


@pytest.mark.parametrize("scale", [2, 10])
def test_the_size_of_the_photo_changes_nothing(photo, collins, model, scale) -> None:
    larger = np.repeat(np.repeat(photo, scale, axis=0), scale, axis=1)
    (face,) = find_faces(larger, model)
    assert aside(face, collins, scale=scale) < MOST_ASIDE


def test_where_the_face_is_in_the_photo_changes_nothing(photo, collins, model) -> None:
    (face,) = find_faces(on_grey(photo, (300, 500), (200, 40)), model)
    assert aside(face, collins, offset=(200, 40)) < MOST_ASIDE


def test_a_small_face_in_a_wide_view_is_found(photo, collins, model) -> None:
    (face,) = find_faces(on_grey(photo, (1800, 1800), (1400, 1300)), model)
    assert aside(face, collins, offset=(1400, 1300)) < MOST_ASIDE


def test_a_face_that_fills_the_photo_is_found(photo, collins, model) -> None:
    (face,) = find_faces(photo[85:182, 82:175], model)
    assert aside(face, collins, offset=(-82, -85)) < 3 * MOST_ASIDE


def test_transparent_surroundings_do_no_harm(photo, collins, model) -> None:
    alpha = np.zeros((256, 256, 1), np.uint8)
    alpha[50:200, 60:195] = 255
    (face,) = find_faces(np.dstack([photo, alpha]), model)
    assert aside(face, collins) < 2 * MOST_ASIDE


def test_of_several_faces_the_largest_comes_first(photo, model) -> None:
    wide = on_grey(photo, (512, 900), (30, 100))
    wide[:, 388:] = np.repeat(np.repeat(photo, 2, axis=0), 2, axis=1)
    faces = find_faces(wide, model)
    assert [face.landmarks[0, 0] > 388 for face in faces] == [True, False]
    assert choose(faces) is faces[0]
    assert choose(faces, 2) is faces[1]
    with pytest.raises(InputError, match="from 1 to 2.*got 3"):
        choose(faces, 3)


@pytest.mark.parametrize("size", [(1, 1), (10, 10), (3, 400), (300, 300)])
def test_where_there_is_no_face_none_is_found(model, size) -> None:
    noise = np.random.default_rng(0).integers(0, 256, (*size, 3), dtype=np.uint8)
    assert find_faces(noise, model) == []
    with pytest.raises(InputError, match="no face was found in me.jpg"):
        choose([], 1, "me.jpg")


@pytest.mark.parametrize("shape", [(20, 20), (20, 20, 2), (0, 20, 3)])
def test_what_is_no_photo_is_refused(shape) -> None:
    with pytest.raises(InputError, match="a photo must"):
        find_faces(np.zeros(shape, np.uint8))


def test_what_is_no_model_is_refused(photo, model, tmp_path) -> None:
    (tmp_path / "text.task").write_text("not a model")
    with pytest.raises(InputError, match="cannot read"):
        find_faces(photo, tmp_path / "text.task")


def test_a_good_photo_leaves_no_doubt(photo, model) -> None:
    larger = np.repeat(np.repeat(photo, 2, axis=0), 2, axis=1)
    assert doubts(find_faces(larger, model)[0], larger) == []


def test_what_a_photo_lacks_is_told(photo, collins) -> None:
    (small,) = doubts(collins, photo)
    assert "small" in small
    assert "dark" in doubts(collins, photo // 5)[1]


@pytest.mark.parametrize(("angle", "words"), [(0.5, "to its left"), (-0.5, "to its right")])
def test_a_turned_head_is_told(photo, collins, angle, words) -> None:
    pose = np.eye(4)
    pose[0, 0] = pose[2, 2] = np.cos(angle)
    pose[0, 2], pose[2, 0] = np.sin(angle), -np.sin(angle)
    assert words in doubts(replace(collins, pose=pose), photo)[1]


@pytest.mark.parametrize(
    ("closed", "words"), [(["Left"], "the left eye is"), (["Left", "Right"], "both eyes are")]
)
def test_closed_eyes_are_told(photo, collins, closed, words) -> None:
    scores = {**collins.scores, **{f"eyeBlink{side}": 0.9 for side in closed}}
    assert words in doubts(replace(collins, scores=scores), photo)[1]
