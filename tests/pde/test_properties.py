"""What holds for every set of curves."""

from __future__ import annotations

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from pdeface.curves import curve_parameters
from pdeface.pde import GridEvaluator, PDESurface

COORDINATES = st.floats(-100.0, 100.0, allow_subnormal=False)


@st.composite
def surfaces(draw, faces=1):
    """Points of so many faces of one size, and the options of a surface through them."""
    join = draw(st.sampled_from(["smooth", "patchwise"]))
    count = draw(st.integers(2, 9)) if join == "smooth" else 3 * draw(st.integers(1, 3)) + 1
    continuity = {}
    if join == "smooth" and count > 2:
        kinds = st.sampled_from(["C2", "crease", "slit"])
        continuity = draw(st.dictionaries(st.integers(1, count - 2), kinds, max_size=3))
    shape = (faces, count, draw(st.integers(3, 9)), 3)
    options = {
        "a": draw(st.floats(1.0, 20.0)),
        "modes": draw(st.integers(0, 6)),
        "join": join,
        "continuity": continuity,
    }
    return draw(arrays(np.float64, shape, elements=COORDINATES)), options


SOMEWHERE = st.tuples(st.floats(0.0, 1.0), st.floats(-10.0, 10.0))


def tolerance(points, options):
    """1e-12 of the size, times how far such a patch overshoots: e^{w / 3} with w = a n / p."""
    size = np.abs(points).max() + 1e-9
    if options["join"] == "smooth":
        return 1e-12 * size
    fastest = options["a"] * min(points.shape[-2] // 2, options["modes"] + 1)
    return 1e-12 * size * np.exp(fastest / (points.shape[-3] - 1))


@given(surfaces())
def test_passes_through_every_data_point(drawn):
    (points,), options = drawn
    u = np.linspace(0.0, 1.0, len(points))[:, None]
    for side in ("before", "after"):
        met = PDESurface(points, **options)(u, curve_parameters(points.shape[1]), side=side)
        np.testing.assert_allclose(met, points, atol=1e-12 * (np.abs(points).max() + 1e-9))


@given(surfaces(faces=2), st.floats(-3.0, 3.0), SOMEWHERE)
def test_linear_in_the_points(drawn, factor, where):
    (first, second), options = drawn
    u, v = where
    sum_ = PDESurface(first + factor * second, **options)(u, v)
    parts = PDESurface(first, **options)(u, v) + factor * PDESurface(second, **options)(u, v)
    np.testing.assert_allclose(
        sum_, parts, atol=10.0 * tolerance(np.stack([first, second]), options)
    )


@given(surfaces(), arrays(np.float64, (3, 3), elements=st.floats(-2.0, 2.0)), SOMEWHERE)
def test_commutes_with_affine_maps(drawn, matrix, where):
    """The surface of a moved face is the moved surface: no coordinate system is special."""
    (points,), options = drawn
    moved = PDESurface(points @ matrix + matrix[0], **options)(*where)
    expected = PDESurface(points, **options)(*where) @ matrix + matrix[0]
    np.testing.assert_allclose(moved, expected, atol=20.0 * tolerance(points, options) + 1e-12)


@given(surfaces(), SOMEWHERE)
def test_turned_upside_down_it_is_the_same_surface(drawn, where):
    """u -> 1 - u and v -> -v reverse curves and points; a slit k becomes the slit K - 2 - k."""
    (points,), options = drawn
    turned = dict(options)
    turned["continuity"] = {
        len(points) - 1 - curve - (kind == "slit"): kind
        # A slit comes last: it also ends a spline at the next curve, where a crease adds nothing.
        for kind in ("crease", "slit")
        for curve, own in options["continuity"].items()
        if own == kind
    }
    if any(not 1 <= curve <= len(points) - 2 for curve in turned["continuity"]):
        return
    u, v = where
    there = PDESurface(points, **options)(u, v)
    back = PDESurface(points[::-1, ::-1], **turned)(1.0 - u, -v)
    np.testing.assert_allclose(back, there, atol=100.0 * tolerance(points, options))


@given(surfaces(), st.lists(st.floats(0.0, 1.0), min_size=1, max_size=5), st.booleans())
def test_the_evaluator_agrees_with_the_surface(drawn, u, single):
    (points,), options = drawn
    v = np.linspace(0.0, np.pi, 5)
    dtype = np.float32 if single else np.float64
    ours = GridEvaluator(points.shape[:2], u, v, dtype=dtype, **options).positions(points)
    expected = PDESurface(points, **options)(np.array(u)[:, None], v)
    loss = np.finfo(dtype).eps / np.finfo(np.float64).eps
    np.testing.assert_allclose(ours, expected, atol=loss * tolerance(points, options))


@given(surfaces(), SOMEWHERE)
def test_normals_are_of_unit_length_and_square_to_the_surface(drawn, where):
    (points,), options = drawn
    made = PDESurface(points, **options)
    normal = made.normal(*where)
    s_u, s_v = made.derivative(*where, 1, 0), made.derivative(*where, 0, 1)
    area = np.linalg.norm(np.cross(s_u, s_v))
    if area > 1e-6 * np.linalg.norm(s_u) * np.linalg.norm(s_v) > 0.0:
        assert abs(np.linalg.norm(normal) - 1.0) < 1e-12
        assert abs(normal @ s_u) < 1e-9 * np.linalg.norm(s_u)
        assert abs(normal @ s_v) < 1e-9 * np.linalg.norm(s_v)
