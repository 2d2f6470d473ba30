"""How near identities are to each other, and who is told worse than the neutral face."""

from __future__ import annotations

import numpy as np
import pytest

pytest.importorskip("scipy", reason="needs the extra 'template'")

import pdeface
from pdeface.controls import CONTROLS
from pdeface.photo.build.nearness import metric, shares_worse


@pytest.fixture(scope="module")
def by():
    return metric()


def test_identities_are_some_millimetre_from_the_neutral_face(by) -> None:
    np.testing.assert_allclose(by, by.T, atol=1e-15)
    assert np.linalg.eigvalsh(by).min() > 0.0
    assert np.sqrt(np.diag(by)).min() > 1e-5
    assert np.sqrt(np.diag(by)).max() < 3e-3
    people = np.random.default_rng(0).normal(size=(100, 50))
    usual = np.sqrt(np.einsum("ni,ij,nj->n", people, by, people)).mean()
    assert 1e-3 < usual < 4e-3


def test_it_is_less_than_what_the_mesh_moves_along_its_normals(by) -> None:
    """What a head's place and size explain has been taken off."""
    weights = np.random.default_rng(1).normal(size=50)
    names = [n for n, c in CONTROLS.items() if c.kind == "identity"]
    meshes = [face.mesh(61, 91, openings="none") for face in (
        pdeface.neutral(), pdeface.neutral().with_weights(dict(zip(names, weights, strict=True)))
    )]  # fmt: skip
    v, u = np.asarray(meshes[0].texcoords).T
    some = (u < 0.93) & (np.abs(np.pi * v - np.pi / 2) < 1.2)
    moved = (meshes[1].vertices - meshes[0].vertices)[some]
    along = np.einsum("ni,ni->n", moved, meshes[0].normals[some])
    own = weights @ by @ weights
    assert 0.2 * np.mean(along**2) < own < np.mean(along**2)


def test_who_is_told_exactly_is_not_worse_and_who_is_told_threefold_is() -> None:
    truth = np.random.default_rng(2).normal(size=(200, 50))
    assert shares_worse(truth, truth) == (0.0, 0.0)
    assert shares_worse(0.0 * truth, truth) == (0.0, 0.0)
    assert shares_worse(3.0 * truth, truth) == (1.0, 1.0)


def test_those_near_to_the_neutral_face_are_told_worse_by_the_same_error() -> None:
    rng = np.random.default_rng(3)
    truth = rng.normal(size=(2000, 50)) * rng.uniform(0.2, 1.5, (2000, 1))
    some, near = shares_worse(truth + rng.normal(size=truth.shape) * 0.5, truth)
    assert 0.0 < some < near < 1.0
