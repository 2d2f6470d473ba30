"""Built-in clips: smooth, at rest at both ends, timed as people are."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from pdeface.errors import InputError
from pdeface.motion import ARKIT_NAMES, CLIPS, VISEMES, VRM_PRESETS, clip
from pdeface.motion.easing import bump, eased, through, window
from pdeface.motion.gaze import EYE_RANGE, eye_angles, look_weights
from pdeface.motion.speech import mouth_weights

ALL = sorted(CLIPS)
FINE = np.linspace(-0.5, 3, 3501)


def curve(track, name: str) -> np.ndarray:
    return track.weights_of([name])[:, 0]


@pytest.mark.parametrize("name", ALL)
def test_a_clip_begins_and_ends_at_rest(name):
    track = clip(name)
    assert track.fps == 60
    assert track.times[0] == 0
    for end in (0, -1):
        assert not track.weights[end].any()
        assert not track.head[end].any()
        assert not track.left_eye[end].any()
    assert clip(name) == track  # the same every time


@pytest.mark.parametrize("name", ALL)
def test_a_clip_is_smooth(name):
    """Where a curve has no corner, the slope changes ever less between ever closer samples."""
    jumps = []
    for fps in (4_000, 16_000):
        track = clip(name, fps)
        curves = np.hstack([track.weights, track.head, track.left_eye, track.right_eye])
        jumps.append(np.abs(np.diff(curves, 2, axis=0)).max() * fps)
    assert jumps[1] < 0.4 * jumps[0]


@pytest.mark.parametrize("name", ALL)
@pytest.mark.parametrize("fps", [24, 29.97, 120])
def test_a_clip_is_the_same_motion_at_any_rate(name, fps):
    track, usual = clip(name, fps), clip(name)
    assert track.duration == pytest.approx(usual.duration, abs=1 / fps)
    for time in track.times[:: round(fps / 3)]:
        # The quickest leap of the eyes takes 60 ms.
        assert track.at(time).head == pytest.approx(usual.at(time).head, abs=0.01)


@pytest.mark.parametrize("name", ALL)
def test_the_mouth_never_closes_more_than_the_jaw_opened(name):
    close, jaw = clip(name).weights_of(("mouthClose", "jawOpen")).T
    assert (close <= jaw + 1e-12).all()


@pytest.mark.parametrize("name", ALL)
def test_the_eyes_angles_say_what_the_weights_say(name):
    track = clip(name)
    for side, angles in (("Left", track.left_eye), ("Right", track.right_eye)):
        outwards = curve(track, f"eyeLookOut{side}") - curve(track, f"eyeLookIn{side}")
        down = curve(track, f"eyeLookDown{side}") - curve(track, f"eyeLookUp{side}")
        to_the_left = outwards if side == "Left" else -outwards
        np.testing.assert_allclose(angles[:, 0], EYE_RANGE * to_the_left, atol=1e-12)
        np.testing.assert_allclose(angles[:, 1], EYE_RANGE * down, atol=1e-12)


def test_an_unknown_clip():
    with pytest.raises(InputError, match="got 'blinks'; did you mean blink"):
        clip("blinks")
    with pytest.raises(InputError, match="use one of blink, smile, look, talk"):
        clip("xyz")
    with pytest.raises(InputError, match="more than 0 frames a second"):
        clip("blink", 0)


def test_a_blink_takes_as_long_as_peoples():
    track = clip("blink", 1000)
    closed = curve(track, "eyeBlinkLeft")
    np.testing.assert_array_equal(closed, curve(track, "eyeBlinkRight"))
    begins, ends = track.times[np.flatnonzero(closed)[[0, -1]]]
    shut = track.times[closed > 1 - 1e-9]
    assert 0.08 <= shut[0] - begins <= 0.1
    assert 0.15 <= ends - shut[-1] <= 0.2
    assert shut[-1] - shut[0] < 0.05
    # Lids close faster than they open, and the lower ones squint a little.
    assert (np.diff(closed)[: int(shut[0] * 1000)] >= -1e-12).all()
    assert (np.diff(closed)[int(shut[0] * 1000) :] <= 1e-12).all()
    assert 0.05 < curve(track, "eyeSquintLeft").max() < 0.3


def test_a_blink_shuts_the_eyes_in_every_usual_film():
    for fps in (24, 25, 29.97, 30, 50, 59.94, 60):
        assert curve(clip("blink", fps), "eyeBlinkLeft").max() > 0.97


def test_eyes_look_around_and_the_head_follows():
    track = clip("look")
    seconds = track.times
    gaze = track.head + track.left_eye
    assert track.left_eye[:, 0].max() > 0.3
    assert track.left_eye[:, 0].min() < -0.3
    assert track.left_eye[:, 1].max() > 0.2
    assert track.left_eye[:, 1].min() < -0.2
    # The eyes arrive well before the head, and what they look at stays put meanwhile.
    arrived = seconds[gaze[:, 0] > 0.34][0]
    turned = seconds[track.head[:, 0] > 0.11][0]
    assert turned - arrived > 0.1
    still = (seconds > arrived + 0.05) & (seconds < 1.45)
    assert np.ptp(gaze[still, 0]) < 0.005


def test_a_smile_reaches_the_eyes():
    pose = clip("smile").at(1.3)
    assert pose.weights["mouthSmileLeft"] > 0.7
    assert pose.weights["cheekSquintLeft"] > 0.4
    assert pose.weights["eyeBlinkLeft"] == 0


def test_talk_speaks_blinks_and_nods():
    track = clip("talk")
    jaw = curve(track, "jawOpen")
    opened = (jaw[1:-1] > jaw[:-2]) & (jaw[1:-1] >= jaw[2:]) & (jaw[1:-1] > 0.1)
    assert 8 < opened.sum() < 30  # syllables, in under five seconds
    assert curve(track, "eyeBlinkLeft").max() == pytest.approx(1, abs=0.01)
    assert 0.03 < np.abs(track.head).max() < 0.3
    # Whoever listens is looked at: the eyes turn against the head.
    gaze = track.head[:, 0] + track.left_eye[:, 0]
    assert np.abs(gaze).max() < 0.35 * np.abs(track.head[:, 0]).max()


# ---- visemes and speech ---------------------------------------------------------------------


def test_there_are_fifteen_visemes():
    order = "sil PP FF TH DD kk CH SS nn RR aa E I O U"
    assert list(VISEMES) == [f"viseme_{name}" for name in order.split()]
    assert not VISEMES["viseme_sil"]


@pytest.mark.parametrize("data", [VISEMES, VRM_PRESETS], ids=["visemes", "presets"])
def test_shapes_are_weights_of_controls_there_are(data):
    for weights in data.values():
        assert set(weights) <= set(ARKIT_NAMES) - {"tongueOut"}
        assert all(0 < weight <= 1 for weight in weights.values())
        assert weights.get("mouthClose", 0) <= weights.get("jawOpen", 0)
    shapes = [tuple(sorted(weights.items())) for weights in data.values()]
    assert len(set(shapes)) == len(shapes)
    with pytest.raises(TypeError):
        data["new"] = {}


def test_both_sides_of_a_mouth_speak_alike():
    for weights in VISEMES.values():
        for name, weight in weights.items():
            if name.endswith("Left"):
                assert weights[name.replace("Left", "Right")] == weight


def test_the_presets_are_those_of_vrm_1():
    names = (
        "happy angry sad relaxed surprised aa ih ou ee oh blink blinkLeft blinkRight "
        "lookUp lookDown lookLeft lookRight neutral"
    )
    assert set(VRM_PRESETS) == set(names.split())
    assert VRM_PRESETS["lookLeft"] == {"eyeLookOutLeft": 1, "eyeLookInRight": 1}
    assert VRM_PRESETS["blinkRight"] == {"eyeBlinkRight": 1}
    assert not VRM_PRESETS["neutral"]


words = st.lists(st.tuples(st.sampled_from(list(VISEMES)), st.floats(0.03, 0.4)), min_size=1)


@given(words, st.floats(0, 1))
def test_speech_stays_within_its_visemes(spoken, start):
    times = np.linspace(-1, 15, 800)
    weights = mouth_weights(times, spoken, start)
    length = sum(seconds for _, seconds in spoken)
    silent = (times < start - 0.09) | (times > start + length + 0.09)
    for name, values in weights.items():
        highest = max(VISEMES[viseme].get(name, 0) for viseme, _ in spoken)
        if name == "mouthClose":
            assert (values <= weights["jawOpen"] + 1e-12).all()
        else:
            assert values.max() <= highest + 1e-12
        assert values.min() >= 0
        assert not values[silent].any()


def test_a_long_vowel_is_reached():
    weights = mouth_weights(FINE, [("viseme_aa", 0.6)], 0.5)
    middle = np.argmin(np.abs(FINE - 0.8))
    for name, weight in VISEMES["viseme_aa"].items():
        assert weights[name][middle] == pytest.approx(weight, rel=0.05)


def test_lips_are_round_before_the_u():
    """Co-articulation: the t of "two" has rounded lips, the t of "tea" has not."""
    two = mouth_weights(FINE, [("viseme_DD", 0.08), ("viseme_U", 0.2)], 0.5)
    tea = mouth_weights(FINE, [("viseme_DD", 0.08), ("viseme_I", 0.2)], 0.5)
    during = np.argmin(np.abs(FINE - 0.56))
    assert two["mouthPucker"][during] > 0.2
    assert tea.get("mouthPucker", np.zeros_like(FINE))[during] == 0


def test_lips_close_at_a_p_whatever_surrounds_it():
    spoken = [("viseme_aa", 0.15), ("viseme_PP", 0.07), ("viseme_aa", 0.15)]
    weights = mouth_weights(FINE, spoken, 0.5)
    middle = np.argmin(np.abs(FINE - 0.685))
    assert weights["jawOpen"][middle] > 0.05
    assert weights["mouthClose"][middle] == pytest.approx(weights["jawOpen"][middle])
    assert weights["mouthLowerDownLeft"][middle] == pytest.approx(0, abs=1e-12)


@pytest.mark.parametrize(
    ("spoken", "says"),
    [
        ([], "expected visemes to speak"),
        ([("viseme_A", 0.1)], "expected a viseme, got 'viseme_A'"),
        ([("viseme_aa", 0)], "expected viseme_aa to last some seconds, got 0"),
        ([("viseme_aa", np.nan)], "got nan"),
    ],
)
def test_what_cannot_be_spoken(spoken, says):
    with pytest.raises(InputError, match=says):
        mouth_weights(FINE, spoken)


# ---- curves ---------------------------------------------------------------------------------


def test_easing_rises_once_from_nothing_to_one():
    rise = eased(FINE, 0, 1)
    assert (rise[FINE <= 0] == 0).all()
    np.testing.assert_allclose(rise[FINE >= 1], 1, atol=1e-15)
    assert (np.diff(rise) >= -1e-15).all()
    assert eased(np.array([0.5]), 0, 1)[0] == 0.5


def test_a_bump_is_symmetric_about_its_middle():
    hill = bump(FINE, 1.25, 1.0, 0.3)
    np.testing.assert_allclose(hill, hill[::-1], atol=1e-12)
    assert (hill[np.abs(FINE - 1.25) > 0.5] == 0).all()
    np.testing.assert_allclose(hill[np.abs(FINE - 1.25) < 0.15], 1, atol=1e-12)
    np.testing.assert_allclose(window(FINE, 2.5, 1.1), bump(FINE, 1.25, 2.5, 0.3), atol=1e-12)


@given(st.lists(st.tuples(st.floats(0.01, 1), st.floats(-1, 1)), min_size=2, max_size=8))
def test_a_curve_through_knots_stays_between_them(pairs):
    at = np.cumsum([step for step, _ in pairs])
    values = np.array([value for _, value in pairs])
    knots = list(zip(at.tolist(), values.tolist(), strict=True))
    np.testing.assert_allclose(through(at, knots), values, atol=1e-12)
    for left in range(len(at) - 1):
        inside = through(np.linspace(at[left], at[left + 1], 50), knots)
        assert inside.min() >= values[left : left + 2].min() - 1e-12
        assert inside.max() <= values[left : left + 2].max() + 1e-12
    assert through(np.array([-9.0, 99.0]), knots).tolist() == [values[0], values[-1]]


def test_gaze_has_no_corner_straight_ahead():
    yaw = np.linspace(-0.1, 0.1, 20_001)
    slopes = np.diff(look_weights(yaw, yaw)["eyeLookOutLeft"]) / np.diff(yaw)
    assert np.abs(np.diff(slopes)).max() < 0.02
    angles = eye_angles(look_weights(yaw, -yaw))
    np.testing.assert_allclose(angles[:, 0], yaw, atol=0.01)
    np.testing.assert_allclose(angles[:, 1], -yaw, atol=0.01)
    far = look_weights(np.array([2.0]), np.array([-2.0]))
    assert (far["eyeLookInRight"][0], far["eyeLookUpLeft"][0]) == (1, 1)
