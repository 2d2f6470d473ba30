"""Tracks as files: what is written is read back, and what is no track is refused."""

from __future__ import annotations

import io
import json
import re
import zipfile

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from pdeface.errors import FileFormatError, InputError
from pdeface.motion import ARKIT_NAMES, CLIPS, VRM_PRESETS, Track, clip, read, write

FORMATS = [".json", ".npz"]


@st.composite
def tracks(draw: st.DrawFn) -> Track:
    count = draw(st.integers(1, 5))
    times = np.cumsum(draw(st.lists(st.floats(0.01, 9), min_size=count, max_size=count)))
    names = draw(st.lists(st.sampled_from(ARKIT_NAMES), unique=True, max_size=4))
    cells = st.lists(st.floats(0, 1), min_size=count * len(names), max_size=count * len(names))
    angles = st.lists(st.floats(-4, 4), min_size=9 * count, max_size=9 * count)
    return Track(
        times,
        tuple(names),
        np.reshape(draw(cells), (count, len(names))),
        *np.reshape(draw(angles), (3, count, 3)),
        fps=draw(st.none() | st.floats(1, 240)),
        missing=tuple(draw(st.lists(st.sampled_from(ARKIT_NAMES), max_size=2))),
        ignored=tuple(draw(st.lists(st.text("aß\"'\\ü", min_size=1), max_size=2))),
        notes=("Recorded in the kitchen.",),
    )


@pytest.mark.parametrize("suffix", FORMATS)
@given(track=tracks())
def test_what_is_written_is_read_back(tmp_path_factory, suffix, track):
    path = tmp_path_factory.mktemp("tracks") / f"take{suffix}"
    write(track, path)
    assert read(path) == track


@pytest.mark.parametrize("suffix", FORMATS)
def test_the_content_tells_where_the_suffix_does_not(tmp_path, suffix):
    track = clip("blink")
    write(track, tmp_path / f"a{suffix}")
    other = (tmp_path / f"a{suffix}").rename(tmp_path / "take.motion")
    assert read(other) == track


def test_a_recording_is_known_by_its_content(recording, recorded):
    path = recording(recorded(["00:00:00:00"]), encoding="utf-16")
    assert len(read(path.rename(path.with_suffix(".txt")))) == 1


def test_a_file_of_nothing_known(tmp_path):
    path = tmp_path / "take.bvh"
    path.write_text("HIERARCHY")
    with pytest.raises(FileFormatError, match=r"\.csv of Live Link Face, \.json .* or \.npz"):
        read(path)


def test_writing_knows_two_formats(tmp_path):
    with pytest.raises(InputError, match=r"ends in \.json or \.npz, got 'take\.csv'"):
        write(clip("blink"), tmp_path / "take.csv")
    assert not list(tmp_path.iterdir())


def test_a_rate_is_for_recordings(tmp_path):
    write(clip("blink"), tmp_path / "a.json")
    with pytest.raises(InputError, match=r"for a \.csv alone"):
        read(tmp_path / "a.json", fps=30)


# ---- JSON -----------------------------------------------------------------------------------

LEAST = {
    "format": "pdeface-track",
    "version": 1,
    "times": [0, 0.5],
    "weights": {"jawOpen": [0, 1]},
}


def written(tmp_path, content: object):
    path = tmp_path / "take.json"
    path.write_text(content if isinstance(content, str) else json.dumps(content))
    return path


def test_json_by_hand(tmp_path):
    head = {"yaw": [0.1, 0.2]}
    track = read(written(tmp_path, {**LEAST, "head": head, "author": "me"}))
    assert track == Track([0, 0.5], ("jawOpen",), [[0], [1]], head=[[0.1, 0, 0], [0.2, 0, 0]])


def test_a_person_can_read_the_json(tmp_path):
    path = tmp_path / "blink.json"
    write(clip("blink"), path)
    lines = path.read_text().splitlines()
    assert sum('"eyeBlinkLeft": [' in line for line in lines) == 1
    assert len(lines) < 40


@pytest.mark.parametrize(
    ("change", "says"),
    [
        ({"format": "track"}, '"format": "pdeface-track"'),
        ({"version": 2}, "version 2 of the format, this library reads 1; install a newer"),
        ({"version": "1"}, "expected version 1 of a track file, got '1'"),
        ({"times": None}, 'the list "times"'),
        ({"weights": [1]}, 'the object "weights"'),
        ({"times": [0, 0]}, "must increase"),
        ({"times": [0, "1"]}, "expected numbers for times, got \"1\" at sample 1"),
        ({"weights": {"jawOpen": [0]}}, "expected 2 numbers for jawOpen"),
        ({"weights": {"jawOpen": [0, None]}}, "expected numbers for jawOpen, got null at sample 1"),
        ({"weights": {"jawOpen": [0, 1.5]}}, "got 1.5 for jawOpen at sample 1; clamp it"),
        ({"weights": {"jawOpne": [0, 1]}}, "did you mean jawOpen"),
        ({"weights": {"jawOpen": 1}}, "for jawOpen, one for each time, got int"),
        ({"weights": {"jawOpen": [0, 10**400]}}, "too large"),
        ({"head": {"tilt": [0, 1]}}, '"yaw", "pitch" and "roll"'),
        ({"leftEye": {"yaw": [0]}}, "expected 2 numbers for leftEye yaw"),
        ({"fps": -1}, "more than 0 frames a second"),
        ({"fps": [60]}, "a number of frames a second"),
    ],
)  # fmt: skip
def test_json_that_is_no_track(tmp_path, change, says):
    with pytest.raises(FileFormatError) as caught:
        read(written(tmp_path, {**LEAST, **change}))
    assert says in str(caught.value)
    assert "take.json" in str(caught.value)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("", "is empty"),
        ("[]", '"format": "pdeface-track"'),
        ("{", "expected JSON"),
        ('{"times": [], "times": []}', "'times' twice"),
        ("[" * 100_000, "expected JSON"),
        (json.dumps(LEAST).replace("0.5", "NaN"), "got nan for times at sample 1"),
    ],
)
def test_text_that_is_no_json_track(tmp_path, text, says):
    with pytest.raises(FileFormatError) as caught:
        read(written(tmp_path, text))
    assert says in str(caught.value)


# ---- NumPy ----------------------------------------------------------------------------------


def stored(tmp_path, **arrays: object):
    parts: dict[str, object] = {"times": [0, 1], "names": ["jawOpen"], "weights": [[0.0], [1.0]]}
    parts |= arrays
    path = tmp_path / "take.npz"
    np.savez(path, **{name: value for name, value in parts.items() if value is not None})
    return path


def test_npz_by_hand(tmp_path):
    assert read(stored(tmp_path)) == Track([0, 1], ("jawOpen",), [[0], [1]])


@pytest.mark.parametrize(
    ("change", "says"),
    [
        ({"weights": None}, "got no weights"),
        ({"times": None, "names": None}, "got no times and no names"),
        ({"names": [1]}, "expected a list of texts in names"),
        ({"names": "jawOpen"}, "expected a list of texts in names"),
        ({"names": ["jaw"]}, "expected ARKit names, got 'jaw'"),
        ({"weights": [[0.0], [2.0]]}, "got 2 for jawOpen at sample 1"),
        ({"weights": ["a", "b"]}, "weights of a track must be an array of numbers"),
        ({"head": np.zeros((2, 2))}, "head of 2 samples needs shape"),
        ({"fps": np.array([1, 2])}, "a number of frames a second"),
        ({"format": "other"}, "expected format pdeface-track, got 'other'"),
        ({"version": 3}, "version 3 of the format"),
        ({"times": np.array([{}])}, "expected the arrays of an .npz file"),
    ],
)
def test_npz_that_is_no_track(tmp_path, change, says):
    with pytest.raises(FileFormatError) as caught:
        read(stored(tmp_path, **change))
    assert says in str(caught.value)
    assert "\n" not in str(caught.value)


@given(st.data())
def test_a_damaged_npz_is_an_error_or_itself(tmp_path_factory, data):
    folder = tmp_path_factory.mktemp("damaged")
    track = clip("blink").resampled(5)
    path = folder / "a.npz"
    write(track, path)
    content = bytearray(path.read_bytes())
    for _ in range(data.draw(st.integers(1, 3))):
        content[data.draw(st.integers(0, len(content) - 1))] = data.draw(st.integers(0, 255))
    path.write_bytes(content[: data.draw(st.integers(1, len(content)))])
    try:
        # Fields of the ZIP that nobody reads may change; checksums guard the rest.
        assert np.array_equal(read(path).times, track.times)
    except InputError as error:
        assert "\n" not in str(error)


def test_an_npz_that_unfolds_to_too_much(tmp_path, monkeypatch):
    monkeypatch.setattr("pdeface.motion.track_npz._LARGEST", 8 << 20)
    path = tmp_path / "bomb.npz"
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        for name in range(9):
            archive.writestr(f"{name}.npy", bytes(1 << 20))
    with pytest.raises(FileFormatError, match="unfolds to more than 8 MiB"):
        read(path)


def test_an_npz_whose_array_claims_too_much(tmp_path):
    stream = io.BytesIO()
    header = {"descr": "<f8", "fortran_order": False, "shape": (1 << 60,)}
    np.lib.format.write_array_header_1_0(stream, header)
    path = tmp_path / "claims.npz"
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("times.npy", stream.getvalue())
    with pytest.raises(FileFormatError, match="expected the arrays"):
        read(path)


@pytest.mark.parametrize("suffix", FORMATS)
def test_values_out_of_range_are_clamped_if_asked(tmp_path, suffix):
    wild = {"jawOpen": [-0.5, 1.25]}
    path = (
        written(tmp_path, {**LEAST, "weights": wild, "notes": ["Mine."]})
        if suffix == ".json"
        else stored(tmp_path, weights=np.transpose([wild["jawOpen"]]), notes=["Mine."])
    )
    track = read(path, clamp=True)
    np.testing.assert_array_equal(track.weights, [[0], [1]])
    assert track.notes == ("Mine.", "2 weights clamped to 0..1, the furthest out by 0.5.")


# ---- the page about it ----------------------------------------------------------------------


def test_what_the_page_shows_works(root, tmp_path, monkeypatch):
    page = (root / "docs" / "motion.md").read_text(encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    for block in re.findall(r"^```python\n(.*?)^```", page, re.DOTALL | re.MULTILINE):
        exec(compile(block, "motion.md", "exec"), {})
    assert read("blink.json") == clip("blink")
    assert read("nod.npz").at(0.5).weights == {"jawOpen": 0.4}
    (shown,) = re.findall(r"^```json\n(.*?)^```", page, re.DOTALL | re.MULTILINE)
    assert read(written(tmp_path, shown)).head[1, 0] == 0.1
    assert all(f"`{name}`" in page for name in (*VRM_PRESETS, *CLIPS))
