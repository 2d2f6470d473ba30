"""Timecode against a counter that counts every frame."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from hypothesis import given
from hypothesis import strategies as st

from pdeface.errors import InputError
from pdeface.motion.timecode import Clock, infer_clock, make_clock, parse

DROPPING = [(29.97, 30, 2), (59.94, 60, 4)]


def count_frames(nominal: int, dropped: int) -> Iterator[str]:
    """The timecode of one frame after the other, as a counter on a recorder shows them."""
    hours = minutes = seconds = frame = 0
    while True:
        yield f"{hours:02}:{minutes:02}:{seconds:02}{';' if dropped else ':'}{frame:02}"
        frame += 1
        if frame == nominal:
            frame, seconds = 0, seconds + 1
            if seconds == 60:
                seconds, minutes = 0, minutes + 1
                if minutes == 60:
                    minutes, hours = 0, hours + 1
                if minutes not in (0, 10, 20, 30, 40, 50):
                    frame = dropped


@pytest.mark.parametrize(("rate", "nominal", "dropped"), DROPPING)
def test_drop_frame_counts_every_frame_once(rate, nominal, dropped):
    clock = make_clock(rate, drop=True)
    counter = count_frames(nominal, dropped)
    for number in range(nominal * 60 * 61):  # past the first hour
        assert clock.frames(parse(next(counter))) == number


@pytest.mark.parametrize(("rate", "nominal", "dropped"), DROPPING)
def test_drop_frame_keeps_up_with_the_clock(rate, nominal, dropped):
    clock = make_clock(rate, drop=True)
    tenth = next(n for n, code in enumerate(count_frames(nominal, dropped)) if "00:10:00" in code)
    assert clock.day == 144 * tenth
    assert clock.day / clock.rate == pytest.approx(86400, abs=0.1)
    assert tenth / clock.rate == pytest.approx(600, abs=1e-3)


@pytest.mark.parametrize("nominal", [24, 25, 30, 60])
def test_other_timecode_counts_every_number(nominal):
    clock = make_clock(nominal, drop=False)
    counter = count_frames(nominal, 0)
    for number in range(nominal * 130):
        assert clock.frames(parse(next(counter))) == number
    assert clock.rate == nominal
    assert clock.day == 86400 * nominal


@given(
    st.sampled_from([(30, 2), (60, 4)]),
    st.integers(0, 23),
    st.integers(0, 59),
    st.integers(0, 59),
    st.floats(0, 29.999),
)
def test_a_timecode_is_after_all_earlier_ones(kind, hour, minute, second, frame):
    nominal, dropped = kind
    clock = Clock(nominal, nominal / 1.001, drop=True)
    code = parse(f"{hour}:{minute}:{second};{frame:.3f}")
    if minute % 10 and second == 0 and code.frame < dropped:
        with pytest.raises(InputError, match="skips"):
            clock.frames(code)
        return
    seconds = clock.frames(code) / clock.rate
    spoken = 3600 * hour + 60 * minute + second + code.frame / nominal
    # Numbers are behind by up to a minute's drop, and gain on the clock in every tenth.
    assert seconds == pytest.approx(spoken, abs=0.16)


def test_a_fraction_is_one_of_a_frame():
    clock = make_clock(60, drop=False)
    assert clock.frames(parse("00:00:01:30.250")) == 90.25
    assert clock.frames(parse(" 00:00:01:30.5 ")) == 90.5


@pytest.mark.parametrize("rate", [29.97, 30000 / 1001, 59.94, 59.9401, 23.976, 119.88])
def test_ntsc_rates_are_exact_however_they_are_rounded(rate):
    clock = make_clock(rate, drop=False)
    assert clock.rate == pytest.approx(clock.nominal * 1000 / 1001, rel=1e-15)


@pytest.mark.parametrize("rate", [29.9, 59.97, 12.5, 0.2, 5000])
def test_no_timecode_counts_at_odd_rates(rate):
    with pytest.raises(InputError, match="whole number of frames a second"):
        make_clock(rate, drop=False)


def test_no_numbers_drop_at_25():
    with pytest.raises(InputError, match=r"29\.97 or 59\.94.*got 25"):
        make_clock(25, drop=True)


@pytest.mark.parametrize(
    "text",
    ["", "nothing", "12:00:00", "24:00:00:00", "00:60:00:00", "00:00:60:00", "00:00:00:00:00",
     "00:00:00.00", "-1:00:00:00", "00:00:00:", "00:00:00:0a", "0.033", "00:00:00:1e1"],
)  # fmt: skip
def test_other_texts_are_no_timecode(text):
    with pytest.raises(InputError, match="expected a timecode such as"):
        parse(text)


@pytest.mark.parametrize("nominal", [24, 25, 30, 48, 50, 60, 120])
@pytest.mark.parametrize("step", [1, 2])
def test_the_rate_is_seen_where_a_second_ends(nominal, step):
    counter = count_frames(nominal, 0)
    codes = [parse(next(counter)) for _ in range(3 * nominal)][5::step]
    clock, guessed = infer_clock(codes, drop=False)
    assert (clock.nominal, clock.rate, guessed) == (nominal, nominal, False)


@pytest.mark.parametrize(("rate", "nominal", "dropped"), DROPPING)
def test_a_semicolon_tells_the_ntsc_rate(rate, nominal, dropped):
    counter = count_frames(nominal, dropped)
    codes = [parse(next(counter)) for _ in range(nominal * 62)][nominal * 58 :]
    clock, guessed = infer_clock(codes, drop=True)
    assert clock == make_clock(rate, drop=True)
    assert not guessed


def test_the_rate_is_seen_in_frames_that_are_a_little_long():
    """A camera at 59.94 in front of a clock of 60: what phones record."""
    frames = [17.25 + 1.0014 * number for number in range(200)]
    codes = [parse(f"14:25:{int(f // 60):02}:{f % 60:06.3f}") for f in frames]
    assert infer_clock(codes, drop=False) == (make_clock(60, drop=False), False)


def test_the_rate_is_seen_past_lost_frames():
    counter = count_frames(30, 0)
    codes = [parse(next(counter)) for _ in range(300)]
    kept = [code for number, code in enumerate(codes) if number % 7 and not 58 < number < 64]
    assert infer_clock(kept, drop=False) == (make_clock(30, drop=False), False)


def test_a_rate_that_cannot_be_seen_is_guessed():
    codes = [parse(f"00:00:00:{frame:02}") for frame in range(20)]
    assert infer_clock(codes, drop=False) == (make_clock(60, drop=False), True)
    assert infer_clock([parse("00:00:00:71")], drop=False) == (make_clock(100, drop=False), True)


def test_frame_numbers_that_no_recorder_shows():
    with pytest.raises(InputError, match="below 240, got 999; give the recording's fps"):
        infer_clock([parse("00:00:00:999")], drop=False)


def test_a_frame_number_beyond_the_rate():
    with pytest.raises(
        InputError, match="below 30 at 30 frames a second, got timecode 00:00:01:45"
    ):
        make_clock(30, drop=False).frames(parse("00:00:01:45"))
