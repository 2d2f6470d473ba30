from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from pdeface.errors import InputError
from pdeface.pictures.camera import VIEWS, frame, parse_view

BOX = np.array([[x, y, z] for x in (-0.08, 0.08) for y in (-0.1, 0.1) for z in (0.0, 0.12)])
SIZE = (400, 500)
clouds = arrays(np.float64, (6, 3), elements=st.floats(-1.0, 1.0, width=16))
angles = st.floats(-180.0, 180.0)
tilts = st.floats(-80.0, 80.0)


def test_the_subjects_left_is_on_the_right_of_a_front_view() -> None:
    left, _ = frame(BOX).project(np.array([0.05, 0.0, 0.1]), SIZE)
    right, _ = frame(BOX).project(np.array([-0.05, 0.0, 0.1]), SIZE)
    assert left[0] > SIZE[0] / 2 > right[0]


def test_up_is_up() -> None:
    above, _ = frame(BOX).project(np.array([0.0, 0.1, 0.0]), SIZE)
    below, _ = frame(BOX).project(np.array([0.0, -0.1, 0.0]), SIZE)
    assert above[1] < below[1]


@pytest.mark.parametrize("azimuth", [20.0, "three-quarter", "profile", "45"])
def test_a_positive_azimuth_goes_to_the_subjects_left(azimuth: float | str) -> None:
    camera = frame(BOX, azimuth)
    assert camera.position[0] > 0.1
    nose, _ = camera.project(np.array([0.0, 0.0, 0.12]), SIZE)
    assert nose[0] < SIZE[0] / 2


def test_elevation_looks_from_above() -> None:
    assert frame(BOX, (0.0, 30.0)).position[1] > 0.1


@given(points=clouds, azimuth=angles, elevation=tilts, aspect=st.floats(0.3, 3.0))
def test_everything_is_in_the_picture(
    points: np.ndarray, azimuth: float, elevation: float, aspect: float
) -> None:
    points = points + np.array([[0.0, 0.0, 0.1], *[[0.0, 0.0, 0.0]] * 5])
    camera = frame(points, (azimuth, elevation), aspect)
    xy, depth = camera.project(points, (round(1000 * aspect), 1000))
    assert np.all(depth > 0.0)
    assert xy.min() >= 0.0
    assert np.all(xy <= [round(1000 * aspect), 1000])


@given(azimuth=st.floats(-90.0, 90.0))
def test_the_distance_is_the_same_all_around_the_front(azimuth: float) -> None:
    turned = np.round(azimuth / 15.0) * 15.0
    assert frame(BOX, turned).distance == pytest.approx(frame(BOX).distance)


def test_the_picture_axes_are_orthonormal_and_right_handed() -> None:
    camera = frame(BOX, (33.0, -21.0))
    axes = np.stack([camera.right, camera.up, camera.backward])
    np.testing.assert_allclose(axes @ axes.T, np.eye(3), atol=1e-12)
    assert np.linalg.det(axes) == pytest.approx(1.0)
    towards = camera.position - camera.target
    np.testing.assert_allclose(towards / camera.distance, camera.backward, atol=1e-12)


def test_a_pixel_is_as_large_as_it_says() -> None:
    camera = frame(BOX)
    step = camera.pixel_size(SIZE[1])
    pair = np.stack([camera.target, camera.target + step * camera.right])
    xy, _ = camera.project(pair, SIZE)
    np.testing.assert_allclose(xy[1] - xy[0], [1.0, 0.0], atol=1e-9)


@pytest.mark.parametrize(
    ("view", "angles"),
    [
        ("front", (0.0, 0.0)),
        ("profile-right", (-90.0, 0.0)),
        (12, (12.0, 0.0)),
        ("-35", (-35.0, 0.0)),
        ("35,10", (35.0, 10.0)),
        ((35, 10), (35.0, 10.0)),
        (np.float32(1.5), (1.5, 0.0)),
    ],
)
def test_views(view: object, angles: tuple[float, float]) -> None:
    assert parse_view(view) == angles  # type: ignore[arg-type]


def test_every_named_view_can_be_framed() -> None:
    cameras = [frame(BOX, view) for view in VIEWS]
    assert len({tuple(np.round(c.backward, 6)) for c in cameras}) == len(VIEWS)


@pytest.mark.parametrize("view", ["sideways", "1,2,3", (1, 2, 3), float("nan"), None, "0,95", ""])
def test_what_is_no_view_is_refused(view: object) -> None:
    with pytest.raises(InputError, match="view"):
        parse_view(view)  # type: ignore[arg-type]
