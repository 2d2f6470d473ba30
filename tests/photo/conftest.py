"""MediaPipe's model, the bundled portrait and what is found in it."""

from __future__ import annotations

import os
from pathlib import Path

import pytest
from numpy.typing import NDArray

from pdeface.photo import PhotoFace, find_faces
from pdeface.photo.model import NAME, VARIABLE
from pdeface.texture import portrait

IN_CI = os.environ.get("CI", "").lower() == "true"


@pytest.fixture(scope="session")
def model(shared_data: Path) -> Path:
    """The model's file; without it or MediaPipe tests are skipped, in CI they fail."""
    if not IN_CI:
        pytest.importorskip("mediapipe", reason="needs the extra 'photo'", exc_type=ImportError)
    path = shared_data / "models" / NAME
    if not path.is_file():
        message = f"no {NAME} in {path.parent}"
        (pytest.fail if IN_CI else pytest.skip)(message)
    return path


@pytest.fixture
def model_named(model: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The model's file, which the environment names."""
    monkeypatch.setenv(VARIABLE, str(model))
    return model


@pytest.fixture(scope="session")
def photo() -> NDArray:
    return portrait()[0]


@pytest.fixture(scope="session")
def collins(photo: NDArray, model: Path) -> PhotoFace:
    """The face in the bundled portrait."""
    faces = find_faces(photo, model)
    assert len(faces) == 1
    return faces[0]
