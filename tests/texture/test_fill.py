"""Colours are extended smoothly, and from close by."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from pdeface.texture._fill import extend


def test_what_is_known_is_kept_and_what_is_unknown_is_filled():
    colours = np.random.default_rng(0).random((33, 50, 3)).astype(np.float32)
    weights = np.zeros((33, 50), np.float32)
    weights[5:25, 10:30] = 1.0
    result = extend(np.where(weights[..., None] > 0, colours, 1e6).astype(np.float32), weights)
    np.testing.assert_array_equal(result[5:25, 10:30], colours[5:25, 10:30])
    assert result.min() >= colours.min()
    assert result.max() <= colours.max()


@given(
    height=st.integers(1, 40), width=st.integers(1, 40), seed=st.integers(0, 99),
    known=st.floats(0.01, 1),
)  # fmt: skip
def test_a_constant_is_extended_as_a_constant(height, width, seed, known):
    weights = (np.random.default_rng(seed).random((height, width)) < known).astype(np.float32)
    weights[seed % height, seed % width] = 1.0
    colours = np.where(weights[..., None] > 0, 0.7, 0.0).astype(np.float32)
    np.testing.assert_allclose(extend(colours, weights), 0.7, rtol=1e-5)


def test_colours_come_from_close_by():
    colours = np.zeros((64, 64, 1), np.float32)
    colours[:, 32:] = 1.0
    weights = np.ones((64, 64), np.float32)
    weights[:, 12:52] = 0.0
    line = extend(colours, weights)[32, :, 0]
    assert line[14] < 0.1
    assert line[49] > 0.9
    assert np.abs(np.diff(line)).max() < 0.25


def test_nothing_known_is_black():
    result = extend(np.ones((7, 9, 2), np.float32), np.zeros((7, 9), np.float32))
    assert np.isfinite(result).all()


def test_a_weight_between_mixes():
    colours = np.ones((8, 8, 1), np.float32)
    weights = np.ones((8, 8), np.float32)
    weights[4, 4] = 0.5
    colours[4, 4] = 0.0
    assert extend(colours, weights)[4, 4, 0] == pytest.approx(0.5, abs=0.15)
