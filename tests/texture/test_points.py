"""Feature points: their file, and what is said of points that cannot be used."""

from __future__ import annotations

import copy
import json
import math
import pickle

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from pdeface.errors import FileFormatError, InputError
from pdeface.texture import POINT_NAMES, FeaturePoints

ALL_NAMES = [name for row in POINT_NAMES for name in row]
SHAPE = (200, 160, 3)


def moved(points: FeaturePoints, **positions: tuple[float, float]) -> FeaturePoints:
    return FeaturePoints({**points.positions, **positions}, points.image_size)


def turned(points: FeaturePoints, degrees: float) -> FeaturePoints:
    """The points of the photo turned clockwise about its middle, in a frame large enough."""
    cos, sin = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    turn = np.array([[cos, -sin], [sin, cos]])
    return FeaturePoints.from_array((points.array - (80, 100)) @ turn.T + 150, (300, 300))


def test_the_names_are_the_papers():
    assert [len(row) for row in POINT_NAMES] == [5] * 5
    assert len(set(ALL_NAMES)) == 25
    for row in POINT_NAMES[:4]:  # a row reads from the subject's right to left
        assert [name.split("_")[0] for name in row[:2]] == ["right", "right"]
        assert [name.split("_")[0] for name in row[3:]] == ["left", "left"]


def test_a_file_gives_back_what_was_saved(face_points, tmp_path):
    path = tmp_path / "me.json"
    face_points.save(path)
    loaded = FeaturePoints.load(path)
    assert loaded == face_points
    content = json.loads(path.read_text())
    assert content["format"] == "pdeface-points"
    assert content["version"] == 1
    assert content["image"] == {"width": 160, "height": 200}
    assert content["points"]["nose_tip"] == [80, 96]
    # One point a line, so that a person can find and change it.
    assert sum('": [' in line for line in path.read_text().splitlines()) == 25


@given(st.lists(st.floats(-1e4, 1e4), min_size=50, max_size=50))
def test_any_finite_positions_survive_a_file(tmp_path_factory, numbers):
    points = FeaturePoints.from_array(np.reshape(numbers, (25, 2)), (300, 400))
    path = tmp_path_factory.mktemp("points") / "p.json"
    points.save(path)
    np.testing.assert_allclose(FeaturePoints.load(path).array, points.array, rtol=1e-9)


def test_points_are_a_value(face_points):
    assert copy.deepcopy(face_points) == face_points
    assert pickle.loads(pickle.dumps(face_points)) == face_points
    with pytest.raises(TypeError):
        face_points.positions["nose_tip"] = (0, 0)


@pytest.mark.parametrize("name", ALL_NAMES)
def test_a_missing_point_is_named(face_points, name):
    positions = {key: value for key, value in face_points.positions.items() if key != name}
    with pytest.raises(InputError, match=f"{name} is missing"):
        FeaturePoints(positions, (160, 200))


def test_an_unknown_point_is_told_its_nearest_name(face_points):
    positions = dict(face_points.positions)
    positions["right_eyebrow_middle"] = positions.pop("right_brow_middle")
    with pytest.raises(InputError, match="did you mean right_brow_middle"):
        FeaturePoints(positions, (160, 200))
    with pytest.raises(InputError, match=r"'xyz' is not one.*chin_5"):
        FeaturePoints({**face_points.positions, "xyz": (1, 2)}, (160, 200))


@pytest.mark.parametrize(
    "position",
    [(math.nan, 3), (3, math.inf), (1,), (1, 2, 3), "12", None, ("a", 1), (1e400, 0), 5, (None, 1)],
)
def test_a_position_is_two_finite_numbers(face_points, position):
    with pytest.raises(InputError, match="chin_2 must be two finite numbers"):
        moved(face_points, chin_2=position)


@pytest.mark.parametrize("size", [(0, 5), (5,), None, "ab", (math.nan, 5), (math.inf, 5)])
def test_the_size_of_the_image(face_points, size):
    with pytest.raises(InputError, match="image_size"):
        FeaturePoints(face_points.positions, size)


def test_good_points_are_valid(face_points):
    face_points.validate(SHAPE)


@pytest.mark.parametrize("degrees", [-170, -90, -45, -10, 30, 90, 180])
def test_a_head_may_be_held_at_any_angle(face_points, degrees):
    turned(face_points, degrees).validate((300, 300))


@pytest.mark.parametrize("position", [(-0.1, 50), (50, -1), (160.1, 50), (50, 201)])
def test_a_point_outside_the_photo_is_named(face_points, position):
    with pytest.raises(InputError, match="left_nostril at .* outside the photo of 160 x 200"):
        moved(face_points, left_nostril=position).validate(SHAPE)


@pytest.mark.parametrize(
    ("one", "other"),
    [
        ("right_mouth_corner", "mouth_centre"),
        ("left_nostril", "nose_tip"),
        ("chin_4", "left_mouth_corner"),
        ("brow_centre", "eyes_centre"),
        ("left_brow_extension", "left_brow_middle"),
    ],
)
@pytest.mark.parametrize("degrees", [0, 25, 180])
def test_swapped_points_are_named(face_points, one, other, degrees):
    swap = {one: face_points.positions[other], other: face_points.positions[one]}
    with pytest.raises(InputError, match="crossing order") as error:
        turned(moved(face_points, **swap), degrees).validate((300, 300))
    assert one in str(error.value) or other in str(error.value)


def test_swapped_eyes_are_named(face_points):
    positions = face_points.positions
    swapped = moved(
        face_points,
        right_eye_middle=positions["left_eye_middle"],
        left_eye_middle=positions["right_eye_middle"],
    )
    with pytest.raises(InputError, match="right_eye_middle to left_eye_middle"):
        swapped.validate(SHAPE)


def test_left_and_right_are_the_subjects(face_points):
    mirrored = FeaturePoints.from_array(face_points.array[:, ::-1], (160, 200))
    with pytest.raises(InputError, match="left and right are swapped"):
        mirrored.validate(SHAPE)


def test_points_follow_a_scaled_photo(face_points):
    scaled = face_points.scaled_to((400, 320, 3))
    np.testing.assert_allclose(scaled.array, 2 * face_points.array)
    assert scaled.image_size == (320, 400)
    assert face_points.scaled_to(SHAPE) is face_points
    with pytest.raises(InputError, match="160 x 200 pixels, this one has 200 x 160"):
        face_points.scaled_to((160, 200))


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "expected JSON"),
        ("{", "expected JSON"),
        ("[1, 2]", "pdeface-points"),
        ('{"format": "other"}', "pdeface-points"),
        ('{"format": "pdeface-points"}', '"version": 1, got None'),
        ('{"format": "pdeface-points", "version": true}', '"version": 1, got True'),
        ('{"format": "pdeface-points", "version": 2}', "install a newer pdeface"),
        ('{"format": "pdeface-points", "version": 1}', '"image"'),
        ('{"format": "pdeface-points", "version": 1, "image": {}, "points": []}', '"points"'),
        ('{"format": "pdeface-points", "format": "pdeface-points"}', "'format' twice"),
        ("[" * 100_000, "expected JSON"),
        ("\x00\x01", "expected JSON"),
    ],
)
def test_a_damaged_file_is_named(tmp_path, text, message):
    path = tmp_path / "points.json"
    path.write_text(text)
    with pytest.raises(FileFormatError, match=message) as error:
        FeaturePoints.load(path)
    assert str(path) in str(error.value)
    assert "\n" not in str(error.value)


def test_bytes_that_are_no_text(tmp_path):
    path = tmp_path / "points.json"
    path.write_bytes(b"\xff\xfe\x00{")
    with pytest.raises(FileFormatError, match="expected JSON"):
        FeaturePoints.load(path)


def test_a_bad_point_in_a_file_names_the_file(face_points, tmp_path):
    path = tmp_path / "points.json"
    face_points.save(path)
    path.write_text(path.read_text().replace('"nose_tip": [80, 96]', '"nose_tip": [80, NaN]'))
    with pytest.raises(InputError, match=r"points\.json: nose_tip must be two finite numbers"):
        FeaturePoints.load(path)


@pytest.mark.parametrize("name", ["absent.json", "."])
def test_a_file_that_cannot_be_read(tmp_path, name):
    with pytest.raises(InputError, match="cannot read the points file"):
        FeaturePoints.load(tmp_path / name)
