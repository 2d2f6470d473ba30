"""A track is a value: checked, unchangeable, and between its samples a straight line."""

from __future__ import annotations

import copy
import pickle

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from pdeface.errors import InputError
from pdeface.motion import ARKIT_NAMES, Track
from pdeface.motion.names import both_sides

NAMES = ("jawOpen", "eyeBlinkLeft")


@st.composite
def tracks(draw: st.DrawFn) -> Track:
    steps = draw(st.lists(st.floats(1e-4, 2), min_size=0, max_size=12))
    times = np.concatenate([[draw(st.floats(0, 5))], steps]).cumsum()
    names = draw(st.lists(st.sampled_from(ARKIT_NAMES), unique=True, max_size=4))
    random = np.random.default_rng(draw(st.integers(0, 99)))
    angles = random.normal(size=(3, len(times), 3))
    return Track(times, tuple(names), random.random((len(times), len(names))), *angles)


def small(**changes: object) -> Track:
    parts: dict[str, object] = {
        "times": [0, 0.5, 2],
        "names": NAMES,
        "weights": [[0, 1], [1, 0.5], [0, 0]],
        "head": [[0, 0, 0], [0.2, 0, 0], [0.2, 0.3, -0.3]],
    }
    return Track(**{**parts, **changes})


def test_between_samples_a_straight_line():
    pose = small().at(0.25)
    assert pose.weights == {"jawOpen": 0.5, "eyeBlinkLeft": 0.75}
    assert pose.head == pytest.approx((0.1, 0, 0))
    assert pose.left_eye == pose.right_eye == (0, 0, 0)


def test_before_and_after_it_holds():
    track = small(times=[1, 1.5, 3])
    assert track.at(-5) == track.at(0) == track.at(1)
    assert track.at(1e9) == track.at(3)
    assert track.duration == 2


@given(tracks())
def test_at_a_sample_it_is_the_sample(track):
    for place, time in enumerate(track.times):
        pose = track.at(time)
        assert list(pose.weights.values()) == track.weights[place].tolist()
        assert pose.head == tuple(track.head[place])


@given(tracks(), st.floats(0.5, 240))
def test_resampling_stays_on_the_lines(track, fps):
    resampled = track.resampled(fps)
    assert resampled.fps == fps
    np.testing.assert_allclose(np.diff(resampled.times), 1 / fps, rtol=1e-6)
    assert resampled.times[0] == track.times[0]
    assert 0 <= track.times[-1] - resampled.times[-1] + 1e-5 < 1 / fps + 2e-5
    for place in range(0, len(resampled), 1 + len(resampled) // 20):
        pose = track.at(resampled.times[place])
        assert list(pose.weights.values()) == resampled.weights[place].tolist()
        assert pose.left_eye == tuple(resampled.left_eye[place])


def test_a_whole_number_of_frames_keeps_its_end():
    for fps in (24, 25, 29.97, 30, 60, 1000 / 3):
        track = Track([0, 100 / fps], ("jawOpen",), [[0], [1]])
        assert len(track.resampled(fps)) == 101


@given(tracks(), st.floats(0, 1), st.floats(0, 1))
def test_a_slice_is_that_part(track, one, other):
    first, last = sorted([one, other])
    end = float(track.times[-1])
    part = track.slice(first * end, last * end)
    assert part.times[0] == 0
    assert part.duration == pytest.approx((last - first) * end, abs=1e-12)
    for share in (0, 0.3, 1):
        moment = part.duration * share
        np.testing.assert_allclose(
            part.at(moment).head, track.at(first * end + moment).head, atol=1e-9
        )


def test_a_slice_to_the_end_keeps_all_samples():
    track = small()
    assert track.slice(0) == track
    assert track.slice(0, 99) == track
    np.testing.assert_allclose(track.slice(0.25).times, [0, 0.25, 1.75])


def test_weights_are_asked_for_by_name():
    weights = small().weights_of(("eyeBlinkLeft", "tongueOut", "jawOpen", "viseme_aa"))
    np.testing.assert_array_equal(weights, [[1, 0, 0, 0], [0.5, 0, 1, 0], [0, 0, 0, 0]])


@given(tracks())
def test_a_track_is_a_value(track):
    for twin in (copy.deepcopy(track), pickle.loads(pickle.dumps(track))):
        assert twin == track
        assert not twin.weights.flags.writeable
    assert track != track.slice(0).resampled(1.0) or len(track) == 1
    with pytest.raises(ValueError, match="read-only"):
        track.times[0] = 1


def test_arrays_are_copied():
    times = np.array([0.0, 1.0])
    track = Track(times, ("jawOpen",), [[0], [1]])
    times[0] = 0.5
    assert track.times[0] == 0
    assert repr(track) == "Track(2 samples of 1 blendshapes, 1.000 seconds)"


def test_a_track_may_have_angles_alone():
    track = Track([0, 1], (), np.zeros((2, 0)), head=[[0, 0, 0], [1, 0, 0]])
    assert track.at(0.5).head[0] == 0.5
    assert track.at(0.5).weights == {}


@pytest.mark.parametrize(
    ("changes", "says"),
    [
        ({"times": []}, r"shape \(samples,\), one or more, got \(0,\)"),
        ({"times": [[0, 1, 2]]}, r"got \(1, 3\)"),
        ({"times": [0, 1, 1]}, "must increase, got 1 after 1 at sample 2"),
        ({"times": [0, 2, 1]}, "must increase, got 1 after 2 at sample 2"),
        ({"times": [-1, 0, 1]}, "count from 0, got -1 first"),
        ({"times": [0, np.nan, 1]}, "finite numbers, got nan for times at sample 1"),
        ({"times": "soon"}, "must be an array of numbers, got str"),
        ({"names": ("jawOpen", "eyeblinkLeft")}, "got 'eyeblinkLeft'; did you mean eyeBlinkLeft"),
        ({"names": ("jawOpen", "jawOpen")}, "jawOpen twice"),
        ({"names": "jawOpen"}, "put it in a list"),
        ({"names": ("jawOpen",)}, r"need shape \(3, 1\), got \(3, 2\)"),
        ({"weights": [[0, 1], [0], [1, 1]]}, "weights of a track must be an array of numbers"),
        ({"weights": [[0, 1], [np.inf, 0], [1, 1]]}, "got inf for jawOpen at sample 1"),
        ({"weights": [[0, 1], [0, 1.5], [1, 1]]}, "got 1.5 for eyeBlinkLeft at sample 1"),
        ({"weights": [[0, 1], [0, 0.5], [-1e-9, 1]]}, "got -1e-09 for jawOpen at sample 2"),
        ({"head": np.zeros((3, 2))}, r"head of 3 samples needs shape \(3, 3\), got \(3, 2\)"),
        ({"left_eye": np.full((3, 3), np.nan)}, "got nan for left_eye yaw at sample 0"),
        ({"fps": 0}, "more than 0 frames a second, got 0"),
        ({"fps": "60"}, "expected a number of frames a second, got '60'"),
    ],
)
def test_what_is_no_track(changes, says):
    with pytest.raises(InputError, match=says) as caught:
        small(**changes)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("time", [np.nan, np.inf, "1", None, True])
def test_what_is_no_time(time):
    with pytest.raises(InputError, match="expected a time in seconds"):
        small().at(time)


@pytest.mark.parametrize(("start", "stop"), [(-1, 1), (1, 0.5), (2.5, None), (2.5, 3)])
def test_what_is_no_part(start, stop):
    with pytest.raises(InputError, match="0 <= start <= stop within the track's 2 seconds"):
        small().slice(start, stop)


def test_too_many_samples():
    with pytest.raises(InputError, match="at most 10000000 samples, got 2e"):
        small().resampled(1e9)


def test_the_names_are_arkits(shared_data):
    assert tuple((shared_data / "arkit52.txt").read_text().split()) == ARKIT_NAMES


def test_both_sides_of_a_name():
    assert both_sides(mouthSmile=0.5, jawLeft=0.1) == {
        "mouthSmileLeft": 0.5,
        "mouthSmileRight": 0.5,
        "jawLeft": 0.1,
    }
    with pytest.raises(InputError, match="got 'mouthSmil'"):
        both_sides(mouthSmil=0.5)
