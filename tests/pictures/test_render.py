from __future__ import annotations

from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

import pdeface
from pdeface.errors import InputError
from pdeface.face import Face
from pdeface.pictures import canvas, raster_numpy, raster_vtk, render
from pdeface.pictures.camera import VIEWS
from pdeface.pictures.light import RIGS
from pdeface.pictures.options import FINE_MESH, PAPER_MESH
from pdeface.pictures.styles import STYLES
from pdeface.pictures.styles.curvature import FINE as CURVATURE_MESH

SIZE = (160, 200)
MESH = (40, 50)


def shape_of(face: Face, view: object) -> np.ndarray:
    """(H, W) alpha, 0 to 255."""
    image = render(face, view=view, style="shaded", mesh=MESH, size=SIZE, transparent=True)  # type: ignore[arg-type]
    return image[..., 3].astype(float)


def test_it_is_the_librarys_render() -> None:
    assert pdeface.render is render


@pytest.mark.parametrize("style", STYLES)
@pytest.mark.parametrize("view", ["front", "three-quarter", "profile", -60])
def test_every_style_from_every_side(painted: Face, style: str, view: object) -> None:
    image = render(painted, view=view, style=style, mesh=MESH, size=SIZE)  # type: ignore[arg-type]
    assert image.shape == (200, 160, 3)
    assert image.dtype == np.uint8
    empty = render_background()
    touched = np.abs(image.astype(int) - empty).max(axis=-1) > 12
    assert 0.2 < touched.mean() < 0.9


def render_background() -> np.ndarray:
    from pdeface.pictures.ground import background_image

    return np.round(255 * background_image("studio", SIZE)).astype(int)


def test_the_styles_are_different_pictures(painted: Face) -> None:
    images = [
        render(painted, style=style, mesh=MESH, size=SIZE, colour_bar=False).astype(int)
        for style in STYLES
    ]
    for k, one in enumerate(images):
        assert all(np.abs(one - other).mean() > 2.0 for other in images[k + 1 :])


def test_the_views_are_different_pictures(head: Face) -> None:
    shapes = [shape_of(head, view) for view in ("front", 35, 90)]
    assert all(np.abs(a - b).mean() > 2.0 for a, b in pairwise(shapes))


@pytest.mark.parametrize("view", ["front", "three-quarter", "profile", (20, 25)])
def test_the_face_is_in_the_middle_and_whole(head: Face, view: object) -> None:
    covered = np.argwhere(shape_of(head, view) > 128)
    (top, left), (bottom, right) = covered.min(axis=0), covered.max(axis=0)
    assert abs((left + right) / 2 - (SIZE[0] - 1) / 2) <= 2.0
    assert abs((top + bottom) / 2 - (SIZE[1] - 1) / 2) <= 12.0
    assert min(left, top, SIZE[0] - 1 - right, SIZE[1] - 1 - bottom) > 2


def test_the_front_view_of_a_symmetric_face_is_symmetric(head: Face) -> None:
    shape = shape_of(head, "front")
    assert np.abs(shape - shape[:, ::-1]).mean() < 1.0


def test_opposite_sides_are_mirror_images(head: Face) -> None:
    shape = shape_of(head, "three-quarter")
    other = shape_of(head, "three-quarter-right")
    assert np.abs(shape - other[:, ::-1]).mean() < 1.5


def test_the_left_cheek_is_on_the_right_of_the_picture(painted: Face) -> None:
    image = render(painted, view="front", mesh=MESH, size=SIZE).astype(int)
    red = np.argwhere(image[..., 0] - image[..., 2] > 80)
    blue = np.argwhere(image[..., 2] - image[..., 0] > 80)
    assert len(red) > 50
    assert len(blue) > 50
    assert red[:, 1].min() > SIZE[0] / 2 > blue[:, 1].max()


def test_a_positive_azimuth_shows_the_left_cheek(painted: Face) -> None:
    image = render(painted, view=70, mesh=MESH, size=SIZE).astype(int)
    assert (image[..., 0] - image[..., 2] > 80).sum() > 100
    assert (image[..., 2] - image[..., 0] > 80).sum() == 0


def test_the_texture_keeps_its_colours(head: Face) -> None:
    """Nearly even light: in the middle of the face a colour is about what the photo says."""
    plain = head.with_texture(np.full((8, 8, 3), (180, 120, 90), np.uint8))
    pixel = render(plain, mesh=MESH, size=SIZE)[60, 80].astype(float)
    np.testing.assert_allclose(pixel, [180, 120, 90], rtol=0.12)


def test_a_transparent_texture_shows_clay(head: Face) -> None:
    clear = np.zeros((8, 8, 4), np.uint8)
    image = render(head.with_texture(clear), mesh=MESH, size=SIZE)
    assert image[60, 80].min() > 100


def test_without_a_texture_the_face_is_shaded(head: Face) -> None:
    by_default = render(head, mesh=MESH, size=SIZE)
    np.testing.assert_array_equal(by_default, render(head, style="shaded", mesh=MESH, size=SIZE))
    with pytest.raises(InputError, match="texture"):
        render(head, style="textured")


def test_transparent_pictures_are_clear_around_the_face(head: Face) -> None:
    image = render(head, mesh=MESH, size=SIZE, transparent=True)
    assert image.shape == (200, 160, 4)
    assert image[0, 0, 3] == image[-1, -1, 3] == 0
    assert image[100, 80, 3] == 255
    # Edges are partly covered and as bright as what they belong to: no dark fringe.
    edge = (image[..., 3] > 40) & (image[..., 3] < 215)
    assert edge.sum() > 50
    solid = render(head, mesh=MESH, size=SIZE, background="white")
    over_white = 255 - image[..., 3:].astype(float) / 255 * (255 - image[..., :3].astype(float))
    assert np.abs(over_white - solid)[edge].max() <= 3.0


@pytest.mark.parametrize("background", ["white", "#102030", (0.1, 0.5, 1.0)])
def test_plain_backgrounds(head: Face, background: object) -> None:
    image = render(head, mesh=MESH, size=SIZE, background=background)
    expected = {"white": (255,) * 3, "#102030": (16, 32, 48)}.get(str(background), (26, 128, 255))
    np.testing.assert_allclose(image[0, 0], expected, atol=1)


def test_the_inside_of_the_mask_is_dark(head: Face) -> None:
    outside = render(head, view="front", mesh=MESH, size=SIZE, transparent=True)
    inside = render(head, view="back", mesh=MESH, size=SIZE, transparent=True)
    assert inside[100, 80, :3].mean() < 0.7 * outside[100, 80, :3].mean()


def test_joins_and_lights_and_loops_change_the_picture(head: Face) -> None:
    def picture(**changes: object) -> np.ndarray:
        return render(head, mesh=MESH, size=SIZE, **changes).astype(int)  # type: ignore[arg-type]

    assert np.abs(picture() - picture(light="raking")).mean() > 5.0
    assert np.abs(picture() - picture(join="patchwise")).max() > 3
    assert np.abs(picture(style="curves") - picture(style="curves", loops=True)).mean() > 2.0


def test_curvature_is_red_where_the_face_bulges_and_has_a_legend(head: Face) -> None:
    image = render(head, style="curvature", mesh=MESH, size=SIZE, colour_bar=False).astype(int)
    redness = image[..., 0] - image[..., 2]
    assert redness[108:118, 78:82].min() > 30  # the nose
    assert redness[100:125].min() < -30  # the hollow beside it
    with_bar = render(head, style="curvature", mesh=MESH, size=SIZE)
    foot = with_bar[-20:, 45:115].reshape(-1, 3).astype(int)
    assert (foot[:, 0] - foot[:, 2]).max() > 60
    assert (foot[:, 2] - foot[:, 0]).max() > 60


def test_a_flat_face_has_no_curvature_to_colour() -> None:
    u, v = np.meshgrid(np.linspace(0.1, -0.1, 7), np.linspace(-0.08, 0.08, 8), indexing="ij")
    half = np.stack([v, u, 0.0 * u], axis=-1)
    flat = Face(pdeface.BoundaryCurves.from_half(half, 0.0))
    image = render(flat, style="curvature", mesh=(20, 20), size=SIZE)
    assert image.shape == (200, 160, 3)


@pytest.mark.parametrize("name", ["a.png", "a.jpg", "a.webp", "A.PNG"])
def test_files(head: Face, tmp_path: Path, name: str) -> None:
    image = render(head, tmp_path / name, mesh=MESH, size=SIZE)
    stored = np.asarray(Image.open(tmp_path / name).convert("RGB")).astype(int)
    assert np.abs(stored - image).mean() < 2.0
    assert [path.name for path in tmp_path.iterdir()] == [name]


def test_png_is_lossless_with_alpha(head: Face, tmp_path: Path) -> None:
    image = render(head, tmp_path / "a.png", mesh=MESH, size=SIZE, transparent=True)
    np.testing.assert_array_equal(np.asarray(Image.open(tmp_path / "a.png")), image)


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"style": "cubist"}, "style is one of"),
        ({"view": "sideways"}, "view"),
        ({"light": "candle"}, "light is one of"),
        ({"size": (0, 10)}, "size is"),
        ({"size": (10, 10**6)}, "size is"),
        ({"size": 5}, "size is"),
        ({"size": (10.5, 10)}, "size is"),
        ({"background": "nocolour"}, "background is"),
        ({"background": (1, 2, 3)}, "background is"),
        ({"join": "welded"}, "join must"),
    ],
)
def test_what_cannot_be_drawn_is_said(head: Face, changes: dict[str, object], message: str) -> None:
    with pytest.raises(InputError, match=message) as caught:
        render(head, **{"mesh": MESH, "size": SIZE, **changes})  # type: ignore[arg-type]
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("name", "transparent"), [("a.tiff", False), ("a", False), ("a.jpg", True), ("no/a.png", False)]
)
def test_what_cannot_be_written_is_said(
    head: Face, tmp_path: Path, name: str, transparent: bool
) -> None:
    with pytest.raises(InputError):
        render(head, tmp_path / name, mesh=MESH, size=SIZE, transparent=transparent)
    assert list(tmp_path.iterdir()) == []


def test_it_draws_without_opengl(
    painted: Face, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    with_it = render(painted, mesh=MESH, size=SIZE).astype(int)
    monkeypatch.setattr(raster_vtk, "available", lambda: False)
    monkeypatch.setattr(canvas, "_rasteriser", canvas._rasteriser.__wrapped__)
    assert canvas._rasteriser() is raster_numpy.draw
    without = render(painted, mesh=MESH, size=SIZE).astype(int)
    assert np.abs(with_it - without).mean() < 1.0


def test_the_docs_name_every_view_style_and_light(root: Path) -> None:
    text = (root / "docs" / "pictures" / "README.md").read_text(encoding="utf-8")
    missing = [name for name in (*VIEWS, *STYLES, *RIGS) if f"`{name}`" not in text]
    assert missing == []
    for mesh in (FINE_MESH, PAPER_MESH, CURVATURE_MESH):
        assert f"{mesh[0]} x {mesh[1]}" in text
