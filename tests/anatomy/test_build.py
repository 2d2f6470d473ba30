"""The command that measures what lies behind the openings."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import numpy as np

from pdeface.anatomy.measured import DATA


def test_the_command_rebuilds_what_ships(shared_data: Path, tmp_path: Path) -> None:
    target = tmp_path / "anatomy.npz"
    command = [sys.executable, "-m", "pdeface.anatomy.build"]
    command += [str(shared_data / "data" / "ict_facekit"), "-o", str(target)]
    subprocess.run(command, check=True)
    with np.load(target) as built, np.load(DATA) as shipped:
        assert set(built.files) == set(shipped.files)
        assert built["jaw_names"].tolist() == shipped["jaw_names"].tolist()
        for name in set(built.files) - {"jaw_names"}:
            np.testing.assert_allclose(built[name], shipped[name], atol=1e-7)


def test_the_jaw_s_motions_are_those_of_the_lower_teeth(shared_data: Path) -> None:
    from pdeface.anatomy.build.teeth import lower_and_upper
    from pdeface.anatomy.measured import Frame, jaw_motion, reference
    from pdeface.template.build.head import load_head

    folder = shared_data / "data" / "ict_facekit"
    head = load_head(folder)
    lower, upper = lower_and_upper(head)
    frame = Frame.between(reference().mouth, reference().mouth)
    with np.load(folder / "expressions.npz") as file:
        moved = dict(zip(file["names"].tolist(), file["offsets_cm"] / 100.0, strict=True))
    jaw = ("jawOpen", "jawForward", "jawLeft", "jawRight")
    for name in jaw:
        ours = jaw_motion(head.vertices[lower], frame, {name: 1.0})
        np.testing.assert_allclose(ours, moved[name][lower], atol=2e-4)
        assert np.abs(moved[name][upper]).max() < 1e-6
    missing = [
        name for name in moved if name not in ("jawOpen", "jawForward", "jawLeft", "jawRight")
    ]
    assert max(np.abs(moved[name][lower]).max() for name in missing) < 1e-3
