"""The face in the bundled portrait, found beforehand: the demonstration needs no model."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np

from pdeface.photo.found import PhotoFace

__all__ = ["DATA", "portrait_face", "write_face"]

DATA = Path(__file__).parent / "data" / "portrait.json"

_DIGITS = 3
"""Of a pixel: a thousandth is far below what the detector knows."""


def portrait_face() -> PhotoFace:
    """What :func:`pdeface.photo.find_faces` finds in :func:`pdeface.texture.portrait`'s photo."""
    stored = json.loads(DATA.read_text(encoding="utf-8"))
    width, height = stored["image_size"]
    return PhotoFace(
        landmarks=np.array(stored["landmarks"], dtype=np.float64),
        scores=stored["scores"],
        pose=np.array(stored["pose"], dtype=np.float64),
        image_size=(width, height),
        traits=np.array(stored["traits"], dtype=np.float64),
    )


def write_face(face: PhotoFace, path: Path) -> None:
    """Write a found face as :func:`portrait_face` reads it."""
    from pdeface.files import atomic_write

    if face.traits is None:
        raise ValueError("a face to keep must have traits")
    stored = {
        "image_size": list(face.image_size),
        "pose": face.pose.round(6).tolist(),
        "scores": {name: round(score, 4) for name, score in face.scores.items()},
        "traits": face.traits.round(_DIGITS).tolist(),
        "landmarks": face.landmarks.round(_DIGITS).tolist(),
    }
    lines = json.dumps(stored, indent=None, separators=(",", ":")).replace("],[", "],\n[")
    atomic_write(path, (lines + "\n").encode("utf-8"))
