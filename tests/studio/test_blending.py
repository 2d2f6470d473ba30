"""Two faces as one."""

from __future__ import annotations

import numpy as np
import pytest

import pdeface
from pdeface.curves import BoundaryCurves
from pdeface.errors import InputError
from pdeface.studio.blending import blended


@pytest.fixture(scope="module")
def pair() -> tuple[pdeface.Face, pdeface.Face]:
    one = pdeface.neutral().with_texture(np.full((8, 8, 3), 100, np.uint8))
    longer = one.set(noseLength=1.0).moved_curves
    other = one.with_curves(longer).with_texture(np.full((16, 16, 3), 200, np.uint8))
    return one, other


def test_both_ends_are_the_faces(pair) -> None:
    one, other = pair
    assert blended(one, other, 0.0) == one
    assert blended(one, other, 1.0).curves == other.curves


def test_the_surface_between_is_between(pair) -> None:
    one, other = pair
    ends = [face.mesh().vertices for face in pair]
    found = blended(one, other, 0.25)
    np.testing.assert_allclose(found.mesh().vertices, 0.75 * ends[0] + 0.25 * ends[1], atol=1e-9)
    assert found.texture.shape == (8, 8, 3)
    assert set(found.texture.ravel()) == {125}


def test_a_texture_alone_is_kept(pair) -> None:
    bare = pair[0].with_texture(None)
    assert blended(bare, pair[1], 0.5).texture.shape == (16, 16, 3)
    assert blended(bare, bare, 0.5).texture is None


@pytest.mark.parametrize("share", [-0.1, 1.1, float("nan")])
def test_a_share_out_of_range_is_refused(pair, share: float) -> None:
    with pytest.raises(InputError, match="lies in"):
        blended(*pair, share)


def test_faces_of_different_sizes_are_refused(pair) -> None:
    few = pdeface.Face(BoundaryCurves(np.random.default_rng(0).normal(size=(4, 8, 3))))
    with pytest.raises(InputError, match="as many curves"):
        blended(pair[0], few, 0.5)


def test_the_server_blends(visitor) -> None:
    info = visitor.post("blend", other=visitor.face["id"], share=0.5)
    assert info["texture"] == visitor.face["texture"]
    assert "send it again" in visitor.refused("blend", other="0" * 16, share=0.5)
    assert "is a number" in visitor.refused("blend", other=visitor.face["id"], share="x")
