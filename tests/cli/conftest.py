"""A small face in a file, and a way to run the command line in this process."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest

from pdeface.__main__ import main
from pdeface.curves import BoundaryCurves, curve_parameters
from pdeface.face import Face


@dataclass(frozen=True)
class Outcome:
    """What a command left behind."""

    status: int
    out: str
    err: str


Command = Callable[..., Outcome]


@pytest.fixture
def pdeface_command(capfd: pytest.CaptureFixture[str]) -> Command:
    """``pdeface_command("info", path)`` runs ``pdeface info PATH``."""

    def run(*words: object) -> Outcome:
        status = main([str(word) for word in words])
        captured = capfd.readouterr()
        return Outcome(status, captured.out, captured.err)

    return run


@pytest.fixture(scope="session")
def bust() -> Face:
    """An egg of 7 x 16 points and the size of a head, with a texture of two colours."""
    v = curve_parameters(16)
    height = np.linspace(0.1, -0.1, 7)[:, None]
    width = 0.08 - 3.0 * height**2
    points = np.stack(
        [-width * np.cos(v), np.broadcast_to(height, (7, 16)), width * np.sin(v)], axis=-1
    )
    texture = np.full((8, 12, 3), (200, 150, 120), dtype=np.uint8)
    texture[4:] = (120, 80, 60)
    return Face(BoundaryCurves(points), texture=texture, name="bust", notes={"licence": "CC0"})


@pytest.fixture
def bust_file(bust: Face, tmp_path: Path) -> Path:
    """The bust as a file."""
    path = tmp_path / "bust.pdeface"
    bust.save(path)
    return path
