"""The .pdeface file: exact, readable by anyone, and clear about damage."""

from __future__ import annotations

import contextlib
import io
import json
import re
import warnings
import zipfile
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays

import pdeface
from pdeface import archive, images
from pdeface.archive import FaceRecord
from pdeface.curves import BoundaryCurves
from pdeface.errors import FileFormatError, InputError
from pdeface.face import Face

RNG = np.random.default_rng(11)
TEXTURE = RNG.integers(0, 256, (8, 8, 3), dtype=np.uint8)
FACE = Face(
    BoundaryCurves.from_half(RNG.normal(size=(4, 3, 3)), -0.25),
    TEXTURE,
    a=1.5,
    modes=2,
    name="Zoë",
    notes={"licence": "CC0"},
)

numbers = st.floats(-1e9, 1e9)
shapes = st.tuples(st.integers(2, 5), st.integers(4, 9), st.just(3))
texts = st.text(max_size=20)


@st.composite
def curves(draw: Any) -> BoundaryCurves:
    points = draw(arrays.arrays(np.float64, draw(shapes), elements=numbers))
    mirror_z = draw(numbers)
    return draw(
        st.sampled_from([
            BoundaryCurves(points, mirror_z),
            BoundaryCurves.from_half(points, mirror_z),
        ])
    )  # fmt: skip


def saved(face: Face, folder: Path) -> bytes:
    face.save(folder / "face.pdeface")
    return (folder / "face.pdeface").read_bytes()


def loaded(data: bytes, folder: Path) -> Face:
    (folder / "other.pdeface").write_bytes(data)
    return pdeface.load(folder / "other.pdeface")


def rewritten(data: bytes, changes: dict[str, bytes | None], **zip_options: Any) -> bytes:
    """The same ZIP with members replaced, added or (None) left out."""
    with zipfile.ZipFile(io.BytesIO(data)) as old:
        members: dict[str, bytes | None] = {name: old.read(name) for name in old.namelist()}
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w", **zip_options) as new:
        for name, content in {**members, **changes}.items():
            if content is not None:
                new.writestr(name, content)
    return stream.getvalue()


def described(data: bytes, **changes: Any) -> bytes:
    """The same ZIP with keys of its face.json changed; "curves__count" is a key within a key."""
    with zipfile.ZipFile(io.BytesIO(data)) as old:
        header = json.loads(old.read("face.json"))
    for path, value in changes.items():
        *outer, last = path.split("__")
        inner = header
        for key in outer:
            inner = inner[key]
        inner[last] = value
    return rewritten(data, {"face.json": json.dumps(header).encode()})


def npy(array: np.ndarray, version: tuple[int, int] = (1, 0)) -> bytes:
    stream = io.BytesIO()
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        np.lib.format.write_array(stream, array, version=version)
    return stream.getvalue()


@given(
    curves=curves(),
    a=st.floats(1, 50),
    modes=st.integers(0, 30),
    name=texts,
    notes=st.dictionaries(texts, texts, max_size=3),
    texture=st.none() | arrays.arrays(np.uint8, st.tuples(
        st.integers(1, 5), st.integers(1, 5), st.sampled_from([3, 4]))),
)  # fmt: skip
def test_saving_and_loading_loses_nothing(
    tmp_path_factory: pytest.TempPathFactory, **values: Any
) -> None:
    folder = tmp_path_factory.mktemp("face")
    face = Face(**values)
    data = saved(face, folder)
    again = pdeface.load(folder / "face.pdeface")
    assert again == face
    assert again.curves.points.dtype == np.float64
    assert saved(again, folder) == data, "the same face makes the same bytes"


def test_mirrored_curves_are_stored_once(tmp_path: Path) -> None:
    points = RNG.normal(size=(28, 46, 3))
    whole = saved(Face(BoundaryCurves(points)), tmp_path)
    half = saved(Face(BoundaryCurves.from_half(points[:, :23], 0.1)), tmp_path)
    assert len(half) < 0.6 * len(whole)


def test_the_reader_in_the_documentation(root: Path, tmp_path: Path) -> None:
    page = (root / "docs" / "file-format.md").read_text(encoding="utf-8")
    source = re.search(r"```python\n(.*?)```", page, re.DOTALL)
    assert source is not None
    scope: dict[str, Any] = {}
    exec(source[1], scope)
    mirrored = FACE
    closed = FACE.with_curves(BoundaryCurves(RNG.normal(size=(3, 5, 3)), 2.0)).with_texture(None)
    for face in (mirrored, closed):
        saved(face, tmp_path)
        about, points, texture = scope["read"](tmp_path / "face.pdeface")
        np.testing.assert_array_equal(points, face.curves.points)
        assert (about["name"], about["notes"]) == (face.name, dict(face.notes))
        assert (about["surface"]["a"], about["surface"]["modes"]) == (face.a, face.modes)
        if face.texture is None:
            assert texture is None
        else:
            np.testing.assert_array_equal(images.decode(texture), face.texture)


def test_the_documentation_names_every_key(root: Path, tmp_path: Path) -> None:
    page = (root / "docs" / "file-format.md").read_text(encoding="utf-8")
    example = json.loads(re.search(r"```json\n(.*?)```", page, re.DOTALL)[1])  # type: ignore[index]
    with zipfile.ZipFile(io.BytesIO(saved(FACE, tmp_path))) as file:
        written = json.loads(file.read("face.json"))
    assert written.keys() == example.keys()
    for key in ("curves", "surface", "texture"):
        assert written[key].keys() == example[key].keys()
    assert {k: written[k] for k in ("format", "version", "units", "axes")} == {
        k: example[k] for k in ("format", "version", "units", "axes")
    }


def test_every_damaged_byte_is_found_or_harmless(tmp_path: Path) -> None:
    data = saved(FACE, tmp_path)
    for flip in (0x01, 0xFF):
        for offset in range(len(data)):
            broken = bytearray(data)
            broken[offset] ^= flip
            try:
                assert loaded(bytes(broken), tmp_path) == FACE, offset
            except FileFormatError as error:
                assert "\n" not in str(error)
                assert "other.pdeface" in str(error)


def test_every_cut_is_found(tmp_path: Path) -> None:
    data = saved(FACE, tmp_path)
    for length in range(len(data)):
        with pytest.raises(FileFormatError):
            loaded(data[:length], tmp_path)


@given(start=st.integers(0, 3000), gone=st.integers(0, 200), new=st.binary(max_size=200))
def test_overwritten_stretches(
    tmp_path_factory: pytest.TempPathFactory, start: int, gone: int, new: bytes
) -> None:
    folder = tmp_path_factory.mktemp("face")
    data = saved(FACE, folder)
    start %= len(data)
    with contextlib.suppress(FileFormatError):
        assert loaded(data[:start] + new + data[start + gone :], folder) == FACE


@pytest.mark.parametrize("data", [b"", b"PK", b"a photo", b"\x89PNG\r\n\x1a\n" + b"x" * 99])
def test_not_a_zip(data: bytes, tmp_path: Path) -> None:
    with pytest.raises(FileFormatError, match="damaged or not such a file"):
        loaded(data, tmp_path)
    assert (tmp_path / "other.pdeface").read_bytes() == data


def test_a_newer_version_says_what_to_do(tmp_path: Path) -> None:
    data = described(saved(FACE, tmp_path), version=archive.VERSION + 1)
    with pytest.raises(FileFormatError, match="version 2; update pdeface"):
        loaded(data, tmp_path)


def test_unknown_keys_and_members_are_ignored(tmp_path: Path) -> None:
    data = described(saved(FACE, tmp_path), hat="bowler", curves__colour="red")
    data = rewritten(data, {"controls.npy": b"?", "__MACOSX/._face.json": b"?"})
    assert loaded(data, tmp_path) == FACE


def test_keys_that_may_be_missing(tmp_path: Path) -> None:
    data = saved(FACE.with_texture(None), tmp_path)
    with zipfile.ZipFile(io.BytesIO(data)) as file:
        header = json.loads(file.read("face.json"))
    for key in ("name", "notes", "texture", "generator", "units", "axes", "members"):
        del header[key]
    face = loaded(rewritten(data, {"face.json": json.dumps(header).encode()}), tmp_path)
    assert face == Face(FACE.curves, a=FACE.a, modes=FACE.modes)


def test_single_precision_and_column_order_are_read(tmp_path: Path) -> None:
    half = np.asfortranarray(FACE.curves.half.astype(">f4"))
    face = loaded(rewritten(saved(FACE, tmp_path), {"curves.npy": npy(half)}), tmp_path)
    np.testing.assert_array_equal(face.curves.half, half)


@pytest.mark.parametrize("changes", [
    {"version": "1"}, {"version": True}, {"version": 0}, {"version": None}, {"format": "face"},
    {"curves": None}, {"curves": []}, {"curves__file": "texture.png"}, {"curves__file": 3},
    {"curves__file": "../curves.npy"}, {"curves__count": 5}, {"curves__points": 7},
    {"curves__stored": "quarter"}, {"curves__stored": "closed"}, {"curves__mirror_z": "0"},
    {"curves__mirror_z": float("nan")}, {"curves__mirror_z": 10**400},
    {"surface": {}}, {"surface__a": 0.5}, {"surface__a": None}, {"surface__a": float("inf")},
    {"surface__modes": -1}, {"surface__modes": 2.5}, {"surface__modes": False},
    {"name": 3}, {"name": "\ud800"}, {"notes": ["x"]}, {"notes": {"x": 1}},
    {"texture": "texture.png"}, {"texture": {}}, {"texture__file": "face.json"},
    {"texture__file": "texture.jpg"},
], ids=str)  # fmt: skip
def test_descriptions_that_make_no_sense(changes: dict[str, Any], tmp_path: Path) -> None:
    data = described(saved(FACE, tmp_path), **changes)
    with pytest.raises(FileFormatError) as caught:
        loaded(data, tmp_path)
    assert "\n" not in str(caught.value)


HALF = FACE.curves.half


@pytest.mark.parametrize("member", [
    b"", b"\x93NUMPY", npy(HALF)[:-1], npy(HALF) + b"\0", npy(HALF[..., :2]), npy(HALF[0]),
    npy(HALF[:1]), npy(np.full_like(HALF, np.nan)), npy(HALF.astype(int)),
    npy(HALF.astype(complex)), npy(HALF.astype("f2")), npy(HALF.astype(str)),
    npy(HALF.astype(object)), npy(HALF, (3, 0)),
    npy(HALF).replace(b"(4, 3, 3)", b"(4, 3,-3)"), npy(HALF).replace(b"(4, 3, 3)", b"(4,99,99)"),
    npy(HALF).replace(b"{", b"["), npy(HALF).replace(b"<f8", b"<V8"),
    npy(np.zeros((0, 3, 3))), npy(np.array(1.0)), None,
])  # fmt: skip
def test_arrays_that_are_no_curves(member: bytes | None, tmp_path: Path) -> None:
    with pytest.raises(FileFormatError):
        loaded(rewritten(saved(FACE, tmp_path), {"curves.npy": member}), tmp_path)


@pytest.mark.parametrize("changes", [
    {"face.json": None}, {"face.json": b"{"}, {"face.json": b"[1]"}, {"face.json": b"\xff\xfe"},
    {"face.json": b"[" * 100_000}, {"face.json": b'{"version": ' + b"9" * 5000 + b"}"},
    {"texture.png": None}, {"texture.png": b""}, {"texture.png": b"GIF89a"},
    {"texture.png": images.encode_png(TEXTURE)[:-30]},
])  # fmt: skip
def test_members_that_make_no_sense(changes: dict[str, bytes | None], tmp_path: Path) -> None:
    with pytest.raises(FileFormatError) as caught:
        loaded(rewritten(saved(FACE, tmp_path), changes), tmp_path)
    assert len(str(caught.value)) < 400


@pytest.mark.parametrize(
    ("name", "size"), [("face.json", 17), ("curves.npy", 65), ("texture.png", 321)]
)
def test_a_zip_bomb_is_not_unfolded(name: str, size: int, tmp_path: Path) -> None:
    bomb = rewritten(
        saved(FACE, tmp_path), {name: bytes(size << 20)}, compression=zipfile.ZIP_DEFLATED
    )
    assert len(bomb) < 1 << 20
    with pytest.raises(FileFormatError, match="MiB"):
        loaded(bomb, tmp_path)


@pytest.mark.parametrize("method", [zipfile.ZIP_LZMA, zipfile.ZIP_BZIP2])
def test_other_compressions_are_refused(method: int, tmp_path: Path) -> None:
    with pytest.raises(FileFormatError, match="compressed in an unknown way"):
        loaded(rewritten(saved(FACE, tmp_path), {}, compression=method), tmp_path)


def test_what_could_not_be_read_is_not_written() -> None:
    record = FaceRecord(FACE.curves, notes={"diary": "x" * (17 << 20)})
    with pytest.raises(InputError, match=r"face\.json .* 16 MiB"):
        archive.pack(record)
