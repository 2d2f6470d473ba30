"""Work in a process of its own: its result, its words, its errors, its end."""

from __future__ import annotations

import os
import sys
from pathlib import Path

import pytest

from pdeface.errors import InputError, PDEFaceError
from pdeface.studio.apart import apart


@pytest.fixture
def work(monkeypatch):
    """Functions that the other process can import by name."""
    monkeypatch.syspath_prepend(Path(__file__).parent)
    import far_work

    yield far_work
    del sys.modules["far_work"]


def test_it_is_done_elsewhere_and_tells_how_far_it_is(work) -> None:
    told, shown = [], []
    value, process = apart(
        work.doubled, 21, tell=lambda text, share: told.append((text, share)), show=shown.append
    )
    assert value == 42
    assert process != os.getpid()
    assert told == [("begun", 0.0), ("half way", 0.5)]
    assert [each["face"].tolist() for each in shown] == [[21, 21]]


def test_errors_come_back_as_they_are_or_as_their_text(work) -> None:
    with pytest.raises(InputError, match="expected a face, got a cat"):
        apart(work.refused, "a cat")
    with pytest.raises(PDEFaceError, match="unexpected Unportable: odd"):
        apart(work.strange)


def test_a_process_that_ends_without_a_word_is_told_of(work) -> None:
    with pytest.raises(PDEFaceError, match="ended before its time"):
        apart(work.gone)
