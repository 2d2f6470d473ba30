"""Scans of known people: their faces sampled finely, and points on them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pytest

import pdeface
from pdeface.scan import Landmarks, Scan, make_scan
from pdeface.scan.landmark_file import known_places

pytest.importorskip("scipy", reason="needs the extra 'scan'")


@dataclass(frozen=True, eq=False)
class Known:
    """A scan of a person who is known.

    Attributes:
        face: the person.
        scan: the face as triangles, metres.
        landmarks: Multi-PIE's 68 and the feature points, where they are.
    """

    face: pdeface.Face
    scan: Scan
    landmarks: Landmarks


def scanned(face: pdeface.Face, rows: int = 163, columns: int = 150) -> Known:
    mesh = face.mesh(rows, columns, openings="none")
    u, v, trust = np.array(list(known_places().values())).T
    landmarks = Landmarks(np.stack([u, v], 1), face.surface()(u, v), trust)
    return Known(face, make_scan(mesh.vertices, mesh.triangles), landmarks)


@pytest.fixture(scope="session")
def known() -> Known:
    """A random person at the finest level."""
    return scanned(pdeface.random(5, "109x184"))
