"""A face frame by frame: weights and head at each moment, and who does what."""

from __future__ import annotations

import numpy as np
import pytest

import pdeface
from pdeface.errors import InputError
from pdeface.motion import Frames, Track, clip

TRACK = Track(
    [0.0, 1.0],
    ("jawOpen", "tongueOut"),
    [[0.0, 1.0], [1.0, 1.0]],
    head=[[0.0, 0.0, 0.0], [0.4, 0.2, 0.1]],
    missing=("mouthPucker", "headRoll"),
)


def test_weights_and_head_follow_the_track() -> None:
    frames = Frames(pdeface.neutral(), TRACK, rate=4)
    assert len(frames) == len(list(frames)) == 5
    for number, (face, head) in enumerate(frames):
        assert face.weights.get("jawOpen", 0.0) == number / 4
        np.testing.assert_allclose(head, np.array([0.4, 0.2, 0.1]) * number / 4, atol=1e-12)
    assert frames[-1][0] == frames[4][0]
    assert [face for face, _ in frames[1:3]] == [frames[1][0], frames[2][0]]
    with pytest.raises(IndexError):
        frames[5]


def test_what_the_track_lacks_is_0_and_what_it_does_not_name_stays() -> None:
    face = pdeface.random(1).set(mouthPucker=0.5, browInnerUp=0.3)
    frames = Frames(face, TRACK, rate=4)
    assert frames.moving == ("jawOpen", "tongueOut", "mouthPucker")
    moved = frames[4][0]
    assert {**moved.weights} == {**face.set(mouthPucker=0.0, jawOpen=1.0, tongueOut=1.0).weights}
    assert moved.curves is face.curves


@pytest.mark.parametrize("rate", [24, 30, 60, 29.97])
def test_a_frame_is_the_track_at_its_time(rate: float) -> None:
    track = clip("talk")
    frames = Frames(pdeface.neutral(), track, rate)
    for number in range(0, len(frames), 17):
        face, head = frames[number]
        pose = track.at(number / rate)
        assert dict(face.weights) == pytest.approx({n: w for n, w in pose.weights.items() if w})
        np.testing.assert_allclose(head, pose.head, atol=1e-12)


@pytest.mark.parametrize("rate", [0, -1, float("nan"), "fast"])
def test_a_rate_that_is_none_is_refused(rate) -> None:
    with pytest.raises(InputError, match="frames a second"):
        Frames(pdeface.neutral(), TRACK, rate)
