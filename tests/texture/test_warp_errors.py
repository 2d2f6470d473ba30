"""What the warp refuses, and in which words."""

from __future__ import annotations

import subprocess
import sys

import numpy as np
import pytest

from pdeface.errors import InputError, MissingExtraError
from pdeface.texture import warp

IMAGE = np.zeros((30, 30, 3), np.uint8)
NAMES = [[f"point {row}{column}" for column in range(4)] for row in range(4)]


@pytest.fixture
def mesh():
    x, y = np.meshgrid(np.linspace(0, 30, 4), np.linspace(0, 30, 4))
    return np.stack([x, y], axis=-1)


@pytest.mark.parametrize("kind", ["source", "target"])
@pytest.mark.parametrize("axis", [0, 1])
def test_a_fold_names_its_nodes(mesh, kind, axis):
    folded = mesh.copy()
    folded[1, 2, axis] = folded[1, 1, axis] - 1 if axis == 0 else folded[0, 2, axis] - 1
    pair = (folded, mesh) if kind == "source" else (mesh, folded)
    with pytest.raises(InputError, match=f"{kind} mesh is folded.*point 12") as error:
        warp(IMAGE, *pair, names=NAMES)
    assert ("right of" if axis == 0 else "below") in str(error.value)


def test_nodes_without_names_are_told_by_row_and_column(mesh):
    folded = mesh.copy()
    folded[2, 1] = folded[2, 2] + 1
    with pytest.raises(InputError, match=r"node \(row 2, column [12]\)"):
        warp(IMAGE, folded, mesh)


def test_lines_that_cross_between_their_nodes_are_refused(mesh):
    """Every node is in order, and yet the two curves pass through each other."""
    crossed = mesh.copy()
    crossed[:, 1] = [(2, 0), (18, 10), (18, 14), (2, 30)]
    crossed[:, 2] = [(10, 0), (19, 18), (19, 21), (10, 30)]
    crossed[1:3, 0, 1], crossed[1:3, 3, 1] = (10, 14), (18, 21)
    with pytest.raises(InputError, match=r"columns of the source mesh must not cross.*point"):
        warp(IMAGE, crossed, mesh, names=NAMES)


@pytest.mark.parametrize("bad", [np.nan, np.inf])
def test_a_node_must_be_finite(mesh, bad):
    mesh[3, 0, 1] = bad
    with pytest.raises(InputError, match="finite.*point 30"):
        warp(IMAGE, mesh, mesh, names=NAMES)


@pytest.mark.parametrize("shape", [(4, 4), (1, 4, 2), (4, 4, 3), (0,)])
def test_a_mesh_has_rows_columns_and_two_coordinates(mesh, shape):
    with pytest.raises(InputError, match=r"array of \(rows >= 2, columns >= 2, 2\)"):
        warp(IMAGE, np.zeros(shape), mesh)


def test_meshes_must_pair(mesh):
    with pytest.raises(InputError, match="same number of rows and columns"):
        warp(IMAGE, mesh[:3], mesh)


@pytest.mark.parametrize("shape", [(5,), (5, 5, 5), (5, 5, 3, 1), (0, 5, 3), (5, 5, 0)])
def test_the_shape_of_an_image(mesh, shape):
    with pytest.raises(InputError, match=r"an image must be an array of \(height, width\)"):
        warp(np.zeros(shape, np.uint8), mesh, mesh)


@pytest.mark.parametrize("dtype", ["bool", "int32", "complex64", "float16", "U1"])
def test_the_type_of_an_image(mesh, dtype):
    with pytest.raises(InputError, match="type uint8, uint16, float32 or float64"):
        warp(np.zeros((30, 30), dtype), mesh, mesh)


def test_an_image_must_be_finite(mesh):
    image = np.zeros((30, 30))
    image[3, 4] = np.nan
    with pytest.raises(InputError, match="finite"):
        warp(image, mesh, mesh)


@pytest.mark.parametrize("shape", [(0, 5), (5,), (5, -1), "ab", (5, 5, 5)])
def test_the_shape_of_the_result(mesh, shape):
    with pytest.raises(InputError, match="two positive numbers"):
        warp(IMAGE, mesh, mesh, shape)


def test_an_unknown_engine(mesh):
    with pytest.raises(InputError, match="engine must be 'auto', 'numba' or 'numpy', got 'cuda'"):
        warp(IMAGE, mesh, mesh, engine="cuda")


def test_without_numba_the_warp_works_and_says_what_is_missing(mesh, monkeypatch):
    monkeypatch.setitem(sys.modules, "numba", None)
    monkeypatch.delitem(sys.modules, "pdeface.texture._resample_numba", raising=False)
    large = np.zeros((1500, 1500), np.uint8)
    assert warp(large, mesh, mesh, (1000, 1000)).shape == (1000, 1000)
    with pytest.raises(MissingExtraError, match=r"pdeface\[texture\]"):
        warp(IMAGE, mesh, mesh, engine="numba")


def test_importing_the_room_imports_neither_pillow_nor_numba():
    program = (
        "import sys, pdeface.texture; "
        "print(sorted({'numba', 'PIL', 'scipy', 'cv2'} & set(sys.modules)))"
    )
    result = subprocess.run(
        [sys.executable, "-c", program], capture_output=True, text=True, check=True
    )
    assert result.stdout.strip() == "[]"
