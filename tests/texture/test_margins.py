"""The skin beside the openings, after the photo's lashes and teeth are taken off it."""

from __future__ import annotations

import numpy as np

from pdeface.template import openings
from pdeface.texture._margins import clean_margins

HEIGHT, WIDTH = 540, 400
SKIN, LASH = np.array([200, 160, 140]), np.array([30, 20, 20])
U, V = np.arange(0.5, HEIGHT) / HEIGHT, np.arange(0.5, WIDTH) * (np.pi / WIDTH)


def band(index: int, above: float, below: float) -> np.ndarray:
    """Texels up to so many rows above and below the lines of an opening, the opening left out."""
    opening = openings()[index]
    upper, lower = opening.lines(V)
    (start, end), width = opening.corners, opening.corners[1] - opening.corners[0]
    within = (start + 0.2 * width < V) & (end - 0.2 * width > V)
    rows = 27 * (upper - U[:, None]), 27 * (U[:, None] - lower)
    return within & (((rows[0] > 0) & (rows[0] < above)) | ((rows[1] > 0) & (rows[1] < below)))


def painted() -> np.ndarray:
    image = np.broadcast_to(SKIN, (HEIGHT, WIDTH, 3)).astype(np.uint8).copy()
    image[band(0, 1.5, 0.0) | band(1, 1.5, 0.0)] = LASH
    image[band(2, 0.5, 0.45)] = 250
    return image


def test_lashes_and_teeth_give_way_to_the_skin_around() -> None:
    cleaned = clean_margins(painted()).astype(int)
    for lid in (0, 1):
        away_from_the_line = band(lid, 1.5, 0.0) & ~band(lid, 0.6, 0.0)
        assert np.abs(cleaned[away_from_the_line] - SKIN).max() < 12
    lips = band(2, 0.5, 0.45) & ~band(2, 0.25, 0.25)
    assert np.abs(cleaned[lips] - SKIN).max() < 12


def test_a_dark_line_stays_at_the_margins() -> None:
    plain = np.broadcast_to(SKIN, (HEIGHT, WIDTH, 3)).astype(np.uint8)
    cleaned = clean_margins(plain).astype(int)
    assert cleaned[band(0, 0.08, 0.0)].mean() < 0.6 * SKIN.mean()
    away = cleaned[band(0, 3.0, 0.0) & ~band(0, 1.0, 0.0)]
    assert np.abs(away - SKIN).max() <= 1


def test_what_is_not_beside_an_opening_is_left_alone() -> None:
    image = painted()
    cleaned = clean_margins(image)
    far = np.ones((HEIGHT, WIDTH), bool)
    for opening in openings():
        upper, lower = opening.lines(V)
        start, end = opening.corners
        near = (27 * (upper - U[:, None]) < 3) & (27 * (U[:, None] - lower) < 1.5)
        far &= ~(near & (start - 0.01 < V) & (end + 0.01 > V))
    np.testing.assert_array_equal(cleaned[far], image[far])
    inside = [openings()[0].lines(V), openings()[0].corners]
    eye = (U[:, None] > inside[0][0] + 1e-3) & (U[:, None] < inside[0][1] - 1e-3)
    eye &= (inside[1][0] < V) & (inside[1][1] > V)
    np.testing.assert_array_equal(cleaned[eye], image[eye])
