"""Textures projected from photos: invariants, and a distance to a known truth."""

from __future__ import annotations

import numpy as np
import pytest

import pdeface
from pdeface.errors import InputError
from pdeface.photo import PhotoView, find_faces, fit_shape, projected_texture
from pdeface.photo.alignment import seen
from pdeface.photo.bundled import portrait_face
from pdeface.photo.visibility import trust
from pdeface.texture import portrait
from pdeface.texture._shading import shading


@pytest.fixture(scope="module")
def view() -> PhotoView:
    found = portrait_face()
    return PhotoView(portrait()[0], found, fit_shape(found))


@pytest.fixture(scope="module")
def face(view):
    return seen(view.found, view.shape)


def test_the_landmarks_come_to_lie_where_the_photo_has_them(view, face) -> None:
    assert face.error < 0.01 < view.shape.error


def test_lips_that_touch_on_the_face_are_apart_in_a_smiling_photo(face) -> None:
    mouth = face.mesh.cuts[2]
    upper, lower = (face.places[rows, mouth.columns] for rows in (mouth.upper, mouth.lower))
    gap = np.linalg.norm(upper - lower, axis=1)
    assert gap[len(gap) // 2] > 4.0, "pixels: as high as her teeth are"
    assert gap[0] < 1e-9 and gap[-1] < 1e-9


def test_a_photo_of_one_colour_makes_a_texture_of_that_colour(view) -> None:
    plain = np.full_like(view.photo, (180, 140, 120))
    texture = projected_texture([view._replace(photo=plain)], (96, 128), margins=False)
    assert texture.shape == (96, 128, 3)
    assert np.abs(texture.astype(int) - (180, 140, 120)).max() <= 1


def test_what_is_seen_is_read_where_it_is(view, face) -> None:
    """A photo whose red is x and whose green is y tells where every texel was read."""
    height, width = view.photo.shape[:2]
    x, y = np.meshgrid(np.arange(0.5, width), np.arange(0.5, height))
    ramp = np.stack([x, y, 0.0 * x + 128.0], axis=-1).astype(np.uint8)
    texture = projected_texture([view._replace(photo=ramp)], (163 * 4, 241 * 4), margins=False)
    sure = trust(face.points, face.normals, view.shape.camera.distance) > 0.999
    sure[:, :80] = sure[:, 160:] = False
    row, column = np.nonzero(sure[40:130])
    u, v = face.nodes[row + 40, column].T
    texel = texture[(u * 652).astype(int).clip(0, 651), (v / np.pi * 964).astype(int)]
    off = np.linalg.norm(texel[:, :2] - face.places[row + 40, column], axis=1)
    assert np.median(off) < 1.0
    assert np.quantile(off, 0.95) < 2.5, "pixels; next to openings a texel has two sides"


def test_two_photos_in_different_light_leave_no_seam(view) -> None:
    """The same photo, half as bright, adds nothing to be seen."""
    darker = (view.photo * 0.6).astype(np.uint8)
    one = projected_texture([view], (192, 192))
    two = projected_texture([view, view._replace(photo=darker)], (192, 192))
    assert np.abs(one.astype(int) - two).mean() < 2.5


def test_the_light_on_a_matt_face_is_found(face) -> None:
    """Colours are a reflectance times harmonics of the normal: these come back."""
    normals = face.normals[20:140, 40:200]
    lit = 0.6 + 0.35 * normals[..., 0] + 0.15 * normals[..., 1] + 0.1 * normals[..., 2]
    skin = np.array([200.0, 150.0, 130.0])
    colours = skin * (0.5 * lit[..., None]) ** (1.0 / 2.2)
    found = shading(colours, normals, np.ones(lit.shape))
    expected = np.log(lit / lit.mean()) / 2.2
    off = (found - found.mean()) - (expected - expected.mean())
    assert np.abs(expected).mean() > 0.1
    assert np.abs(off).mean() < 0.01


def test_light_is_divided_out_of_a_texture(view) -> None:
    """The portrait is lighter on her right cheek; without its light the cheeks are more alike."""
    cheeks = (slice(100, 120), slice(40, 60)), (slice(100, 120), slice(132, 152))

    def sides(delight: bool) -> float:
        texture = projected_texture([view], (192, 192), delight=delight)
        right, left = (float(texture[cheek].mean()) for cheek in cheeks)
        return abs(np.log(left / right))

    assert sides(True) < 0.7 * sides(False)


def test_a_texture_needs_a_photo() -> None:
    with pytest.raises(InputError, match="at least one photo"):
        projected_texture([])


def test_a_known_texture_comes_back(model_named) -> None:
    """A face with a known texture, seen from three sides by the whole chain."""
    from pdeface.pictures import render

    truth = projected_texture([PhotoView(portrait()[0], f := portrait_face(), fit_shape(f))])
    face = pdeface.random(3).with_texture(truth)
    views = []
    for azimuth in (0, 30, -30):
        photo = render(face, view=azimuth, style="textured", size=(640, 800))
        found = find_faces(photo)[0]
        views.append(PhotoView(photo, found, fit_shape(found)))
    texture = projected_texture(views, truth.shape[:2])
    middle = slice(120, 430), slice(110, 400)
    got, expected = (t[middle].astype(float) for t in (texture, truth))
    light = np.log(got.mean(axis=(0, 1)) / expected.mean(axis=(0, 1)))
    off = np.abs(got * np.exp(-light) - expected)
    assert off.mean() < 12.0, "of 255, lights and softness of the renderings included"
