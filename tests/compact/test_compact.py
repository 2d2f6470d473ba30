"""Compact faces: within the error that was asked for, in the bytes that were promised."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import pdeface
from pdeface import BoundaryCurves, Face
from pdeface.compact.waves import forward, inverse
from pdeface.curves import mirror_points
from pdeface.errors import FileFormatError, InputError


def someone(seed: int, level: str = "28x46", apart: float = 0.8e-3) -> Face:
    """A random person and, on top, differences that no mode has: so many metres of smooth waves,
    about as much as real heads differ from their best modes."""
    face = pdeface.random(seed, level)
    half = face.moved_curves.half
    waves = np.zeros_like(half)
    rng = np.random.default_rng(seed)
    i, j = np.ogrid[:12, :12]
    waves[:12, :12] = rng.normal(size=(12, 12, 3)) / (2.0 + i + j)[..., None] ** 2
    waves *= apart * np.sqrt(half[..., 0].size) / np.linalg.norm(waves)
    mirror_z = face.curves.mirror_z
    curves = BoundaryCurves.from_half(half + inverse(waves), mirror_z)
    return pdeface.neutral(level).with_curves(curves)


@pytest.mark.parametrize("shape", [(28, 23, 3), (5, 4, 3), (55, 46, 3)])
def test_waves_are_orthonormal_and_come_back(shape) -> None:
    half = np.random.default_rng(1).normal(size=shape)
    waves = forward(half)
    assert np.isclose((waves**2).sum(), (half**2).sum(), rtol=1e-12)
    np.testing.assert_allclose(inverse(waves), half, atol=1e-12)


def test_the_waves_of_a_reflected_curve_are_few() -> None:
    """cos 3v, cos v and sin 2v on every curve are one wave each."""
    v = (np.arange(23) + 0.5) * np.pi / 23
    half = np.broadcast_to(np.stack([np.cos(3 * v), np.cos(v), np.sin(2 * v)], -1), (28, 23, 3))
    waves = forward(half)
    large = np.argwhere(np.abs(waves) > 1e-9).tolist()
    assert large == [[0, 1, 1], [0, 1, 2], [0, 3, 0]]


@pytest.mark.parametrize("level", ["28x46", "55x92", "109x184"])
@pytest.mark.parametrize("error", [5e-4, 1e-4, 1e-5])
def test_the_error_is_within_what_was_asked_for(tmp_path, level, error) -> None:
    face = someone(4, level)
    made = face.compact(error)
    face.save(tmp_path / "a.pdeface", compact=error)
    read = pdeface.load(tmp_path / "a.pdeface")
    apart = np.linalg.norm(read.curves.points - face.curves.points, axis=-1)
    assert np.sqrt((apart**2).mean()) == pytest.approx(made.rms, rel=1e-6)
    assert 0.5 * error < made.rms <= 1.0001 * error
    assert apart.max() == pytest.approx(made.largest, rel=1e-6)
    assert (tmp_path / "a.pdeface").stat().st_size == len(made.data)


def test_the_bytes_are_few() -> None:
    for seed in range(4):
        assert len(someone(seed).compact(1e-4).data) < 800, "name and notes included"
        assert someone(seed).compact(1e-4).shape_bytes < 700
        assert len(someone(seed, "109x184").compact(5e-5).data) < 6000
    known = pdeface.neutral().with_curves(pdeface.random(1).moved_curves)
    assert known.compact(1e-4).shape_bytes < 120, "identity modes alone say it"


def test_everything_else_is_kept(tmp_path) -> None:
    texture = np.random.default_rng(0).integers(0, 255, (9, 11, 3), dtype=np.uint8)
    face = someone(2).with_texture(texture).with_name("Zoë").with_notes({"licence": "CC0"})
    face = face.set(jawOpen=0.25, identity03=-1.2345678)
    face.save(tmp_path / "a.pdeface", compact=1e-4)
    read = pdeface.load(tmp_path / "a.pdeface")
    assert (read.name, read.notes) == ("Zoë", face.notes)
    assert read.weights == {"identity03": -1.235, "jawOpen": 0.25}
    np.testing.assert_array_equal(read.texture, texture)
    assert (read.a, read.modes) == (face.a, face.modes)
    assert read.curves.is_mirrored


def test_a_size_that_the_template_does_not_have() -> None:
    half = np.random.default_rng(5).normal(size=(9, 6, 3)) * 0.05
    face = Face(BoundaryCurves(mirror_points(half, 0.01), 0.01))
    made = face.compact(1e-4)
    assert made.rms <= 1e-4


def test_curves_that_are_no_reflection_are_refused() -> None:
    face = Face(BoundaryCurves(np.random.default_rng(1).normal(size=(4, 8, 3))))
    with pytest.raises(InputError, match="closed by reflection"):
        face.compact(1e-4)
    with pytest.raises(InputError, match=r"from 0\.0001 to 20 mm, got 50"):
        pdeface.neutral().compact(0.05)


@lru_cache(maxsize=1)
def eve() -> bytes:
    return pdeface.random(5).with_name("Eve").compact(1e-3).data


@settings(max_examples=60, deadline=None)
@given(st.data())
def test_a_damaged_file_is_an_error_and_no_face(tmp_path_factory, data) -> None:
    whole = bytearray(eve())
    cut = data.draw(st.integers(0, len(whole) - 1))
    if data.draw(st.booleans()):
        whole = whole[: max(cut, 4)]
    else:
        whole[max(cut, 4)] ^= data.draw(st.integers(1, 255))
    path = tmp_path_factory.mktemp("damaged") / "a.pdeface"
    path.write_bytes(bytes(whole))
    try:
        read = pdeface.load(path)
    except FileFormatError as error:
        assert str(error).count("\n") == 0
    else:  # a header that says something else, and is as good as any
        assert read.curves.shape[0] >= 2
