"""A face whose every file can be checked by eye, and the validator of the Khronos Group."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from pdeface.curves import BoundaryCurves, curve_parameters
from pdeface.face import Face

VALIDATOR = Path(__file__).parent / "validator"


@pytest.fixture(scope="session")
def plain() -> Face:
    """A barrel about the y axis: 20 cm high, outwards is away from the axis."""
    v = curve_parameters(46)[:23]
    height = np.linspace(0.1, -0.1, 28)
    radius = 0.08 * np.cos(7.0 * height)
    ring = np.stack([-np.cos(v), np.zeros_like(v), np.sin(v)], -1)
    half = radius[:, None, None] * ring + height[:, None, None] * [0.0, 1.0, 0.0]
    return Face(BoundaryCurves.from_half(half, 0.0))


@pytest.fixture(scope="session")
def quarters() -> np.ndarray:
    """A texture of four colours: red and green above, blue and yellow below."""
    colours = [[(255, 0, 0), (0, 255, 0)], [(0, 0, 255), (255, 255, 0)]]
    return np.repeat(np.repeat(np.array(colours, np.uint8), 32, 0), 32, 1)


@pytest.fixture(scope="session")
def textured(plain: Face, quarters: np.ndarray) -> Face:
    return plain.with_texture(quarters).with_name("Ada")


@pytest.fixture(scope="session")
def photo() -> np.ndarray:
    """(128, 64, 3) something that JPEG is made for."""
    rows, columns = np.mgrid[0:128, 0:64]
    waves = [np.sin(rows / 9 + k) * np.cos(columns / 11 - k) for k in range(3)]
    noise = np.random.default_rng(1).normal(0, 3, (128, 64, 3))
    return np.clip(128 + 90 * np.stack(waves, -1) + noise, 0, 255).astype(np.uint8)


@pytest.fixture(scope="session")
def khronos() -> Callable[[Path], dict[str, Any]]:
    """Runs the Khronos glTF validator on a file and returns its report."""
    node = shutil.which("node")
    missing = None
    if node is None:
        missing = "Node.js is not installed"
    elif not (VALIDATOR / "node_modules" / "gltf-validator").is_dir():
        missing = f"the glTF validator is not installed; run: npm ci --prefix {VALIDATOR}"
    if missing and os.environ.get("CI", "").lower() == "true":
        pytest.fail(missing)
    if missing:
        pytest.skip(missing)

    def validate(file: Path) -> dict[str, Any]:
        command = [str(node), str(VALIDATOR / "validate.mjs"), str(file)]
        answer = subprocess.run(command, capture_output=True, text=True, check=False)
        assert answer.returncode == 0, answer.stderr
        report: dict[str, Any] = json.loads(answer.stdout)
        return report

    return validate


@pytest.fixture(scope="session")
def check_quarters() -> Callable[[np.ndarray, np.ndarray], None]:
    """Checks that each vertex has the colour of its quarter of the face.

    The subject's right is -X, the forehead +Y; vertices at the borders of quarters are let off.
    """

    def check(vertices: np.ndarray, colours: np.ndarray) -> None:
        right, upper = vertices[:, 0] < -0.012, vertices[:, 1] > 0.012
        left, lower = vertices[:, 0] > 0.012, vertices[:, 1] < -0.012
        for where, colour in (
            (right & upper, (255, 0, 0)),
            (left & upper, (0, 255, 0)),
            (right & lower, (0, 0, 255)),
            (left & lower, (255, 255, 0)),
        ):
            assert where.sum() > 10
            np.testing.assert_array_equal(
                colours[where][:, :3], np.broadcast_to(colour, (where.sum(), 3))
            )

    return check
