"""Samples in rounds that can be kept, so that a long run need not begin anew."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from pdeface.files import atomic_path
from pdeface.photo.build.samples import Numbers, sample

__all__ = ["ROUNDS", "sample_rounds"]

ROUNDS = 53
_PICTURES, _OFTEN, _OF_THE_SAME = 400, 3, 450
_PAIRED, _MIXED = 2, 12
"""In the first rounds each person is seen three times, to learn what photos agree on; after them
once, because people teach more than pictures. After the second number people are bent."""


def sample_rounds(heads: Path, model: Path, rounds: int, cache: Path | None) -> Numbers:
    """Samples of so many rounds, of other people each.

    Args:
        heads: ICT-FaceKit's folder.
        model: MediaPipe's face landmarker.
        rounds: how many, of some 400 pictures each.
        cache: a folder in which rounds are kept and found, or None.
    """
    parts = [_round(heads, model, number, cache) for number in range(1, rounds + 1)]
    people = np.cumsum([0, *(part["person"].max() + 1 for part in parts[:-1])])
    for part, first in zip(parts, people, strict=True):
        part["person"] = part["person"] + first
    return {name: np.concatenate([part[name] for part in parts]) for name in parts[0]}


def _round(heads: Path, model: Path, number: int, cache: Path | None) -> Numbers:
    path = None if cache is None else cache / f"round_{number}.npz"
    if path is not None and path.is_file():
        with np.load(path, allow_pickle=False) as file:
            return {name: file[name] for name in file.files}
    often = number <= _PAIRED
    people, views = (_OF_THE_SAME // _OFTEN, _OFTEN) if often else (_PICTURES, 1)
    found = sample(heads, model, people, views, seed=number, bent=number > _MIXED)
    if path is not None:
        with atomic_path(path) as temporary, open(temporary, "wb") as file:
            np.savez(file, **found)  # type: ignore[arg-type]
    return found
