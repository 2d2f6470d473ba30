"""The mesh warp does what it says: identities, closed forms, and where the nodes go."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray

from pdeface.texture import _meshes, warp

DTYPES = ("uint8", "uint16", "float32", "float64")


def random_image(shape: tuple[int, ...], dtype: str = "uint8", seed: int = 0) -> NDArray:
    values = np.random.default_rng(seed).random(shape)
    scale = np.iinfo(dtype).max if dtype.startswith("u") else 1.0
    return (values * scale).astype(dtype)


def bent_mesh(height: float, width: float, nodes: tuple[int, int], seed: int) -> NDArray:
    """A mesh over a frame whose inner nodes are moved by up to a quarter of their distance."""
    rows, columns = nodes
    x, y = np.meshgrid(np.linspace(0, width, columns), np.linspace(0, height, rows))
    mesh = np.stack([x, y], axis=-1)
    move = np.random.default_rng(seed).uniform(-0.25, 0.25, (rows, columns, 2))
    mesh[1:-1, 1:-1] += (move * (width / (columns - 1), height / (rows - 1)))[1:-1, 1:-1]
    return mesh


@pytest.mark.parametrize("dtype", DTYPES)
@pytest.mark.parametrize("shape", [(40, 33), (40, 33, 1), (31, 48, 2), (20, 20, 3), (9, 30, 4)])
def test_identity_returns_the_image_to_the_last_bit(dtype, shape, engine):
    image = random_image(shape, dtype)
    mesh = bent_mesh(*shape[:2], (7, 6), seed=1)
    result = warp(image, mesh, mesh, engine=engine)
    assert result.dtype == image.dtype
    np.testing.assert_array_equal(result, image)


@given(
    value=st.floats(-1e6, 1e6, width=32),
    seed=st.integers(0, 2**32 - 1),
    height=st.integers(1, 40),
    width=st.integers(1, 40),
    dtype=st.sampled_from(["float32", "float64"]),
)
@pytest.mark.parametrize("name", ["numpy", "numba"])
def test_a_constant_stays_constant(name, value, seed, height, width, dtype):
    image = np.full((17, 23, 2), value, dtype)
    source, target = bent_mesh(17, 23, (5, 4), seed), bent_mesh(height, width, (5, 4), seed + 1)
    result = warp(image, source, target, (height, width), engine=name)
    np.testing.assert_array_equal(result, np.full((height, width, 2), value, dtype))


def test_shrinking_by_a_whole_factor_takes_means(engine, frame):
    image = random_image((24, 36, 3), "float64")
    result = warp(image, frame(24, 36), frame(8, 9), (8, 9), engine=engine)
    means = image.reshape(8, 3, 9, 4, 3).mean(axis=(1, 3))
    np.testing.assert_allclose(result, means, rtol=0, atol=1e-14)


def test_a_fine_checkerboard_shrinks_to_grey(engine, frame):
    image = np.zeros((64, 64), np.uint8)
    image[::2, ::2] = image[1::2, 1::2] = 255
    result = warp(image, frame(64, 64), frame(8, 8), (8, 8), engine=engine)
    assert set(np.unique(result)) <= {127, 128}


@given(height=st.integers(1, 90), width=st.integers(1, 90), seed=st.integers(0, 1000))
def test_scaling_keeps_the_mean_brightness(height, width, seed):
    image = random_image((30, 26), "float64", seed)
    corners = [
        np.stack(np.meshgrid([0.0, w], [0.0, h]), -1) for h, w in ((30, 26), (height, width))
    ]
    result = warp(image, *corners, (height, width), engine="numpy")
    assert result.mean() == pytest.approx(image.mean(), abs=1e-12)


@pytest.mark.parametrize("axis", [0, 1])
def test_a_stretched_ramp_is_a_ramp(axis, engine, frame):
    """The curve through a straight ramp is straight, so its means are known exactly."""
    image = np.broadcast_to(np.arange(20.0) + 0.5, (20, 20))
    image = image if axis == 1 else image.T
    shape = (20, 70) if axis == 1 else (70, 20)
    result = warp(image, frame(20, 20), frame(*shape), shape, engine=engine)
    expected = (np.arange(70) + 0.5) * (20 / 70)
    line = np.moveaxis(result, axis, 0)
    inner = (expected > 1.5) & (expected < 18.5)  # the first and last pixel are repeated beyond
    np.testing.assert_allclose(line[inner], np.tile(expected[inner, None], 20), atol=1e-12)
    assert (np.diff(line[inner], axis=0) >= 0).all()


def test_magnifying_makes_no_blocks(engine, frame):
    """A single bright pixel becomes one smooth hill."""
    image = np.zeros((5, 9))
    image[:, 4] = 1.0
    line = warp(image, frame(5, 9), frame(5, 900), (5, 900), engine=engine)[2]
    assert np.abs(np.diff(line)).max() < 0.04
    assert line.argmax() in range(445, 455)
    assert line.mean() == pytest.approx(1 / 9)


@given(dx=st.integers(-6, 6), dy=st.integers(-6, 6))
@pytest.mark.parametrize("name", ["numpy", "numba"])
def test_a_whole_shift_moves_pixels_unchanged(name, dx, dy):
    image = random_image((30, 30, 3))
    mesh = bent_mesh(30, 30, (4, 4), seed=3)
    result = warp(image, mesh, mesh + (dx, dy), engine=name)
    expected = np.pad(image, ((6, 6), (6, 6), (0, 0)), mode="edge")
    np.testing.assert_array_equal(result, expected[6 - dy : 36 - dy, 6 - dx : 36 - dx])


def test_nodes_go_where_they_are_sent(engine):
    source, target = bent_mesh(140, 160, (5, 6), seed=4), bent_mesh(180, 120, (5, 6), seed=5)
    for row in range(1, 4):
        for column in range(1, 5):
            x0, y0 = source[row, column]
            y, x = np.mgrid[0:140, 0:160] + 0.5
            blob = np.exp(-((x - x0) ** 2 + (y - y0) ** 2) / 8.0)
            moved = warp(blob, source, target, (180, 120), engine=engine)
            y, x = np.mgrid[0:180, 0:120] + 0.5
            peak = moved > 0.8 * moved.max()
            centre = (x[peak] @ moved[peak], y[peak] @ moved[peak]) / moved[peak].sum()
            np.testing.assert_allclose(centre, target[row, column], atol=0.5)


def waves(x: NDArray, y: NDArray) -> NDArray:
    return np.sin(0.11 * x + 0.3) * np.cos(0.07 * y) + 0.5 * np.sin(0.05 * x - 0.08 * y)


@pytest.mark.parametrize("angle", [-40.0, 0.0, 15.0])
def test_an_affine_warp_of_a_smooth_image_is_that_image(angle, engine, frame):
    """Against the closed form: the image is a function, so its turned copy is one as well."""
    cos, sin = np.cos(np.radians(angle)), np.sin(np.radians(angle))
    turn = 0.9 * np.array([[cos, -sin], [sin, cos]])
    y, x = np.mgrid[0:200, 0:200] + 0.5
    image = waves(x, y)
    target = frame(120, 120)
    source = (target - 60.0) @ turn.T + 100.0
    result = warp(image, source, target, (120, 120), engine=engine)
    y, x = np.mgrid[0:120, 0:120] + 0.5
    places = (np.stack([x, y], axis=-1) - 60.0) @ turn.T + 100.0
    np.testing.assert_allclose(result, waves(*places.transpose(2, 0, 1)), atol=2e-3)


def test_a_bent_warp_reads_the_image_where_the_warped_coordinates_say(engine):
    """An image of coordinates shows the map; any smooth image must follow the same map."""
    source, target = bent_mesh(150, 150, (6, 6), seed=6), bent_mesh(150, 150, (6, 6), seed=7)
    y, x = np.mgrid[0:150, 0:150] + 0.5
    places = warp(np.stack([x, y], axis=-1), source, target, engine=engine)
    result = warp(waves(x, y), source, target, engine=engine)
    inner = np.s_[3:-3, 3:-3]
    expected = waves(*places.transpose(2, 0, 1))
    np.testing.assert_allclose(result[inner], expected[inner], atol=5e-3)


def test_pixels_the_meshes_do_not_need_change_nothing(engine):
    """Only the part of the image under the mesh is worked on; that must not show."""
    image = random_image((60, 70, 3))
    source = bent_mesh(20, 24, (4, 4), seed=8) + (22, 19)
    target = bent_mesh(40, 40, (4, 4), seed=9)
    small = warp(image, source, target, (40, 40), engine=engine)
    large = np.full((600, 700, 3), 77, np.uint8)
    large[300:360, 200:270] = image
    np.testing.assert_array_equal(
        warp(large, source + (200, 300), target, (40, 40), engine=engine), small
    )


def test_beyond_the_image_its_border_is_repeated(engine, frame):
    image = random_image((10, 12, 3))
    result = warp(image, frame(30, 32) - 10.0, frame(30, 32), (30, 32), engine=engine)
    np.testing.assert_array_equal(result, np.pad(image, ((10, 10), (10, 10), (0, 0)), mode="edge"))
    far = warp(image, frame(5, 5) + (900, -900), frame(5, 5), (5, 5), engine=engine)
    np.testing.assert_array_equal(far, np.broadcast_to(image[0, -1], (5, 5, 3)))


@pytest.mark.parametrize("shape", [(1, 1), (1, 7), (6, 1)])
def test_the_smallest_images(shape, engine, frame):
    image = random_image(shape, "float32")
    result = warp(image, frame(*shape), frame(9, 11), (9, 11), engine=engine)
    assert np.isfinite(result).all()
    assert result.mean() == pytest.approx(image.mean(), rel=1e-5)


def test_integers_are_rounded_and_clipped_not_wrapped(engine, frame):
    """Beside an edge the smooth curve overshoots; bytes must not wrap round."""
    image = np.zeros((8, 8), np.uint8)
    image[:, 4:] = 255
    result = warp(image, frame(8, 8), frame(80, 80), (80, 80), engine=engine)
    assert (np.diff(result.astype(int), axis=1)[:, 30:50] >= 0).all()
    assert result[:, :25].max() < 40
    assert result[:, -25:].min() > 215


def test_a_transposed_image_and_mesh_of_one_axis_give_a_transposed_result(engine):
    """Moving points along x only, or along y only, is the same with the axes swapped."""
    image = random_image((40, 40), "float64")
    source, target = bent_mesh(40, 40, (5, 5), seed=10), bent_mesh(40, 40, (5, 5), seed=10)
    target[..., 0] = bent_mesh(40, 40, (5, 5), seed=11)[..., 0]
    result = warp(image, source, target, engine=engine)
    swapped = [mesh.transpose(1, 0, 2)[..., ::-1] for mesh in (source, target)]
    np.testing.assert_allclose(warp(image.T, *swapped, engine=engine).T, result, atol=1e-9)


@given(seed=st.integers(0, 2**32 - 1), height=st.integers(2, 60), width=st.integers(2, 60))
def test_the_engines_agree(seed, height, width):
    pytest.importorskip("numba")
    source, target = bent_mesh(30, 35, (6, 5), seed), bent_mesh(height, width, (6, 5), seed + 1)
    image = random_image((30, 35, 3), "float64", seed)
    ours, other = (
        warp(image, source, target, (height, width), engine=name) for name in ("numba", "numpy")
    )
    np.testing.assert_allclose(ours, other, rtol=0, atol=1e-12)
    image = random_image((30, 35, 3), "uint8", seed)
    ours, other = (
        warp(image, source, target, (height, width), engine=name) for name in ("numba", "numpy")
    )
    # A value half-way between two integers may be rounded either way.
    assert np.abs(ours.astype(int) - other).max() <= 1
    assert (ours != other).mean() < 0.01


def test_the_result_owns_its_pixels(engine, frame):
    image = random_image((6, 6, 3))
    image.setflags(write=False)
    result = warp(image[::-1, ::-1], frame(6, 6), frame(6, 6), engine=engine)
    assert not np.shares_memory(result, image)
    np.testing.assert_array_equal(result, image[::-1, ::-1])


def test_compiled_code_that_cannot_be_kept_is_compiled_all_the_same(monkeypatch):
    """From a folder that cannot be written to, say of a system-wide installation."""
    numba = pytest.importorskip("numba")
    from pdeface.texture import _resample_numba

    njit = numba.njit

    def without_a_place(*args, cache=False, **options):
        if cache:
            raise RuntimeError("cannot cache function: no locator available")
        return njit(*args, **options)

    monkeypatch.setattr(numba, "njit", without_a_place)
    assert _resample_numba._jit(lambda x: x + 1)(2) == 3


def test_lines_may_meet_beyond_their_nodes(engine):
    """Columns that end at different heights and lean would cross if continued: nobody sees it."""
    x, y = np.meshgrid(np.linspace(0, 60, 5), np.linspace(0, 40, 4))
    target, source = np.stack([x, y], axis=-1), np.stack([x, y], axis=-1)
    source[2:, 1] = (11.0, 14.0), (16.0, 18.0)
    source[2:, 2] = (26.0, 30.0), (18.0, 50.0)
    rows = np.arange(0.5, 50)
    continued = _meshes.row_knots(source, target, rows)
    for knots in continued:
        assert (np.diff(knots, axis=1) > 0).all()
    image = random_image((60, 60), "float64")
    result = warp(image, source, target, (40, 60), engine=engine)
    assert image.min() - 0.3 < result.min() < result.max() < image.max() + 0.3
