"""Textures of the parts."""

from __future__ import annotations

import numpy as np
import pytest

from pdeface.anatomy import PARTS, textures
from pdeface.errors import InputError


@pytest.mark.parametrize("name", PARTS)
def test_every_part_has_a_texture(name: str) -> None:
    pixels = textures.texture(name)
    assert pixels.dtype == np.uint8 and pixels.ndim == 3 and pixels.shape[2] == 3
    assert not pixels.flags.writeable


def test_an_eye_is_dark_in_the_middle_coloured_round_it_and_light_beyond() -> None:
    pixels = textures.eye((40, 60, 160)).astype(float)
    around = pixels.mean(axis=1)
    light = around.mean(axis=1)
    iris = around[light.searchsorted(40.0) + 20]
    assert light[10] < 20.0
    assert iris[2] > iris[0] + 30.0
    assert light.max() > 200.0
    assert np.abs(np.diff(light)).max() < 40.0


def test_fibres_close_round_the_pupil() -> None:
    pixels = textures.eye().astype(float)
    seam = np.abs(pixels[:, 0] - pixels[:, -1]).mean()
    assert seam < 2.0 * np.abs(np.diff(pixels, axis=1)).mean() + 1.0


def test_teeth_are_white_at_the_edge_and_gum_at_the_root() -> None:
    upper, lower = (textures.teeth(name).astype(float) for name in ("upper", "lower"))
    quarter = upper.shape[1] // 4
    for pixels, edge in ((upper, 3 * quarter), (lower, quarter)):
        front = pixels[pixels.shape[0] // 3 : -pixels.shape[0] // 3]
        assert np.median(front[:, edge, 1]) > 200.0
        assert np.median(front[:, 4 * quarter - edge, 0] - front[:, 4 * quarter - edge, 1]) > 50.0
        # The molars lie in the shadow of the cheeks.
        assert pixels[20:60].mean() < 0.6 * front.mean()


def test_colours_that_are_none_are_refused() -> None:
    with pytest.raises(InputError, match="three numbers from 0 to 255"):
        textures.eye((300, 0, 0))
