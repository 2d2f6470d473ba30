"""The edge under the jaw: no folds, and else as it was."""

from __future__ import annotations

import numpy as np
import pytest

from pdeface.scan.laying import _with_fair_rim
from pdeface.scan.model import dense_neutral


@pytest.mark.parametrize(("height", "stays"), [(3.0e-3, False), (0.2e-3, True)])
def test_deep_folds_of_the_neck_go_and_shallow_ones_stay(height: float, stays: bool) -> None:
    u, v = np.linspace(0.0, 1.0, 217), (np.arange(184) + 0.5) * (np.pi / 184)
    neutral = dense_neutral(u, v)
    folds = height * np.sin(24.0 * v) * (u[:, None] > 0.93)
    folded = neutral + folds[..., None] * np.array([0.0, 1.0, 0.0])
    off = _with_fair_rim(folded, neutral) - neutral
    edge = np.sqrt((off[-4:] ** 2).mean() * 6.0) / height
    assert edge > 0.9 if stays else edge < 0.2
    assert np.array_equal(off[:190], (folded - neutral)[:190])
