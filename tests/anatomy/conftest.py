"""Faces and what lies behind their openings."""

from __future__ import annotations

import numpy as np
import pytest

import pdeface
from pdeface.anatomy import Anatomy, Outline, outline_uv, placed
from pdeface.controls import displacement, slits
from pdeface.pde import PDESurface
from pdeface.uvmesh import UVMesh


def outline(face: pdeface.Face) -> Outline:
    if not face.weights:
        return Outline.sampled(face.surface())
    moved = displacement(face.weights, face.curves.shape)
    parting = PDESurface(moved.parting, continuity=slits(face.curves.shape[0]))
    return Outline.sampled(PDESurface(face.curves.points + moved.smooth), parting)


def skin(face: pdeface.Face, openings: tuple[str, ...]) -> np.ndarray:
    """(n, 3) dense points of the skin outside these openings."""
    grid = UVMesh(433, 481)
    u, v = np.meshgrid(grid.u, grid.v, indexing="ij")
    outside = np.ones(u.shape, dtype=bool)
    for name in openings:
        rows, columns = outline_uv(name)
        upper, lower = (np.interp(v, columns, row, left=2, right=2) for row in rows)
        outside &= (u < upper) | (u > lower)
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
