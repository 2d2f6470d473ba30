"""Recordings of Live Link Face: what is read, and what is refused and how."""

from __future__ import annotations

import contextlib
import re

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from pdeface.errors import FileFormatError, InputError
from pdeface.motion import ARKIT_NAMES, read, read_livelink

CODES = [f"14:25:36:{20.5 + 1.001 * n:.3f}" for n in range(4)]


def capital(name: str) -> str:
    return name[0].upper() + name[1:]


def test_a_recording_is_read(recording, recorded):
    values = [{"EyeBlinkLeft": 0.25 * n, "JawRight": 0.5, "HeadYaw": 0.1} for n in range(4)]
    track = read(recording(recorded(CODES, values=values)))
    assert track.names == ARKIT_NAMES
    assert (track.missing, track.ignored) == ((), ())
    np.testing.assert_allclose(track.times, [n * 1.001 / 60 for n in range(4)], atol=1e-9)
    blink, left, right = track.weights_of(("eyeBlinkLeft", "jawLeft", "jawRight")).T
    np.testing.assert_array_equal(blink, [0, 0.25, 0.5, 0.75])
    np.testing.assert_array_equal(left, 0)  # the app writes JawRight first
    np.testing.assert_array_equal(right, 0.5)
    np.testing.assert_array_equal(track.head[:, 0], 0.1)


def test_the_heads_angles_become_ours(recording, recorded):
    """The app: yaw to the left, pitch up, roll to the right shoulder. Ours: pitch down."""
    values = [{"HeadYaw": 0.3, "HeadPitch": 0.2, "HeadRoll": 0.1}]
    track = read_livelink(recording(recorded(CODES, values=values)))
    np.testing.assert_array_equal(track.head[0], [0.3, -0.2, 0.1])
    np.testing.assert_array_equal(track.head[1], 0)


def test_the_eyes_angles_agree_with_the_weights(recording, recorded):
    """The app mirrors the eyes' angles; these numbers are related as those of recordings are.

    In the first row the eyes meet on a near point below (both look in), in the second both look
    to the subject's right (the left eye in, the right one out).
    """
    scale = 0.6  # radians at weight 1
    near = {"EyeLookInLeft": 0.07, "EyeLookInRight": 0.04}
    near |= {"EyeLookDownLeft": 0.2, "EyeLookDownRight": 0.21}
    near |= {"RightEyeYaw": 0.07 * scale, "RightEyePitch": 0.2 * scale}
    near |= {"LeftEyeYaw": -0.04 * scale, "LeftEyePitch": 0.21 * scale}
    right = {"EyeLookInLeft": 0.5, "EyeLookOutRight": 0.4}
    right |= {"RightEyeYaw": 0.5 * scale, "LeftEyeYaw": 0.4 * scale, "RightEyeRoll": 0.01}
    track = read_livelink(recording(recorded(CODES, values=[near, right])))
    in_left, in_right, out_right, down_left, down_right = track.weights_of(
        (
            "eyeLookInLeft",
            "eyeLookInRight",
            "eyeLookOutRight",
            "eyeLookDownLeft",
            "eyeLookDownRight",
        )
    ).T
    np.testing.assert_allclose(track.left_eye[:, 0], -scale * in_left, atol=1e-9)
    np.testing.assert_allclose(track.right_eye[:, 0], scale * (in_right - out_right), atol=1e-9)
    np.testing.assert_allclose(track.left_eye[:, 1], scale * down_left, atol=1e-9)
    np.testing.assert_allclose(track.right_eye[:, 1], scale * down_right, atol=1e-9)
    assert track.left_eye[1, 2] == -0.01


@given(st.data())
def test_columns_come_in_any_order_case_and_number(tmp_path_factory, header, data):
    titles = data.draw(st.permutations(header[2:]))[: data.draw(st.integers(1, 61))]
    spelt = [data.draw(st.sampled_from([str, str.lower, str.upper]))(each) for each in titles]
    numbers = data.draw(st.lists(st.floats(0, 1), min_size=len(spelt), max_size=len(spelt)))
    place = data.draw(st.integers(0, len(spelt)))
    spelt.insert(place, data.draw(st.sampled_from(["Timecode", "timecode", "TIMECODE"])))
    cells = [repr(number) for number in numbers]
    cells.insert(place, "00:00:00:00")
    path = tmp_path_factory.mktemp("takes") / "take.csv"
    path.write_text(f"{','.join(spelt)}\n{','.join(cells)}\n")
    track = read_livelink(path)
    given_weights = dict(zip(titles, numbers, strict=True))
    assert track.at(0).weights == {
        name: given_weights[capital(name)] for name in ARKIT_NAMES if capital(name) in titles
    }
    assert set(track.missing) == {t[0].lower() + t[1:] for t in header[2:] if t not in titles}
    assert track.head[0, 0] == given_weights.get("HeadYaw", 0.0)
    assert track.left_eye[0, 0] == -given_weights.get("RightEyeYaw", 0.0)


def test_unknown_columns_are_reported_and_ignored(recording):
    path = recording(["Timecode,Angry,JawOpen,Sad", "00:00:00:00,7.5,0.5,x"])
    track = read_livelink(path)
    assert track.ignored == ("Angry", "Sad")
    assert track.at(0).weights == {"jawOpen": 0.5}
    assert len(track.missing) == 51 + 9


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16"])
@pytest.mark.parametrize("ending", ["\n", "\r\n"])
def test_the_dress_of_a_text_file_does_not_matter(recording, recorded, encoding, ending):
    rows = recorded(CODES, values=[{"JawOpen": 0.5}])
    dressed = ["", *(f'"{row}"'.replace(",", '","') for row in rows), "", ",,,", ""]
    track = read_livelink(recording(dressed, ending, encoding))
    assert len(track) == 4
    assert track.at(0).weights["jawOpen"] == 0.5


@pytest.mark.parametrize("separator", [";", "\t"])
def test_spreadsheets_write_other_separators(recording, recorded, separator):
    rows = [row.replace(",", separator) for row in recorded(CODES, values=[{"JawOpen": 0.5}])]
    assert read_livelink(recording(rows)).at(0).weights["jawOpen"] == 0.5


def test_commas_at_the_end_of_a_row_do_not_matter(recording):
    track = read_livelink(recording(["Timecode,JawOpen,,", "00:00:00:00,0.5,,,,"]))
    assert track.at(0).weights == {"jawOpen": 0.5}


# ---- time -----------------------------------------------------------------------------------


def test_time_goes_on_over_midnight(recording, recorded):
    codes = ["23:59:59:58", "23:59:59:59", "00:00:00:00", "00:00:00:01"]
    track = read_livelink(recording(recorded(codes)))
    np.testing.assert_allclose(track.times, np.arange(4) / 60, atol=1e-9)
    assert (track.fps, track.notes) == (60, ())


@pytest.mark.parametrize(("nominal", "rate"), [(30, 30000 / 1001), (60, 60000 / 1001)])
def test_drop_frame_time_is_even_where_numbers_are_dropped(recording, recorded, nominal, rate):
    first = 2 * nominal // 30
    before = [f"23:59:59;{frame:02}" for frame in range(nominal)]
    after = [f"00:00:{second:02};{frame:02}" for second in (0, 59) for frame in range(nominal)]
    minute = [f"00:01:00;{frame:02}" for frame in range(first, nominal)]
    track = read_livelink(recording(recorded([*before, *after, *minute])))
    gap = 2 * nominal  # the 58 seconds that were left out above
    steps = np.diff(track.times) * rate
    assert steps[gap - 1] == pytest.approx(58 * nominal + 1)
    np.testing.assert_allclose(np.delete(steps, gap - 1), 1, atol=1e-6)
    assert track.fps == pytest.approx(rate)


def test_drop_frame_may_be_told(recording, recorded):
    codes = ["00:00:59:29", "00:01:00:02"]
    path = recording(recorded(codes))
    told = read_livelink(path, fps=29.97, drop_frame=True)
    assert told.times[1] == pytest.approx(1.001 / 30)
    assert read_livelink(path, fps=29.97).times[1] == pytest.approx(3 * 1.001 / 30)
    semicolons = recording(recorded([code[::-1].replace(":", ";", 1)[::-1] for code in codes]))
    assert read_livelink(semicolons, fps=30).times[1] == pytest.approx(1.001 / 30)
    undropped = read_livelink(semicolons, fps=30, drop_frame=False)
    assert undropped.times[1] == pytest.approx(3 / 30)


def test_the_rate_may_be_told(recording, recorded):
    path = recording(recorded(["00:00:00:00", "00:00:00:12"]))
    assert read_livelink(path, fps=24).duration == 0.5
    guessed = read_livelink(path)
    assert guessed.duration == pytest.approx(0.2)
    assert "taken to count 60 frames a second" in guessed.notes[0]
    with pytest.raises(InputError, match="more than 0 frames a second, got -1"):
        read_livelink(path, fps=-1)
    with pytest.raises(InputError, match="whole number of frames a second"):
        read_livelink(path, fps=59.97)


def test_repeated_timecodes_are_left_out(recording, recorded):
    codes = ["00:00:00:00", "00:00:00:01", "00:00:00:01", "00:00:00:01", "00:00:00:02"]
    values = [{"JawOpen": n / 10} for n in range(5)]
    track = read_livelink(recording(recorded(codes, values=values)), fps=60)
    np.testing.assert_array_equal(track.weights_of(["jawOpen"])[:, 0], [0, 0.1, 0.4])
    assert track.notes == ("2 rows (the first is row 4) left out: a timecode that repeats.",)


def test_frames_without_a_face_are_left_out(recording, recorded):
    rows = recorded(CODES, values=[{"JawOpen": n / 10} for n in range(4)])
    rows[2] = f"{CODES[1]},0"
    track = read_livelink(recording(rows))
    assert len(track) == 3
    assert "Row 3 left out: the app saw no face." in track.notes
    # The motion goes straight on between its neighbours.
    assert track.at(1.001 / 60).weights["jawOpen"] == pytest.approx(0.1, abs=1e-3)


def test_an_angle_goes_on_past_half_a_turn(recording, recorded):
    values = [{"HeadRoll": 3.1}, {"HeadRoll": -3.1}]
    track = read_livelink(recording(recorded(CODES[:2], values=values)))
    between = track.at(track.duration / 2).head[2]
    assert between == pytest.approx(np.pi)


# ---- what is refused ------------------------------------------------------------------------

PLAIN = ["Timecode,BlendshapeCount,JawOpen,HeadYaw"]
PLAIN += [f"00:00:00:0{n},2,0.{n},0" for n in range(5)]


def refused(path, **options) -> str:
    with pytest.raises(FileFormatError) as caught:
        read_livelink(path, **options)
    message = str(caught.value)
    assert "\n" not in message
    assert str(path) in message
    return message


@pytest.mark.parametrize(
    ("row", "line", "says"),
    [
        (4, "00:00:00:03,2,0.3", "expected 4 values, got 3; the file may be cut short"),
        (4, "00:00:00:03", "expected 4 values, got 1"),
        (4, "00:00:00:03,2,0.3,0,5", "expected 4 values, got 5"),
        (3, "00:00:00:02,2,open,0", "expected a number for JawOpen, got 'open'"),
        (3, "00:00:00:02,2,,0", "expected a number for JawOpen, got ''"),
        (3, "00:00:00:02,2,nan,0", "expected a number for JawOpen, got 'nan'"),
        (3, "00:00:00:02,2,0.2,-inf", "expected a number for HeadYaw, got '-inf'"),
        (2, "00:00:00:01,2,1.2,0", "expected jawOpen within 0 and 1, got 1.2"),
        (2, "00:00:00:01,2,-0.01,0", "expected jawOpen within 0 and 1, got -0.01"),
        (2, "00:00:00:01,2,0.1,25", "expected headYaw in radians, got 25"),
        (4, "00:00:00:01.5,2,0.3,0", "expected a timecode after 00:00:00:02, got 00:00:00:01.5"),
        (4, "0.05,2,0.3,0", "expected a timecode such as 13:05:59:07.250"),
        (4, '"00:00:00:03,2,0.3,0', "expected comma-separated values"),
    ],
)
def test_a_bad_row_is_called_by_its_number(recording, row, line, says):
    rows = [*PLAIN]
    rows[row] = line
    message = refused(recording(rows))
    assert says in message
    # The quote that is never closed is noticed at the end of the file.
    assert re.search(rf"row {6 if line.startswith(chr(34)) else row + 1}: ", message)


def test_rows_are_counted_in_lines_of_the_file(recording):
    message = refused(recording(["", PLAIN[0], "", *PLAIN[1:3], "", "00:00:00:02,2,x,0"]))
    assert "row 7: expected a number for JawOpen" in message


def test_a_label_that_drop_frame_skips(recording, recorded):
    message = refused(recording(recorded(["00:00:59;29", "00:01:00;01"])), fps=29.97)
    assert "row 3: drop-frame timecode skips 2 numbers" in message


def test_a_frame_number_beyond_the_rate(recording, recorded):
    message = refused(recording(recorded(["00:00:00:10", "00:00:00:40"])), fps=30)
    assert "row 3: expected frame numbers below 30" in message
    assert "got 999" in refused(recording(recorded(["00:00:00:999"])))


def test_values_out_of_range_are_clamped_if_asked(recording):
    rows = [PLAIN[0], "00:00:00:00,2,1.25,0", "00:00:00:01,2,-0.5,0", "00:00:00:02,2,0.5,0"]
    track = read_livelink(recording(rows), fps=60, clamp=True)
    np.testing.assert_array_equal(track.weights[:, 0], [1, 0, 0.5])
    assert track.notes == ("2 weights clamped to 0..1, the furthest out by 0.5.",)


def test_values_that_stray_by_rounding_are_put_in_range(recording):
    rows = [PLAIN[0], "00:00:00:00,2,1.0004,0", "00:00:00:01,2,-0.001,0"]
    track = read_livelink(recording(rows), fps=60)
    np.testing.assert_array_equal(track.weights[:, 0], [1, 0])
    assert track.notes == ("2 weights clamped to 0..1, the furthest out by 0.001.",)


def test_degrees_are_read_if_said(recording):
    rows = [PLAIN[0], "00:00:00:00,2,0,90"]
    assert read_livelink(recording(rows), degrees=True).head[0, 0] == pytest.approx(np.pi / 2)


@pytest.mark.parametrize(
    ("content", "says"),
    [
        (b"", "is empty"),
        (b" \r\n\n", "is empty"),
        (b"\xef\xbb\xbf\n", "is empty"),
        (bytes(range(256)), "is not a text file"),
        (b"Timecode,JawOpen\n00:00:00:00,\0\n", "is not a text file"),
        (b"kind,index\nV,0\n", "expected columns such as Timecode"),
        (b"Timecode,BlendshapeCount\n00:00:00:00,61\n", "expected columns such as Timecode"),
        (b"JawOpen,HeadYaw\n0.5,0\n", "expected a column Timecode"),
        (b"Timecode,JawOpen,jawopen\n00:00:00:00,0,0\n", "got jawopen twice"),
        (b"Timecode,JawOpen\n", "expected at least one row of values after the titles"),
        (b"Timecode,BlendshapeCount,JawOpen\n00:00:00:00,0\n", "got only rows without a face"),
        (b"Timecode,JawOpen\n" + b"1" * 200_000, "cannot be read"),
    ],
)
def test_a_file_that_is_none(tmp_path, content, says):
    path = tmp_path / "take.csv"
    path.write_bytes(content)
    assert says in refused(path)


def test_a_file_that_is_not_there(tmp_path):
    with pytest.raises(InputError, match=r"cannot read .*nowhere\.csv: No such file"):
        read_livelink(tmp_path / "nowhere.csv")
    with pytest.raises(InputError, match="cannot read"):
        read_livelink(tmp_path)


@given(st.binary(max_size=300))
def test_any_bytes_give_a_track_or_an_error_in_one_line(tmp_path_factory, junk):
    path = tmp_path_factory.mktemp("junk") / "take.csv"
    path.write_bytes(b"Timecode,BlendshapeCount,JawOpen\n" + junk)
    try:
        assert len(read_livelink(path)) > 0
    except InputError as error:
        assert "\n" not in str(error)


@given(st.integers(0, 400))
def test_a_file_cut_anywhere_is_never_misread(tmp_path_factory, recorded, place):
    whole = "\n".join(recorded(CODES[:3], ["Timecode", "BlendshapeCount", "JawOpen", "HeadYaw"]))
    path = tmp_path_factory.mktemp("cut") / "take.csv"
    path.write_text(whole[:place])
    with contextlib.suppress(InputError):
        assert not read_livelink(path).weights.any()
