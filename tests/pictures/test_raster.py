from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from pdeface.face import Face
from pdeface.pictures import raster_numpy, raster_vtk
from pdeface.pictures.camera import Camera, frame
from pdeface.pictures.options import Options
from pdeface.pictures.solid import Solid
from pdeface.pictures.styles import STYLES

SQUARE = np.array([[-0.1, -0.1, 0.0], [0.1, -0.1, 0.0], [0.1, 0.1, 0.0], [-0.1, 0.1, 0.0]])
TWO = np.array([[0, 1, 2], [0, 2, 3]], dtype=np.int32)
CORNERS = np.array([[0.0, 1.0], [1.0, 1.0], [1.0, 0.0], [0.0, 0.0]])
SIZE = (120, 100)

needs_opengl = pytest.mark.skipif(
    not raster_vtk.available(), reason="PyVista or an OpenGL driver is not installed"
)


def square(color: tuple[float, float, float], z: float = 0.0) -> Solid:
    return Solid(SQUARE + np.array([0.0, 0.0, z]), TWO, np.tile(color, (4, 1)))


@pytest.fixture(scope="module")
def camera() -> Camera:
    return frame(SQUARE, 0.0, SIZE[0] / SIZE[1])


def test_a_square_covers_as_many_pixels_as_it_should(camera: Camera) -> None:
    image = raster_numpy.draw([square((1, 0, 0))], camera, SIZE)
    side = 0.2 / camera.pixel_size(SIZE[1])
    assert (image[..., 3] > 0).sum() == pytest.approx(side**2, rel=0.03)
    assert set(np.unique(image[..., 3])) == {0, 255}
    np.testing.assert_allclose(image[..., 0], image[..., 3])


def test_the_nearer_one_is_seen_in_whatever_order(camera: Camera) -> None:
    near, far = square((1, 0, 0), 0.01), square((0, 1, 0))
    middle = SIZE[1] // 2, SIZE[0] // 2
    for order in ([near, far], [far, near]):
        image = raster_numpy.draw(order, camera, SIZE)
        assert image[middle].tolist() == [255, 0, 0, 255]


def test_back_sides_are_not_seen(camera: Camera) -> None:
    turned = replace(square((1, 0, 0)), triangles=TWO[:, ::-1])
    assert raster_numpy.draw([turned], camera, SIZE).max() == 0


def test_colours_are_linear_across_a_face_seen_straight_on(camera: Camera) -> None:
    solid = replace(square((0, 0, 0)), colors=np.column_stack([CORNERS, np.zeros(4)]))
    image = raster_numpy.draw([solid], camera, SIZE)
    row = image[50][image[50, :, 3] > 0][:, 0]
    assert np.ptp(np.diff(row.astype(int))) <= 1
    assert 0 < row[0] < 4
    assert 251 < row[-1] < 255


def test_interpolation_is_right_in_perspective() -> None:
    """The middle of a receding square is beyond the middle of its picture."""
    camera = frame(SQUARE, 60.0)
    solid = replace(square((0, 0, 0)), colors=np.column_stack([CORNERS, np.zeros(4)]))
    image = raster_numpy.draw([solid], camera, (800, 1000))
    at = np.array([0.03, 0.0, 0.0])
    (x, y), _ = camera.project(at, (800, 1000))
    expected = (at[0] + 0.1) / 0.2
    assert image[int(y), int(x), 0] / 255 == pytest.approx(expected, abs=0.01)


def test_a_texture_lies_upright_and_unmirrored(camera: Camera) -> None:
    texture = np.zeros((2, 2, 3), np.uint8)
    texture[0, 0], texture[0, 1], texture[1, 0] = (255, 0, 0), (0, 255, 0), (0, 0, 255)
    solid = replace(square((1, 1, 1)), texcoords=CORNERS, texture=texture)
    rasterisers = [raster_numpy.draw]
    if raster_vtk.available():
        rasterisers.append(raster_vtk.Canvas().draw)
    for draw in rasterisers:
        image = draw([solid], camera, SIZE)
        inside = np.argwhere(image[..., 3] == 255)
        (top, left), (bottom, right) = inside.min(axis=0), inside.max(axis=0)
        assert image[top + 3, left + 3, :3].argmax() == 0
        assert image[top + 3, right - 3, :3].argmax() == 1
        assert image[bottom - 3, left + 3, :3].argmax() == 2


def test_something_partly_outside_the_picture_is_drawn(camera: Camera) -> None:
    solid = replace(square((1, 0, 0)), vertices=SQUARE * 3.0)
    image = raster_numpy.draw([solid], camera, SIZE)
    assert image[..., 3].min() == 255


def test_nothing_to_draw_is_an_empty_picture(camera: Camera) -> None:
    assert raster_numpy.draw([], camera, SIZE).max() == 0


@needs_opengl
@pytest.mark.parametrize("style", STYLES)
def test_both_rasterisers_draw_the_same(painted: Face, style: str) -> None:
    camera = frame(painted.mesh().vertices, 25.0)
    solids = STYLES[style](painted, camera, Options(mesh=(40, 50)))
    # One takes a sample a pixel, the other several: at 240 x 300 both are well smoothed.
    plain = shrunk(raster_numpy.draw(solids, camera, (960, 1200)), 4)
    vtk = shrunk(raster_vtk.Canvas().draw(solids, camera, (480, 600)), 2)
    # Thin lines still differ a little; surfaces do not.
    assert np.abs(plain - vtk).mean() < 0.012
    assert np.median(np.abs(plain - vtk)) < 0.002


def shrunk(image: np.ndarray, factor: int) -> np.ndarray:
    height, width = image.shape[0] // factor, image.shape[1] // factor
    return image.reshape(height, factor, width, factor, 4).mean(axis=(1, 3)) / 255.0


@needs_opengl
def test_a_canvas_draws_one_picture_after_another(painted: Face) -> None:
    canvas = raster_vtk.Canvas()
    cameras = [frame(painted.mesh().vertices, view) for view in (0.0, 40.0, 0.0)]
    options = Options(mesh=(30, 30))
    pictures = [
        canvas.draw(STYLES["textured"](painted, c, options), c, (160, 200)) for c in cameras
    ]
    np.testing.assert_array_equal(pictures[0], pictures[2])
    assert np.abs(pictures[0].astype(int) - pictures[1]).mean() > 2.0
