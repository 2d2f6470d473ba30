"""Heads that are bent, and the mixture that is nearest to them."""

from __future__ import annotations

import numpy as np
import pytest

pytest.importorskip("scipy", reason="needs the extra 'template'")
pytest.importorskip("vtk", reason="needs the extra 'render'")

from pdeface.photo.build.heads import HeadSpace
from pdeface.photo.build.straying import Nearest, bend
from pdeface.photo.mirrors import ACROSS


@pytest.fixture(scope="module")
def space(shared_data) -> HeadSpace:
    return HeadSpace(shared_data / "data" / "ict_facekit")


@pytest.fixture(scope="module")
def nearest(space) -> Nearest:
    return Nearest(space)


def test_of_a_mixture_the_nearest_is_itself_or_a_little_less(space, nearest) -> None:
    weights = np.zeros(space.modes)
    weights[[0, 3, 9]] = 1.5, -1.0, 0.8
    found = nearest(space.head(weights).vertices - space.neutral.vertices)
    shares = found[[0, 3, 9]] / weights[[0, 3, 9]]
    assert shares.min() > 0.7 and shares.max() < 1.02
    assert np.abs(np.delete(found, [0, 3, 9])).max() < 0.2


def test_place_and_size_of_a_head_do_not_count(space, nearest) -> None:
    vertices = space.neutral.vertices
    moved = 0.03 * vertices + np.cross([0.02, -0.01, 0.03], vertices) + (0.1, -0.2, 0.05)
    assert np.abs(nearest(moved)).max() < 1e-3


def test_the_nearest_mixture_is_nearer_than_none(space, nearest) -> None:
    """To a bent head, on its face, once both are moved and scaled as far as they may be."""
    moved = bend(np.random.default_rng(3), space.neutral.vertices)
    weights = np.zeros(space.modes)
    weights[:50] = nearest(moved)
    rest = moved - (space.head(weights).vertices - space.neutral.vertices)
    assert 0.1 < np.abs(weights).max() < 4.0
    left = [nearest(each) for each in (moved, rest)]
    assert np.linalg.norm(left[1]) < 0.6 * np.linalg.norm(left[0])


def test_bends_are_smooth_and_mostly_alike_on_both_sides() -> None:
    rng = np.random.default_rng(0)
    points = rng.uniform(-0.1, 0.1, (400, 3))
    close = points + rng.normal(0.0, 5e-4, points.shape)
    sizes, alike, steps = [], [], []
    for seed in range(30):
        one, other, near = np.split(
            bend(np.random.default_rng(seed), np.concatenate([points, points * ACROSS, close])), 3
        )
        sizes.append(np.sqrt((one**2).mean()))
        alike.append(np.sum(one * other * ACROSS) / np.sum(one**2))
        steps.append(np.sqrt(((near - one) ** 2).mean()) / sizes[-1])
    assert min(sizes) > 0.0 and 1e-3 < max(sizes) < 5e-3
    assert 0.6 < np.mean(alike) < 0.95
    assert max(steps) < 0.15
