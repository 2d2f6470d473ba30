"""The 25 feature points that are found are those that a person placed."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from pdeface.errors import InputError
from pdeface.photo import feature_points, find_faces
from pdeface.texture import FeaturePoints, portrait, uv_texture

WITHIN = ("middle", "centre", "nostril", "corner", "lip", "nose_tip")


def errors(points: FeaturePoints) -> dict[str, float]:
    """Distance of each point from the one placed by hand, in eye distances."""
    placed = portrait()[1].positions
    eyes = np.subtract(placed["left_eye_middle"], placed["right_eye_middle"])
    return {
        name: float(np.linalg.norm(np.subtract(points.positions[name], place)))
        / float(np.linalg.norm(eyes))
        for name, place in placed.items()
    }


def test_they_are_where_a_person_placed_them(collins) -> None:
    found = errors(feature_points(collins))
    assert np.mean(list(found.values())) < 0.06
    # Where a feature is, people agree; where along the jaw a point of it is, they do not.
    assert max(e for name, e in found.items() if any(word in name for word in WITHIN)) < 0.08
    assert max(found.values()) < 0.16


def test_an_open_mouth_has_edges_and_a_closed_one_has_none(collins) -> None:
    assert {"upper_lip", "lower_lip"} <= set(feature_points(collins).positions)
    marks = collins.landmarks.copy()
    marks[[13, 14]] = marks[[13, 14]].mean(axis=0)
    closed = feature_points(replace(collins, landmarks=marks))
    assert len(closed.positions) == 25


@pytest.mark.parametrize("quarters", [1, 2, 3])
def test_they_turn_with_the_photo(photo, collins, quarters) -> None:
    marks = collins.landmarks.copy()
    for _ in range(quarters):
        marks[:, :2] = np.stack([marks[:, 1], 256 - marks[:, 0]], axis=1)
    turned = feature_points(replace(collins, landmarks=marks)).array
    upright = feature_points(collins).array
    for _ in range(quarters):
        upright = np.stack([upright[..., 1], 256 - upright[..., 0]], axis=-1)
    np.testing.assert_allclose(turned, upright, atol=1e-9)


def test_a_mirrored_face_has_mirrored_points(photo, model) -> None:
    mirrored = feature_points(find_faces(np.ascontiguousarray(photo[:, ::-1]), model)[0]).array
    expected = feature_points(find_faces(photo, model)[0]).array[:, ::-1] * (-1, 1) + (256, 0)
    assert np.abs(mirrored - expected).max() < 0.1 * 44


def test_points_of_a_cropped_face_lie_in_the_photo_and_can_be_used(photo, model) -> None:
    cropped = photo[:170, :]
    points = feature_points(find_faces(cropped, model)[0])
    assert points.array[..., 1].max() <= 170
    assert uv_texture(cropped, points).image.any()


def test_a_head_that_is_turned_too_far_is_refused(collins) -> None:
    marks = collins.landmarks.copy()
    marks[:, 0] = 128 + 0.2 * (marks[:, 0] - 128) + marks[:, 2]  # as seen from the side
    with pytest.raises(InputError, match="turned too far.*use a photo from the front"):
        feature_points(replace(collins, landmarks=marks))
