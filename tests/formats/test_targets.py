"""Expressions as morph targets, as VTK reads them, against surfaces solved anew."""

from __future__ import annotations

import json
import struct
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOGeometry import vtkGLTFReader

import pdeface
from pdeface import controls
from pdeface.controls import ARKIT, CONTROLS
from pdeface.controls.visemes import VISEMES
from pdeface.curves import BoundaryCurves
from pdeface.errors import InputError
from pdeface.face import Face
from pdeface.formats import _targets
from pdeface.formats._gltf_builder import GltfBuilder
from pdeface.formats.gltf import MATT, STILL, UNTURNED

EXPRESSIONS = [c.name for c in CONTROLS.values() if c.kind == "expression"]
SKIN = [name for name in EXPRESSIONS if name != "tongueOut"]

# Of two coordinates below 1/8 m, and of two normals, to single precision.
ROUNDING = 1.5e-8
NORMAL_ROUNDING = 2e-7


class Read(NamedTuple):
    """A file as VTK reads it: (V, 3) each, by name of target."""

    vertices: np.ndarray
    normals: np.ndarray
    moved: dict[str, np.ndarray]
    turned: dict[str, np.ndarray]


def document(path: Path) -> dict:
    data = path.read_bytes()
    (length,) = struct.unpack_from("<I", data, 12)
    return json.loads(data[20 : 20 + length])


def read(path: Path, *, apply: bool = False) -> Read:
    """With ``apply``, vertices are where the default weights have moved them."""
    reader = vtkGLTFReader()
    reader.SetFileName(str(path))
    reader.SetApplyDeformationsToGeometry(apply)
    reader.Update()
    blocks = reader.GetOutput().NewIterator()
    blocks.InitTraversal()
    mesh = blocks.GetCurrentDataObject()
    data = mesh.GetPointData()

    def array(name: str) -> np.ndarray:
        return np.array(vtk_to_numpy(data.GetArray(name)), dtype=np.float64)

    names = document(path)["meshes"][0].get("extras", {}).get("targetNames", [])
    return Read(
        np.array(vtk_to_numpy(mesh.GetPoints().GetData()), dtype=np.float64),
        np.array(vtk_to_numpy(data.GetNormals()), dtype=np.float64),
        {name: array(f"target{i}_position") for i, name in enumerate(names)},
        {name: array(f"target{i}_normal") for i, name in enumerate(names)},
    )


SPEAKER = pdeface.random(9)


@pytest.fixture(scope="module")
def visemes_file(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("visemes") / "a.glb"
    pdeface.export(SPEAKER, path, visemes=True)
    return path


def lopsided() -> Face:
    """A face whose curves are not their own reflections."""
    face = pdeface.neutral()
    points = face.curves.points.copy()
    points[:, 23:] *= [1.0, 1.0, 1.2]
    return face.with_curves(BoundaryCurves(points, face.curves.mirror_z))


CASES = {
    "neutral": (pdeface.neutral(), (28, 41), "smooth"),
    "someone": (pdeface.random(3), (109, 61), "smooth"),
    "finer curves": (pdeface.random(4, "55x92"), (40, 41), "smooth"),
    "the paper's join": (pdeface.random(5), (55, 41), "patchwise"),
    "not mirrored": (lopsided(), (28, 41), "smooth"),
}


@pytest.mark.parametrize("case", CASES)
def test_the_face_and_a_target_are_the_face_solved_anew(case: str, tmp_path: Path) -> None:
    face, mesh, join = CASES[case]
    pdeface.export(face, tmp_path / "a.glb", mesh=mesh, join=join)
    file = read(tmp_path / "a.glb")
    assert list(file.moved) == EXPRESSIONS
    assert not file.moved["tongueOut"].any()
    for name in SKIN:
        company = controls.COMPANY.get(name, {})
        truth, others = (
            face.set(**weights).mesh(*mesh, join=join)
            for weights in ({**company, name: 1.0}, company)
        )
        expected = truth.vertices - others.vertices
        error = np.linalg.norm(file.moved[name] - expected, axis=1)
        stored = file.moved[name].any(axis=1)
        assert error[stored].max() < ROUNDING, name
        assert error.max() < STILL + ROUNDING, name
        if company:
            continue
        error = np.linalg.norm(file.normals + file.turned[name] - truth.normals, axis=1)
        stored = file.turned[name].any(axis=1)
        assert error[stored].max() < NORMAL_ROUNDING, name
        assert error.max() < UNTURNED + NORMAL_ROUNDING, name
        assert stored.any(), name


@pytest.mark.parametrize("apply", [False, True])
def test_what_a_face_does_are_default_weights_and_who_it_is_is_the_mesh(
    apply: bool, tmp_path: Path
) -> None:
    person = pdeface.random(6)
    weights = {"jawOpen": 0.4, "eyeWideLeft": 1.0, "mouthSmileRight": 0.3}
    pdeface.export(person.set(**weights), tmp_path / "a.glb")
    (mesh,) = document(tmp_path / "a.glb")["meshes"]
    at_weight = dict(zip(mesh["extras"]["targetNames"], mesh["weights"], strict=True))
    assert at_weight == {name: weights.get(name, 0.0) for name in EXPRESSIONS}
    truth = person.set(**weights) if apply else person
    error = read(tmp_path / "a.glb", apply=apply).vertices - truth.mesh(28, 41).vertices
    assert np.abs(error).max() < (sum(weights.values()) if apply else 0) * STILL + ROUNDING


def test_an_expression_that_is_no_target_is_part_of_the_mesh(tmp_path: Path) -> None:
    face = pdeface.neutral().set(jawOpen=0.5, eyeBlinkRight=0.25)
    chosen = ("eyeBlinkRight", "browInnerUp")
    pdeface.export(face, tmp_path / "a.glb", expressions=chosen)
    (mesh,) = document(tmp_path / "a.glb")["meshes"]
    assert mesh["extras"] == {"targetNames": list(chosen)}
    assert mesh["weights"] == [0.25, 0.0]
    file, open_mouth = read(tmp_path / "a.glb"), pdeface.neutral().set(jawOpen=0.5)
    np.testing.assert_allclose(file.vertices, open_mouth.mesh().vertices, atol=ROUNDING)
    both = open_mouth.set(browInnerUp=1.0).mesh().normals
    turned = file.normals + file.turned["browInnerUp"]
    np.testing.assert_allclose(turned, both, atol=UNTURNED + NORMAL_ROUNDING)


@pytest.mark.parametrize("suffix", ["glb", "stl"])
def test_without_targets_everything_is_part_of_the_mesh(suffix: str, tmp_path: Path) -> None:
    import trimesh

    face = pdeface.random(8).set(jawOpen=0.8)
    pdeface.export(face, tmp_path / f"a.{suffix}", expressions=())
    mesh = next(iter(trimesh.load_scene(tmp_path / f"a.{suffix}", process=False).geometry.values()))
    truth = face.mesh()
    np.testing.assert_allclose(
        mesh.triangles, truth.vertices[truth.triangles], rtol=0, atol=ROUNDING
    )
    if suffix == "glb":
        (written,) = document(tmp_path / "a.glb")["meshes"]
        assert not {"weights", "extras"} & set(written)
        assert "targets" not in written["primitives"][0]


def test_all_is_the_default_and_in_the_order_of_arkit(tmp_path: Path) -> None:
    pdeface.export(pdeface.neutral(), tmp_path / "a.glb")
    pdeface.export(pdeface.neutral(), tmp_path / "b.glb", expressions="all")
    assert (tmp_path / "a.glb").read_bytes() == (tmp_path / "b.glb").read_bytes()
    (mesh,) = document(tmp_path / "a.glb")["meshes"]
    assert mesh["extras"]["targetNames"] == list(ARKIT)


def test_every_primitive_has_every_target(tmp_path: Path) -> None:
    pdeface.export(pdeface.neutral(), tmp_path / "a.glb")
    (mesh,) = document(tmp_path / "a.glb")["meshes"]
    for primitive in mesh["primitives"]:
        assert len(primitive["targets"]) == len(mesh["weights"]) == len(EXPRESSIONS)
        matt = document(tmp_path / "a.glb")["materials"][primitive["material"]]["name"] in MATT
        expected = {"POSITION"} if matt else {"POSITION", "NORMAL"}
        assert all(set(target) == expected for target in primitive["targets"])


@pytest.mark.parametrize("seed", [None, 1, 2])
def test_the_file_is_small(seed: int | None, tmp_path: Path) -> None:
    face = pdeface.neutral() if seed is None else pdeface.random(seed)
    pdeface.export(face, tmp_path / "a.glb", mesh=(28, 41), openings="none")
    assert (tmp_path / "a.glb").stat().st_size <= 1_200_000
    # Eyes, teeth, tongue and the inside of the mouth, with their targets; less their textures.
    pdeface.export(face, tmp_path / "b.glb", mesh=(28, 41))
    written = document(tmp_path / "b.glb")
    pictures = sum(
        written["bufferViews"][image["bufferView"]]["byteLength"] for image in written["images"]
    )
    assert (tmp_path / "b.glb").stat().st_size - pictures <= 1_200_000


@pytest.mark.parametrize("suffix", ["glb", "gltf"])
@pytest.mark.parametrize(
    ("mesh", "expressions"), [((28, 41), "all"), ((2, 2), "all"), ((256, 257), ("jawOpen",))]
)
def test_the_validator_finds_nothing(
    suffix: str, mesh, expressions, quarters, tmp_path: Path, khronos
) -> None:
    face = pdeface.random(2).set(jawOpen=0.5).with_texture(quarters)
    pdeface.export(face, tmp_path / f"a.{suffix}", mesh=mesh, expressions=expressions)
    report = khronos(tmp_path / f"a.{suffix}")
    assert report["issues"]["messages"] == []
    assert report["info"]["hasMorphTargets"]


def test_the_validator_on_a_face_without_area(quarters, tmp_path: Path, khronos) -> None:
    face = Face(BoundaryCurves(np.zeros((28, 46, 3))), quarters)
    pdeface.export(face, tmp_path / "a.glb")
    assert khronos(tmp_path / "a.glb")["issues"]["messages"] == []


@pytest.mark.parametrize(
    ("expressions", "message"),
    [
        (("jawOpn",), "no expression is called 'jawOpn'; did you mean jawOpen"),
        (("identity01",), "no expression is called 'identity01'"),
        (("tongueOt",), "did you mean tongueOut"),
        ((3,), "no expression is called 3"),
        ("jawOpen", r"or a sequence of names, such as \('jawOpen',\), got 'jawOpen'"),
        (7, "or a sequence of names"),
    ],
)
def test_what_is_no_expression_is_said(expressions, message: str, tmp_path: Path) -> None:
    with pytest.raises(InputError, match=message):
        pdeface.export(pdeface.neutral(), tmp_path / "a.glb", expressions=expressions)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("suffix", ["obj", "ply", "stl", "pdeface"])
def test_formats_that_stand_still_say_so(suffix: str, tmp_path: Path) -> None:
    which = r"can be written to \.glb, \.gltf and \.vrm"
    with pytest.raises(InputError, match=f"expressions {which}"):
        pdeface.export(pdeface.neutral(), tmp_path / f"a.{suffix}", expressions="all")
    with pytest.raises(InputError, match=f"visemes {which}"):
        pdeface.export(pdeface.neutral(), tmp_path / f"a.{suffix}", visemes=True)
    pdeface.export(pdeface.neutral(), tmp_path / f"a.{suffix}", expressions=())


def test_curves_that_lie_on_no_lids_make_no_expression(tmp_path: Path) -> None:
    face = Face(BoundaryCurves(pdeface.neutral().curves.points[:27]))
    pdeface.export(face, tmp_path / "a.glb")
    assert "weights" not in document(tmp_path / "a.glb")["meshes"][0]
    with pytest.raises(InputError, match="27 n"):
        pdeface.export(face, tmp_path / "b.glb", expressions="all")
    with pytest.raises(InputError, match="27 n"):
        pdeface.export(face, tmp_path / "b.glb", visemes=True)
    assert not (tmp_path / "b.glb").exists()


@pytest.mark.parametrize("name", VISEMES)
def test_a_viseme_is_the_weighted_sum_of_its_controls(name: str, visemes_file: Path) -> None:
    file, spoken = read(visemes_file), SPEAKER.set(**VISEMES[name]).mesh(28, 41)
    error = file.vertices + file.moved[name] - spoken.vertices
    assert np.abs(error).max() < STILL + ROUNDING
    error = file.normals + file.turned[name] - spoken.normals
    assert np.abs(error).max() < UNTURNED + NORMAL_ROUNDING
    summed = sum((w * file.moved[n] for n, w in VISEMES[name].items()), np.zeros((28 * 41, 3)))
    bound = (1.0 + sum(VISEMES[name].values())) * STILL + ROUNDING
    assert np.abs(file.moved[name] - summed).max() < bound


def test_visemes_follow_the_expressions_and_are_at_rest(visemes_file: Path, khronos) -> None:
    (mesh,) = document(visemes_file)["meshes"]
    assert mesh["extras"]["targetNames"] == [*EXPRESSIONS, *VISEMES]
    assert mesh["weights"] == [0.0] * (52 + 15)
    assert not read(visemes_file).moved["viseme_sil"].any()
    report = khronos(visemes_file)
    assert {m["code"] for m in report["issues"]["messages"]} == {"UNUSED_OBJECT"}
    assert report["issues"]["numErrors"] == report["issues"]["numWarnings"] == 0


def test_visemes_alone(tmp_path: Path) -> None:
    face = pdeface.neutral().set(jawOpen=0.5)
    pdeface.export(face, tmp_path / "a.glb", expressions=(), visemes=True)
    assert list(read(tmp_path / "a.glb").moved) == list(VISEMES)
    error = read(tmp_path / "a.glb").vertices - face.mesh(28, 41).vertices
    assert np.abs(error).max() < ROUNDING


def test_a_name_given_twice_is_one_target(tmp_path: Path) -> None:
    pdeface.export(pdeface.neutral(), tmp_path / "a.glb", expressions=["jawOpen", "jawOpen"])
    assert document(tmp_path / "a.glb")["meshes"][0]["weights"] == [0.0]


def test_too_much_for_a_viewer_is_refused(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="1000 x 1000 would take up to 1.2 GiB"):
        pdeface.export(pdeface.neutral(), tmp_path / "a.glb", mesh=(1000, 1000))


def test_batches_change_nothing(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    pdeface.export(pdeface.neutral(), tmp_path / "a.glb")
    monkeypatch.setattr(_targets, "_BATCH", 6 * 28 * 41 * 5)
    pdeface.export(pdeface.neutral(), tmp_path / "b.glb")
    one, five = read(tmp_path / "a.glb"), read(tmp_path / "b.glb")
    for name in EXPRESSIONS:
        np.testing.assert_allclose(one.moved[name], five.moved[name], atol=1.01 * STILL)
        np.testing.assert_allclose(one.turned[name], five.turned[name], atol=1.01 * UNTURNED)


def stored(builder: GltfBuilder, index: int) -> np.ndarray:
    """An accessor's values, as section 3.6.2.3 of the glTF 2.0 specification tells."""
    written = json.loads(builder.to_gltf())
    _, data = builder.to_glb().split(b"BIN\0", 1)
    accessor = written["accessors"][index]

    def view(number: int, kind: str, count: int, start: int = 0) -> np.ndarray:
        start += written["bufferViews"][number]["byteOffset"]
        return np.frombuffer(data, kind, count, start)

    values = view(accessor["bufferView"], "<f4", 3 * accessor["count"]).reshape(-1, 3).copy()
    if "sparse" in accessor:
        sparse = accessor["sparse"]
        kind = {5121: "u1", 5123: "<u2", 5125: "<u4"}[sparse["indices"]["componentType"]]
        count = sparse["count"]
        rows = view(sparse["indices"]["bufferView"], kind, count, sparse["indices"]["byteOffset"])
        assert (np.diff(rows.astype(int)) > 0).all()
        own = sparse["values"]
        stored = view(own["bufferView"], "<f4", 3 * count, own["byteOffset"])
        values[rows] = stored.reshape(-1, 3)
    assert np.float32(accessor["min"]).tolist() == values.min(axis=0).tolist()
    assert np.float32(accessor["max"]).tolist() == values.max(axis=0).tolist()
    return values


@given(
    arrays(
        np.float32,
        st.tuples(st.sampled_from([1, 3, 256, 300, 70_000]), st.just(3)),
        elements=st.floats(-1, 1, width=32),
        fill=st.sampled_from([np.float32(x) for x in (0.0, 1e-7, 1.0)]),
    )
)
def test_differences_are_kept_but_for_the_smallest(values: np.ndarray) -> None:
    builder = GltfBuilder("test")
    kept = stored(builder, builder.add_differences(values, 1e-6, bounds=True))
    error = np.linalg.norm(kept - values, axis=1)
    assert error.max() <= 1e-6
    assert (error[np.linalg.norm(values, axis=1) > 1.001e-6] == 0.0).all()


@pytest.mark.parametrize("share", [0.0, 0.5, 0.8, 1.0])
@pytest.mark.parametrize("count", [100, 5_000, 70_000])
def test_differences_never_take_more_bytes_than_all_of_them(share: float, count: int) -> None:
    values = np.zeros((count, 3), np.float32)
    values[: int(share * count)] = 1.0
    builder = GltfBuilder("test")
    builder.add_differences(np.zeros_like(values), 0.0)  # the zeros that all of them share
    before = len(builder.to_glb())
    builder.add_differences(values, 0.0)
    added = len(builder.to_glb()) - before
    assert added < values.nbytes + 500
    if share <= 0.5:
        assert added < 0.7 * values.nbytes + 500
