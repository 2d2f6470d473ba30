"""Fixtures of every room."""

from __future__ import annotations

import os
from pathlib import Path

import pytest
from hypothesis import settings

ROOT = Path(__file__).resolve().parents[1]
IN_CI = os.environ.get("CI", "").lower() == "true"

# No deadlines: a slow machine is not a bug. In CI the same examples every time.
settings.register_profile("local", deadline=None)
settings.register_profile("ci", deadline=None, derandomize=True)
settings.load_profile("ci" if IN_CI else "local")


@pytest.fixture(scope="session")
def root() -> Path:
    """The root of the repository."""
    return ROOT


@pytest.fixture(scope="session")
def shared_data() -> Path:
    """The folder of data that is not part of the repository: head meshes, models.

    It lies beside the repository or where PDEFACE_SHARED says. Without it the tests that need it
    are skipped, except in CI, where they must run.
    """
    folder = Path(os.environ.get("PDEFACE_SHARED") or ROOT.parent / "shared")
    if (folder / "data").is_dir():
        return folder
    message = f"no data in {folder}; set PDEFACE_SHARED to the folder that holds data/"
    if IN_CI:
        pytest.fail(message)
    pytest.skip(message)


@pytest.fixture(scope="session")
def ffmpeg() -> str:
    """The program that writes films."""
    try:
        import imageio_ffmpeg
    except ImportError:
        missing = "imageio-ffmpeg is not installed; run: pip install '.[video]'"
        if IN_CI:
            pytest.fail(missing)
        pytest.skip(missing)
    return str(imageio_ffmpeg.get_ffmpeg_exe())


@pytest.fixture(scope="session")
def model(shared_data: Path) -> Path:
    """The model's file; without it or MediaPipe tests are skipped, in CI they fail."""
    if not IN_CI:
        pytest.importorskip("mediapipe", reason="needs the extra 'photo'", exc_type=ImportError)
    from pdeface.photo.model import NAME

    path = shared_data / "models" / NAME
    if not path.is_file():
        message = f"no {NAME} in {path.parent}"
        (pytest.fail if IN_CI else pytest.skip)(message)
    return path
