"""The arithmetic coder: what goes in comes out, in about as many bytes as there is to say."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from pdeface.compact.coder import Decoder, Encoder
from pdeface.errors import FileFormatError

numbers = st.lists(
    st.tuples(st.integers(-(2**30), 2**30) | st.integers(-3, 3), st.integers(0, 3)), max_size=300
)


@given(numbers)
def test_numbers_come_back(pairs) -> None:
    encoder = Encoder()
    for value, context in pairs:
        encoder.number(value, context)
    decoder = Decoder(encoder.finish())
    assert [decoder.number(context) for _, context in pairs] == [value for value, _ in pairs]


@given(st.binary(max_size=200), st.integers(1, 300))
def test_any_bytes_are_numbers_or_an_error(data, count) -> None:
    decoder = Decoder(data)
    try:
        for at in range(count):
            decoder.number(at % 3)
    except FileFormatError as error:
        assert "damaged" in str(error)


@pytest.mark.parametrize("chance", [0.01, 0.1, 0.5])
def test_bits_take_about_their_entropy(chance) -> None:
    """Zeros and ones (with their signs, a bit each) of a known chance."""
    rng = np.random.default_rng(3)
    values = (rng.random(20_000) < chance) * rng.choice([-1, 1], 20_000)
    encoder = Encoder()
    for value in values.tolist():
        encoder.number(value, "all")
    entropy = -(chance * np.log2(chance) + (1 - chance) * np.log2(1 - chance)) + chance
    assert 8 * len(encoder.finish()) < 1.04 * entropy * len(values) + 200


def test_a_carry_runs_through_all_that_was_written() -> None:
    """Long runs of the likelier bit push the interval to its upper end, bytes of 255 with it."""
    rng = np.random.default_rng(0)
    for seed in range(50):
        values = np.where(rng.random(400) < 0.02, rng.integers(-60, 60, 400), 1).tolist()
        encoder = Encoder()
        for value in values:
            encoder.number(value, seed % 2)
        decoder = Decoder(encoder.finish())
        assert [decoder.number(seed % 2) for _ in values] == values
