"""MediaPipe's model, the bundled portrait and what is found in it."""

from __future__ import annotations

from pathlib import Path

import pytest
from numpy.typing import NDArray

from pdeface.photo import PhotoFace, find_faces
from pdeface.photo.model import VARIABLE
from pdeface.texture import portrait


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
