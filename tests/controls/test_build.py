"""The command that measures the controls."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from pdeface.controls.measured import DATA, IDENTITIES

pytest.importorskip("igl", reason="needs the extra 'template'")


def test_the_command_rebuilds_what_ships(shared_data: Path, tmp_path: Path) -> None:
    target = tmp_path / "measured.npz"
    command = [sys.executable, "-m", "pdeface.controls.build"]
    command += [str(shared_data / "data" / "ict_facekit"), "-o", str(target)]
    subprocess.run(command, check=True)
    with np.load(target) as built, np.load(DATA) as shipped:
        assert set(built.files) == set(shipped.files)
        assert len(shipped["identity"]) == IDENTITIES
        assert built["names"].tolist() == shipped["names"].tolist()
        for part in ("smooth", "parting", "identity"):
            scales = [f[f"{part}_scale"][:, None, None, None] for f in (built, shipped)]
            # Two micrometres: the steps of the stored numbers.
            difference = built[part] * scales[0] - shipped[part] * scales[1]
            assert np.abs(difference).max() < 4e-6


@pytest.mark.parametrize("upper_share", [0.0, 0.5, 1.0])
def test_splitting_keeps_the_whole_and_parts_nothing_beyond_the_corners(upper_share) -> None:
    from pdeface.controls.build.openings import Opening, split

    v = np.linspace(0.0, np.pi, 184)
    samples = np.random.default_rng(0).normal(size=(217, 184, 3))
    mouth = Opening("mouth_seam_upper", "mouth_seam_lower", 1.2, np.pi - 1.2, 5.0, upper_share)
    smooth, parting = split(samples, v, [mouth])
    outside = np.r_[: 8 * 18 + 1, 8 * 19 : 217]
    np.testing.assert_allclose((smooth + parting)[outside], samples[outside], atol=1e-15)
    far = (v < 1.1) | (v > np.pi - 1.1)
    np.testing.assert_allclose((smooth + parting)[:, far], samples[:, far], atol=1e-15)
    inside = (v > 1.4) & (v < np.pi - 1.4)
    np.testing.assert_allclose(smooth[144, inside], smooth[152, inside], atol=1e-12)
    assert not parting[:, (v < 1.2) | (v > np.pi - 1.2)].any()
    assert not parting[: 8 * 13].any()


def test_what_lies_between_the_lips_is_bridged_and_parts_evenly() -> None:
    from pdeface.controls.build.openings import Opening, split

    v = np.linspace(0.0, np.pi, 184)
    rows = np.linspace(0.0, 27.0, 217)[:, None, None]
    jerk = np.where(rows < 18.4, 0.0, -1.0) * np.ones((1, 184, 3))
    mouth = Opening("mouth_seam_upper", "mouth_seam_lower", 1.2, np.pi - 1.2, 5.0, 0.0, beyond=0.08)
    smooth, parting = split(jerk, v, [mouth])
    inside = (v > 1.25) & (v < np.pi - 1.25)
    assert np.abs(smooth[8 * 18 : 8 * 19 + 1, inside]).max() < 1e-12
    steps = np.diff(parting[8 * 18 : 8 * 19 + 1, inside], axis=0)
    np.testing.assert_allclose(steps, -1.0 / 8.0, atol=1e-12)
    assert parting[8 * 19, (v > 1.13) & (v < 1.2)].any(), "its corners part a little beyond"
    assert not parting[:, (v < 1.12) | (v > np.pi - 1.12)].any()
