"""Faces and what lies behind their openings."""

from __future__ import annotations

import numpy as np
import pytest

import pdeface
from pdeface.anatomy import OPENINGS, Anatomy, Outline, outline_uv, placed
from pdeface.uvmesh import UVMesh


def outline(face: pdeface.Face) -> Outline:
    return Outline.sampled(face.surface())


def difference(first: Outline, second: Outline) -> Outline:
    both = [(np.array(getattr(first, n)), np.array(getattr(second, n))) for n in OPENINGS]
    return Outline(*(a - b for a, b in both))


def skin(face: pdeface.Face, openings: tuple[str, ...]) -> np.ndarray:
    """(n, 3) dense points of the skin outside these openings."""
    grid = UVMesh(433, 481)
    u, v = np.meshgrid(grid.u, grid.v, indexing="ij")
    outside = np.ones(u.shape, dtype=bool)
    for name in openings:
        rows, columns = outline_uv(name)
        outside &= (u < rows[0, 0]) | (u > rows[1, 0]) | (v < columns[0]) | (v > columns[-1])
    return face.mesh(433, 481).vertices[outside.ravel()]


def anatomy_of(face: pdeface.Face) -> Anatomy:
    lids = [face.set(eyeBlinkLeft=b, eyeBlinkRight=b) for b in (0.5, 1.0)]
    return placed(outline(face), [outline(each) for each in lids])


@pytest.fixture(scope="session")
def rest() -> Outline:
    return outline(pdeface.neutral())


@pytest.fixture(scope="session")
def neutral() -> Anatomy:
    return anatomy_of(pdeface.neutral())
