"""Animations: the numbers a file holds, read by hand, and what the Khronos validator says."""

from __future__ import annotations

import json
import struct
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOGeometry import vtkGLTFReader

import pdeface
from pdeface.controls.neck import PIVOT, rotations
from pdeface.errors import InputError
from pdeface.formats import Animation
from pdeface.formats._animation import quaternions

TIMES = [0.5, 1.0, 1.75]
BLINK = {"eyeBlinkLeft": [0.0, 1.0, 0.25]}
YAW = np.array([[0.0, 0.0, 0.0], [0.3, 0.0, 0.0], [0.0, 0.0, 0.0]])
NEUTRAL = pdeface.neutral()


def parsed(path: Path) -> tuple[dict[str, Any], bytes]:
    data = path.read_bytes()
    (length,) = struct.unpack_from("<I", data, 12)
    return json.loads(data[20 : 20 + length]), data[28 + length :]


def channels(path: Path) -> dict[str, tuple[int, np.ndarray, np.ndarray]]:
    """(node, times, values) of each channel of the one animation, by what it moves."""
    document, body = parsed(path)
    (animation,) = document["animations"]

    def values(index: int) -> np.ndarray:
        accessor = document["accessors"][index]
        size = {"SCALAR": 1, "VEC4": 4}[accessor["type"]]
        start = document["bufferViews"][accessor["bufferView"]]["byteOffset"]
        found = np.frombuffer(body, "<f4", size * accessor["count"], start)
        return found if size == 1 else found.reshape(-1, size)

    found = {}
    for channel in animation["channels"]:
        sampler = animation["samplers"][channel["sampler"]]
        assert sampler["interpolation"] == "LINEAR"
        moments, outputs = values(sampler["input"]), values(sampler["output"])
        target = channel["target"]
        found[target["path"]] = (target["node"], moments, outputs.reshape(len(moments), -1))
    return found


def turned(angle: float, axis: int) -> np.ndarray:
    """The rotation about one axis as a matrix."""
    matrix = np.eye(3)
    one, other = (axis + 1) % 3, (axis + 2) % 3
    matrix[one, one] = matrix[other, other] = np.cos(angle)
    matrix[other, one], matrix[one, other] = np.sin(angle), -np.sin(angle)
    return matrix


def rotated(quaternion: np.ndarray) -> np.ndarray:
    """The matrix of a quaternion, by rotating each axis: p + 2 w (q x p) + 2 q x (q x p)."""
    vector, w = quaternion[:3], quaternion[3]
    axes = np.eye(3)
    once = np.cross(vector, axes)
    return (axes + 2.0 * w * once + 2.0 * np.cross(vector, once)).T


@pytest.mark.parametrize("suffix", ["glb", "gltf"])
@pytest.mark.parametrize(
    ("weights", "head", "expressions"),
    [(BLINK, YAW, None), (BLINK, None, ("eyeBlinkLeft",)), ({}, YAW, None), (BLINK, YAW, ())],
    ids=["both", "weights", "head", "no targets"],
)
def test_the_validator_finds_nothing(
    weights, head, expressions, suffix: str, quarters, tmp_path: Path, khronos
) -> None:
    path = tmp_path / f"a.{suffix}"
    face = pdeface.random(2).with_texture(quarters)
    animation = Animation("take", TIMES, weights, head)
    pdeface.export(face, path, expressions=expressions, animation=animation)
    report = khronos(path)
    assert report["issues"]["messages"] == []
    assert report["info"]["animationCount"] == 1


def test_the_validator_on_one_sample_and_on_many(quarters, tmp_path: Path, khronos) -> None:
    for count in (1, 3000):
        times = np.arange(count) / 60.0
        head = np.random.default_rng(count).uniform(-9.0, 9.0, (count, 3))
        animation = Animation("take", times, {"jawOpen": np.full(count, 0.1)}, head)
        face = NEUTRAL.with_texture(quarters)
        pdeface.export(face, tmp_path / "a.glb", expressions=("jawOpen",), animation=animation)
        assert khronos(tmp_path / "a.glb")["issues"]["messages"] == []


def test_weights_are_at_their_times_in_the_order_of_the_targets(tmp_path: Path) -> None:
    names = ("jawOpen", "eyeBlinkLeft", "browInnerUp")
    weights = {**BLINK, "browInnerUp": [0.1, 0.2, 0.3], "tongueOut": [1.0, 1.0, 1.0]}
    face, animation = NEUTRAL.set(jawOpen=0.5), Animation("take", TIMES, weights)
    pdeface.export(face, tmp_path / "a.glb", expressions=names, animation=animation)
    (found,) = channels(tmp_path / "a.glb").items()
    path, (node, times, values) = found
    assert path == "weights"
    np.testing.assert_array_equal(times, TIMES)
    # The jaw, of which the animation says nothing, stays as the face has it.
    truth = [[0.5, 0.0, 0.1], [0.5, 1.0, 0.2], [0.5, 0.25, 0.3]]
    np.testing.assert_allclose(values, truth, atol=1e-7)
    document, _ = parsed(tmp_path / "a.glb")
    assert document["nodes"][node]["mesh"] == 0
    assert document["animations"][0]["name"] == "take"


def test_the_head_turns_to_the_left_about_the_neck(tmp_path: Path) -> None:
    animation = Animation("turn", TIMES, {}, YAW)
    pdeface.export(NEUTRAL, tmp_path / "a.glb", animation=animation)
    document, _ = parsed(tmp_path / "a.glb")
    node, times, values = channels(tmp_path / "a.glb")["rotation"]
    np.testing.assert_array_equal(times, TIMES)
    np.testing.assert_allclose(values[1], [0, np.sin(0.15), 0, np.cos(0.15)], atol=1e-7)
    np.testing.assert_array_equal(values[[0, 2]], [[0, 0, 0, 1]] * 2)
    # +Z, where the face looks, turns to +X, the subject's left.
    np.testing.assert_allclose(rotated(values[1])[:, 2], [np.sin(0.3), 0, np.cos(0.3)], atol=1e-7)
    head = document["nodes"][node]
    assert (head["name"], head["translation"]) == ("head", list(PIVOT))
    assert document["scenes"][0]["nodes"] == [node]
    (child,) = head["children"]
    np.testing.assert_array_equal(np.add(document["nodes"][child]["translation"], PIVOT), 0.0)


def test_vtk_plays_what_is_meant(tmp_path: Path) -> None:
    head = np.outer([0.0, 1.0, 0.0], [0.3, 0.2, 0.1])
    animation = Animation("take", [0.0, 1.0, 2.0], BLINK, head)
    pdeface.export(NEUTRAL, tmp_path / "a.glb", animation=animation)
    reader = vtkGLTFReader()
    reader.SetFileName(str(tmp_path / "a.glb"))
    reader.SetFrameRate(10)
    reader.ApplyDeformationsToGeometryOn()
    reader.UpdateInformation()
    reader.EnableAnimation(0)
    reader.UpdateInformation()
    reader.UpdateTimeStep(1.0)
    blocks = reader.GetOutput().NewIterator()
    blocks.InitTraversal()
    found = vtk_to_numpy(blocks.GetCurrentDataObject().GetPoints().GetData())
    shut = NEUTRAL.set(eyeBlinkLeft=1.0).mesh().vertices
    rotation = turned(0.3, 1) @ turned(0.2, 0) @ turned(0.1, 2)
    truth = (shut - PIVOT) @ rotation.T + PIVOT
    # A micrometre of each displacement may be left out of a target.
    np.testing.assert_allclose(found, truth, rtol=0, atol=1.2e-6)


def test_at_rest_the_face_is_where_it_is_without_animation(tmp_path: Path) -> None:
    import trimesh

    pdeface.export(NEUTRAL, tmp_path / "a.glb", animation=Animation("turn", TIMES, {}, YAW))
    moving = trimesh.load_scene(tmp_path / "a.glb", process=False).to_geometry()
    skin = NEUTRAL.mesh().vertices
    np.testing.assert_allclose(moving.vertices[: len(skin)], skin, atol=1e-7)


@pytest.mark.parametrize("animation", [None, Animation("blink", TIMES, BLINK)], ids=["no", "yes"])
def test_a_file_always_has_a_head_to_turn(animation, tmp_path: Path) -> None:
    pdeface.export(NEUTRAL.with_name("Ada"), tmp_path / "a.glb", animation=animation)
    document, _ = parsed(tmp_path / "a.glb")
    back = [0.0 - coordinate for coordinate in PIVOT]
    assert document["nodes"] == [
        {"name": "Ada", "mesh": 0, "translation": back},
        {"name": "head", "translation": list(PIVOT), "children": [0]},
    ]
    assert document["scenes"] == [{"nodes": [1]}]
    assert ("animations" in document) == (animation is not None)


@given(arrays(np.float64, (5, 3), elements=st.floats(-7, 7)))
def test_quaternions_are_yaw_then_pitch_then_roll_by_the_short_way(angles: np.ndarray) -> None:
    found = quaternions(angles)
    np.testing.assert_allclose(np.linalg.norm(found, axis=1), 1.0, atol=1e-12)
    assert (np.einsum("ij,ij->i", found[1:], found[:-1]) >= 0).all()
    for quaternion, (yaw, pitch, roll) in zip(found, angles, strict=True):
        truth = turned(yaw, 1) @ turned(pitch, 0) @ turned(roll, 2)
        np.testing.assert_allclose(rotated(quaternion), truth, atol=1e-12)


@given(arrays(np.float64, (3,), elements=st.floats(-7, 7)))
def test_matrices_of_a_head_are_yaw_then_pitch_then_roll(angles: np.ndarray) -> None:
    truth = turned(angles[0], 1) @ turned(angles[1], 0) @ turned(angles[2], 2)
    np.testing.assert_allclose(rotations(angles), truth, atol=1e-14)
    np.testing.assert_array_equal(rotations(np.stack([angles] * 2))[1], rotations(angles))


@pytest.mark.parametrize(
    ("times", "weights", "head", "message"),
    [
        ([], {}, None, r"need shape \(samples,\), one or more"),
        ([[0.0]], {}, None, r"got shape \(1, 1\)"),
        ([-1.0, 0.0], {}, None, "from -1"),
        ([0.0, 0.0], {}, None, "must increase"),
        ([1e5, 1e5 + 1e-4], {}, None, "in single precision"),
        ([0.0, np.nan], {}, None, "times of an animation must be finite"),
        (["now"], {}, None, "times of an animation must be an array of numbers"),
        ([0.0], {"jawOpn": [0.0]}, None, "'jawOpn'; did you mean jawOpen"),
        ([0.0], {"jawOpen": [1.5]}, None, "got 1.5 for jawOpen at sample 0"),
        ([0.0], {"jawOpen": [np.nan]}, None, "jawOpen of an animation must be finite"),
        ([0.0], {"jawOpen": [0.0, 1.0]}, None, r"needs shape \(1,\), got \(2,\)"),
        ([0.0], {}, [[0.0, 0.0]], r"head of an animation of 1 samples needs shape \(1, 3\)"),
        ([0.0], {}, [[0.0, 0.0, np.inf]], "head of an animation must be finite"),
    ],
)
def test_what_is_no_animation_is_said(times, weights, head, message: str) -> None:
    with pytest.raises(InputError, match=message):
        Animation("bad", times, weights, head)


@pytest.mark.parametrize("expressions", [(), ("jawOpen",)])
def test_an_animation_of_nothing_is_refused(expressions, tmp_path: Path) -> None:
    path, animation = tmp_path / "a.glb", Animation("take", TIMES, BLINK)
    with pytest.raises(InputError, match="'take' moves nothing that the file has"):
        pdeface.export(NEUTRAL, path, expressions=expressions, animation=animation)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("suffix", ["obj", "ply", "stl", "pdeface"])
def test_formats_that_stand_still_say_so(suffix: str, tmp_path: Path) -> None:
    animation = Animation("take", TIMES, BLINK)
    with pytest.raises(InputError, match=r"an animation can be written to \.glb and \.gltf"):
        pdeface.export(NEUTRAL, tmp_path / f"a.{suffix}", animation=animation)
    assert list(tmp_path.iterdir()) == []
