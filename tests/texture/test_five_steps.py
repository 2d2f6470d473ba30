"""The five steps: features land where the face has them, and nothing else shows on it."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from pdeface import template
from pdeface.errors import InputError
from pdeface.texture import POINT_NAMES, FeaturePoints, portrait, uv_texture
from pdeface.texture._lattice import photo_lattice

SKIN, GREEN = (200, 150, 120), (0, 255, 0)


@pytest.fixture
def photo() -> NDArray[np.uint8]:
    """Smooth colours, different everywhere."""
    y, x = np.mgrid[0:200, 0:160]
    waves = [np.sin(0.05 * x), np.cos(0.04 * y), np.sin(0.03 * (x + y))]
    return (127 + 100 * np.stack(waves, axis=-1)).astype(np.uint8)


def turned(photo: NDArray, points: FeaturePoints, quarters: int) -> tuple[NDArray, FeaturePoints]:
    for _ in range(quarters):
        width = photo.shape[1]
        photo = np.rot90(photo)
        points = points.moved(
            lambda p, width=width: np.stack([p[:, 1], width - p[:, 0]], axis=-1),
            (photo.shape[1], photo.shape[0]),
        )
    return photo, points


def dots(points: NDArray, shape: tuple[int, int]) -> NDArray[np.uint8]:
    """A small soft white dot on every point."""
    y, x = np.mgrid[0 : shape[0], 0 : shape[1]] + 0.5
    image = np.zeros(shape)
    for px, py in points.reshape(-1, 2):
        image = np.maximum(image, np.exp(-((x - px) ** 2 + (y - py) ** 2) / 5.0))
    return (255 * image).astype(np.uint8)


@pytest.mark.parametrize("follow_face", [True, False])
@pytest.mark.parametrize("tilt", [0.0, 4.0, -20.0])
def test_every_feature_lands_where_the_face_has_it(face_points, follow_face, tilt):
    cos, sin = np.cos(np.radians(tilt)), np.sin(np.radians(tilt))
    turn = np.array([[cos, -sin], [sin, cos]])
    points = face_points.moved(lambda p: 3.0 * (p - (80, 100)) @ turn.T + 420, (840, 840))
    image = dots(points.array, (840, 840))
    result = uv_texture(
        image, points, (400, 400), finish=False, margins=False, follow_face=follow_face
    )
    texture = result.image[..., 0].astype(float)
    for x, y in result.target_mesh[1:-1, 1:-1].reshape(-1, 2):
        left, top = max(int(x) - 12, 0), max(int(y) - 12, 0)
        part = texture[top : top + 25, left : left + 25]
        row, column = np.unravel_index(part.argmax(), part.shape)
        assert part.max() > 150
        assert abs(left + column + 0.5 - x) <= 3
        assert abs(top + row + 0.5 - y) <= 3


@pytest.mark.parametrize("follow_face", [True, False])
def test_the_first_step_puts_the_grid_on_eyes_and_mouth(face_points, photo, follow_face):
    steps = uv_texture(photo, face_points, (64, 64), follow_face=follow_face)
    placed = steps.grid(steps.targets[..., 0], steps.targets[..., 1])
    np.testing.assert_allclose(placed[1, [1, 3]], face_points.array[1, [1, 3]], atol=1e-9)
    mouth = placed[3, [1, 3]].mean(axis=0)
    assert mouth[1] == pytest.approx(face_points.array[3, [1, 3], 1].mean())


def test_the_paper_s_grid_is_straight(face_points, photo):
    nodes = uv_texture(photo, face_points, (64, 64), follow_face=False).grid.nodes()
    assert nodes.shape == (28, 41, 2)
    np.testing.assert_allclose(np.diff(nodes, 2, axis=0), 0.0, atol=1e-9)
    np.testing.assert_allclose(np.diff(nodes, 2, axis=1), 0.0, atol=1e-9)


def test_the_meshes_are_seven_by_seven_around_the_points(face_points, photo, targets):
    steps = uv_texture(photo, face_points, (90, 120), targets, follow_face=False)
    np.testing.assert_allclose(steps.source_mesh[1:-1, 1:-1], face_points.array, atol=1e-9)
    placed = steps.grid(steps.targets[..., 0], steps.targets[..., 1])
    np.testing.assert_allclose(steps.grid_mesh[1:-1, 1:-1], placed, atol=1e-9)
    mesh = steps.target_mesh
    assert mesh.shape == (7, 7, 2)
    for border, value in (
        (mesh[:, 0, 0], 0), (mesh[:, -1, 0], 120), (mesh[0, :, 1], 0), (mesh[-1, :, 1], 90)
    ):  # fmt: skip
        np.testing.assert_allclose(border, value)
    u, v = targets["right_nostril"]
    np.testing.assert_allclose(mesh[3, 2], (v / np.pi * 120, u * 90))
    np.testing.assert_allclose(steps.uv_nodes()[-1, -1], (120, 90))


def test_with_a_straight_grid_the_texture_is_what_the_paper_reads_off(face_points, photo):
    """One resampling or, as in the paper, two: the same picture, but for a little blur."""
    steps = uv_texture(
        photo, face_points, (270, 400), finish=False, margins=False, follow_face=False
    )
    read = steps.target_image()
    for row in range(3, 24):
        for column in range(12, 29):
            x, y = steps.grid.nodes()[row, column]
            texel = steps.image[row * 10, column * 10] if row else steps.image[0, column * 10]
            assert np.abs(read[int(y), int(x)].astype(int) - texel).max() <= 12


@pytest.mark.parametrize("quarters", [1, 2, 3])
def test_a_photo_on_its_side_gives_the_same_texture(face_points, photo, quarters):
    upright = uv_texture(photo, face_points, (80, 80)).image
    other = uv_texture(*turned(photo, face_points, quarters), (80, 80)).image
    np.testing.assert_array_equal(other, upright)


def test_a_larger_photo_gives_the_same_texture(face_points, photo):
    upright = uv_texture(photo, face_points, (80, 80)).image
    large = photo.repeat(2, axis=0).repeat(2, axis=1)
    other = uv_texture(large, face_points, (80, 80)).image
    assert np.abs(other.astype(int) - upright).mean() < 1.0


def test_grey_stays_grey_and_opaque_alpha_changes_nothing(face_points, photo):
    grey = uv_texture(photo[..., 0], face_points, (80, 80)).image
    assert grey.shape == (80, 80, 3)
    np.testing.assert_array_equal(grey[..., 0], grey[..., 2])
    rgb = uv_texture(photo, face_points, (80, 80)).image
    rgba = np.dstack([photo, np.full((200, 160), 255, np.uint8)])
    result = uv_texture(rgba, face_points, (80, 80)).image
    assert np.abs(result.astype(int) - rgb).max() <= 1


def oval(inner: tuple[int, ...], outer: tuple[int, ...]) -> NDArray[np.uint8]:
    """A face-sized oval, a little larger than the outline of the points, on a background."""
    y, x = np.mgrid[0:200, 0:160] + 0.5
    face = (np.abs((x - 80) / 50) ** 2.5 + np.abs((y - 80) / 80) ** 2.5) < 1.0
    return np.where(face[..., None], np.array(inner, np.uint8), np.array(outer, np.uint8))


def test_background_does_not_reach_the_face(face_points):
    texture = uv_texture(oval(SKIN, GREEN), face_points, (200, 200), margins=False).image
    np.testing.assert_allclose(texture, np.broadcast_to(SKIN, texture.shape), atol=3)
    plain = uv_texture(
        oval(SKIN, GREEN), face_points, (200, 200), finish=False, margins=False
    ).image
    assert (plain[:, :10] == GREEN).all(axis=-1).any()


def test_hair_beside_the_forehead_stays_and_below_it_gives_way_to_skin(face_points):
    hair = (60, 40, 20)
    image = oval(SKIN, GREEN)
    image[20:110][(image[20:110] == GREEN).all(axis=-1)] = hair
    image[:, :6] = image[:, -6:] = GREEN
    texture = uv_texture(image, face_points, (200, 200)).image
    for column in (3, 196):
        np.testing.assert_allclose(texture[4, column], hair, atol=10)
        np.testing.assert_allclose(texture[150, column], SKIN, atol=25)
    assert (texture[..., 1] < texture[..., 0]).all()  # nothing green


def test_transparent_pixels_do_not_bleed(face_points):
    image = oval((*SKIN, 255), (*GREEN, 0))
    for finish in (True, False):
        texture = uv_texture(image, face_points, (200, 200), finish=finish, margins=False).image
        np.testing.assert_allclose(texture, np.broadcast_to(SKIN, texture.shape), atol=3)


def test_a_tightly_cut_photo_still_covers_the_face(face_points, photo):
    """Nothing above the brows, nothing beside the cheeks: the texture has no hole."""
    low = np.floor(face_points.array.min(axis=(0, 1))).astype(int)
    high = np.ceil(face_points.array.max(axis=(0, 1))).astype(int)
    part = photo[low[1] : high[1], low[0] : high[0]]
    points = face_points.moved(lambda p: p - low, (part.shape[1], part.shape[0]))
    texture = uv_texture(part, points, (120, 120), margins=False).image
    assert texture.shape == (120, 120, 3)
    # Smooth resampling may overshoot a little beside the cut.
    assert (texture.max(axis=(0, 1)) <= part.max(axis=(0, 1)) + 8.0).all()
    assert (texture.min(axis=(0, 1)) >= part.min(axis=(0, 1)) - 8.0).all()


def test_the_finish_leaves_the_face_itself_alone(face_points, photo):
    steps = uv_texture(photo, face_points, (200, 200), margins=False)
    columns = slice(90, 110)
    np.testing.assert_array_equal(steps.image[:150, columns], steps.warped[:150, columns])
    assert (steps.image[:, 0] != steps.warped[:, 0]).any()


def test_teeth_are_left_out_of_the_lips(face_points):
    points = FeaturePoints(
        {**face_points.positions, "upper_lip": (80, 117), "lower_lip": (80, 126)}, (160, 200)
    )
    image = np.zeros((200, 160, 3), np.uint8)
    image[117:126] = 255
    open_mouth = uv_texture(image, points, (540, 540), finish=False, margins=False).image[:, 270, 0]
    closed = uv_texture(image, face_points, (540, 540), finish=False, margins=False).image[
        :, 270, 0
    ]
    seam = round(540 * template.row_u("mouth_seam_upper")), 540 * 19 // 27
    bright = np.flatnonzero(open_mouth > 128)
    assert seam[0] - 4 <= bright.min() < bright.max() <= seam[1] + 4
    assert (closed > 128).sum() > (open_mouth > 128).sum() + 5
    far = np.r_[0:250, 490:540]
    np.testing.assert_array_equal(open_mouth[far], closed[far])


def test_the_lattice_passes_through_the_points_and_does_not_fold():
    photo, points = portrait()
    steps = uv_texture(photo, points, (64, 64))
    level_source = steps.points.upright()
    from pdeface.texture import _grid

    source, target = _grid.warp_meshes(points, steps.targets, steps.grid)
    np.testing.assert_allclose(source[1:-1, 1:-1], level_source)
    places, uv = photo_lattice(source, target, steps.targets, steps.grid, points.opening())
    du, dv = np.diff(places, axis=0)[:, :-1], np.diff(places, axis=1)[:-1]
    area = dv[..., 0] * du[..., 1] - dv[..., 1] * du[..., 0]
    assert (area > 0).all()
    middle = uv.shape[1] // 2
    lips = [np.isclose(uv[:, middle, 0], template.row_u(f"mouth_seam_{side}")).argmax()
            for side in ("upper", "lower")]  # fmt: skip
    for row, name in zip(lips, ("upper_lip", "lower_lip"), strict=True):
        np.testing.assert_allclose(places[row, middle], points.positions[name], atol=1.0)


def test_the_size_follows_the_photo_within_limits(face_points, photo):
    assert uv_texture(photo, face_points).image.shape == (512, 512, 3)
    large = photo.repeat(6, axis=0).repeat(6, axis=1)
    steps = uv_texture(large, face_points)
    assert min(steps.image.shape[:2]) > 512
    assert max(steps.image.shape[:2]) < 4096
    # No step between features is sampled by fewer texels than the photo has pixels.
    across = np.diff(steps.target_mesh[1:-1, 1:-1, 0], axis=1)
    pixels = np.linalg.norm(np.diff(steps.points.array, axis=1), axis=-1)
    assert (across >= pixels - 1e-6).all()


def test_a_photo_as_large_as_a_phone_s(face_points):
    photo = np.full((4096, 3277, 3), SKIN, np.uint8)
    texture = uv_texture(photo, face_points, margins=False).image
    assert max(texture.shape) > 3000
    assert (texture == SKIN).all()


@pytest.mark.parametrize("size", [(1, 10), (10,), (8193, 10), "ab", 512, (0, 0)])
def test_a_size_that_cannot_be(face_points, photo, size):
    with pytest.raises(InputError, match="size must be"):
        uv_texture(photo, face_points, size)


@pytest.mark.parametrize("bad", [np.zeros((5, 5)), np.zeros((5, 5, 2), np.uint8), None, "x"])
def test_what_is_no_photo(face_points, bad):
    with pytest.raises(InputError, match="a photo must be an array of uint8"):
        uv_texture(bad, face_points)


def test_points_that_cannot_be_used_are_named(face_points, photo):
    outside = FeaturePoints({**face_points.positions, "nose_tip": (80, 201)}, (160, 200))
    with pytest.raises(InputError, match="nose_tip"):
        uv_texture(photo, outside)
    crossing = FeaturePoints({**face_points.positions, "nose_tip": (95, 97)}, (160, 200))
    with pytest.raises(InputError, match="left_nostril.*nose_tip"):
        uv_texture(photo, crossing)
    with pytest.raises(InputError, match="another shape"):
        uv_texture(photo[:100], face_points)


def test_points_in_order_but_impossible_are_named_too(face_points, photo):
    """In order along every line, and yet no smooth map goes through them."""
    wild = {"right_nostril": (79, 117), "right_mouth_corner": (45, 118.5)}
    points = FeaturePoints({**face_points.positions, **wild}, (160, 200))
    points.validate(photo.shape)
    with pytest.raises(InputError, match="nostril|mouth"):
        uv_texture(photo, points)


def test_targets_must_be_on_the_face_and_in_order(face_points, photo, targets):
    for change in ({"nose_tip": (0.5, 3.5)}, {"nose_tip": (0.2, 1.6)}, {"chin_1": (0.9, 1.2)}):
        with pytest.raises(InputError, match="targets must lie inside"):
            uv_texture(photo, face_points, targets={**targets, **change})
    with pytest.raises(InputError, match="chin_5 is missing"):
        uv_texture(photo, face_points, targets={k: targets[k] for k in list(targets)[:-1]})


def test_the_portrait_and_its_points_belong_together():
    photo, points = portrait()
    assert photo.shape == (256, 256, 3)
    assert points.image_size == (256, 256)
    points.validate(photo.shape)
    grey = photo.mean(axis=2)

    def brightness(name: str) -> float:
        x, y = points.positions[name]
        return float(grey[int(y) - 1 : int(y) + 2, int(x) - 1 : int(x) + 2].mean())

    # Pupils and teeth are where the points say, and the nose is neither.
    assert max(brightness("right_eye_middle"), brightness("left_eye_middle")) < 90
    assert brightness("mouth_centre") > 190
    assert 130 < brightness("nose_tip") < 230
    x = points.array[..., 0]
    eyes = x[1, 3] - x[1, 1]
    # Points 22 to 24 lie below 17 to 19 (Fig. 5).
    np.testing.assert_allclose(x[4, 1:4], x[3, 1:4], atol=0.05 * eyes)


def test_the_names_are_those_of_the_template():
    assert tuple(name for row in POINT_NAMES for name in row) == template.FEATURE_POINTS


def test_a_smile_does_not_squash_the_forehead(face_points, photo):
    """Raised mouth corners change the grid's scale; the nodes above the brows must not follow."""
    smile = {
        name: (x, y - 6 * ("mouth_corner" in name))
        for name, (x, y) in face_points.positions.items()
    }
    heights = []
    for points in (face_points, FeaturePoints(smile, (160, 200))):
        mesh = uv_texture(photo, points, (64, 64)).source_mesh
        heights.append((mesh[1, 3] - mesh[0, 3])[1])
    assert heights[1] == pytest.approx(heights[0], rel=0.1)
