"""A performer gives what the face itself gives, only sooner."""

from __future__ import annotations

import numpy as np
import pytest

from pdeface.controls import ARKIT, CONTROLS
from pdeface.curves import BoundaryCurves
from pdeface.errors import InputError
from pdeface.face import Face, neutral, random
from pdeface.performer import Performer
from pdeface.uvmesh import UVMesh

# Metres. In single precision a ten-thousandth of a millimetre: about seven roundings of a number
# as large as the largest coordinate, of the 52 that are added.
ROUNDING = {np.float32: 1e-7, np.float64: 1e-14}


def frames(count: int) -> np.ndarray:
    """Weights of everything whose effect does not depend on what else a face does."""
    weights = np.random.default_rng(5).random((count, len(ARKIT)))
    weights[:, [ARKIT.index(n) for n in ("eyeBlinkLeft", "eyeBlinkRight", "mouthClose")]] = 0.0
    return weights


def meshed(face: Face, weights: np.ndarray, mesh: UVMesh, join: str = "smooth") -> np.ndarray:
    named = {n: w for n, w in zip(ARKIT, weights.tolist(), strict=True) if n in CONTROLS}
    moved = face.with_weights(named).mesh(mesh.rows, mesh.columns, join=join, openings="none")
    return moved.vertices.reshape(mesh.rows, mesh.columns, 3)


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
@pytest.mark.parametrize("join", ["smooth", "patchwise"])
@pytest.mark.parametrize("mesh", [UVMesh(28, 41), UVMesh(20, 33), UVMesh(109, 61), UVMesh(541, 9)])
@pytest.mark.parametrize("level", ["28x46", "55x92"])
def test_positions_are_those_of_the_face(dtype, join, mesh, level) -> None:
    face = random(3, level).set(noseLength=0.5, jawOpen=0.25)
    weights = frames(4)
    found = Performer(face, mesh, join=join, dtype=dtype).positions(weights)
    assert found.shape == (4, mesh.rows, mesh.columns, 3)
    assert found.dtype == dtype
    expected = np.stack([meshed(face, w, mesh, join) for w in weights])
    np.testing.assert_allclose(found, expected, rtol=0, atol=ROUNDING[dtype])


@pytest.mark.parametrize("mesh", [UVMesh(28, 41), UVMesh(271, 161)])
def test_a_batch_larger_than_what_is_worked_on_together(mesh: UVMesh) -> None:
    performer = Performer(neutral(), mesh)
    weights = frames(301 if mesh.rows == 28 else 23)
    together = performer.positions(weights)
    for place in (0, len(weights) // 2, len(weights) - 1):
        alone = performer.positions(weights[place])
        np.testing.assert_allclose(together[place], alone, rtol=0, atol=ROUNDING[np.float32])


def test_a_batch_may_have_several_axes_or_no_frames() -> None:
    performer = Performer(neutral())
    weights = frames(6)
    found = performer.positions(weights.reshape(2, 3, -1))
    np.testing.assert_array_equal(found.reshape(6, 28, 41, 3), performer.positions(weights))
    assert performer.positions(weights[:0]).shape == (0, 28, 41, 3)


def test_a_mapping_leaves_the_faces_own_expressions() -> None:
    face = neutral().set(mouthSmileLeft=0.75, chinHeight=-0.5)
    found = Performer(face, dtype=np.float64).positions({"eyeWideRight": 1.0, "jawOpen": 0.0})
    expected = (
        face.set(eyeWideRight=1.0, jawOpen=0.0).mesh(openings="none").vertices.reshape(28, 41, 3)
    )
    np.testing.assert_allclose(found, expected, rtol=0, atol=1e-14)
    without = Performer(face, dtype=np.float64).positions({"mouthSmileLeft": 0.0})
    expected = face.set(mouthSmileLeft=0.0).mesh(openings="none").vertices.reshape(28, 41, 3)
    np.testing.assert_allclose(without, expected, rtol=0, atol=1e-14)


def test_results_are_written_over_memory_of_its_own() -> None:
    performer = Performer(neutral())
    out = performer.empty(5)
    assert performer.positions(frames(5), out=out) is out
    np.testing.assert_array_equal(out, performer.positions(frames(5)))
    for wrong in (performer.empty(4), np.empty((5, 28, 41, 3), np.float32), out.astype(float)):
        with pytest.raises(InputError, match="empty"):
            performer.positions(frames(5), out=wrong)


@pytest.mark.parametrize(
    ("weights", "message"),
    [
        (np.zeros(51), "52 numbers"),
        (np.zeros((52, 2)), "52 numbers"),
        (np.full(52, "x"), "52 numbers"),
        (np.full(52, 1.5), "1.5; clip"),
        (np.full(52, -0.1), "-0.1"),
        (np.full(52, np.nan), "nan"),
        ({"jawOpne": 0.5}, "did you mean jawOpen"),
        ({"jawOpen": 2.0}, "jawOpen"),
        ({"noseLength": 0.5}, "on the face"),
    ],
)
def test_weights_that_no_face_has(weights: object, message: str) -> None:
    with pytest.raises(InputError, match=message) as error:
        Performer(neutral()).positions(weights)
    assert "\n" not in str(error.value)


def test_a_face_without_lids_cannot_perform() -> None:
    points = np.random.default_rng(0).normal(size=(10, 8, 3))
    with pytest.raises(InputError, match="27 n"):
        Performer(Face(BoundaryCurves(points)))


def test_alone_a_blink_is_the_faces_own() -> None:
    found = Performer(random(2), dtype=np.float64).positions({"eyeBlinkLeft": 1.0})
    expected = random(2).set(eyeBlinkLeft=1.0).mesh(openings="none").vertices
    np.testing.assert_allclose(found.reshape(-1, 3), expected, rtol=0, atol=1e-14)


def test_a_cut_mesh_is_refused() -> None:
    with pytest.raises(InputError, match="leave openings out"):
        Performer(neutral(), neutral().uv_mesh())
