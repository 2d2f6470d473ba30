"""GLB and glTF, as the Khronos validator and trimesh read them."""

from __future__ import annotations

import io
import json
import struct
from pathlib import Path

import numpy as np
import pytest
import trimesh
from PIL import Image

import pdeface
from pdeface import images
from pdeface.curves import BoundaryCurves
from pdeface.errors import InputError
from pdeface.face import Face
from pdeface.formats import _gltf_builder
from pdeface.formats._gltf_builder import GltfBuilder

SUFFIXES = ("glb", "gltf")


def document(path: Path) -> dict:
    if path.suffix == ".gltf":
        return json.loads(path.read_bytes())
    data = path.read_bytes()
    (length,) = struct.unpack_from("<I", data, 12)
    return json.loads(data[20 : 20 + length])


def read_back(path: Path) -> trimesh.Trimesh:
    """The skin, which comes before what lies behind its openings."""
    return next(iter(trimesh.load_scene(path, process=False).geometry.values()))


@pytest.mark.parametrize("suffix", SUFFIXES)
@pytest.mark.parametrize("mesh", [(2, 2), (28, 41), (109, 161), (300, 240)], ids=str)
def test_the_validator_finds_nothing(textured: Face, suffix, mesh, tmp_path: Path, khronos) -> None:
    for openings in ("none", "cut"):
        path = tmp_path / f"{openings}.{suffix}"
        pdeface.export(textured, path, mesh=mesh, expressions=(), openings=openings)
        report = khronos(path)
        assert report["issues"]["messages"] == []
        primitives = document(path)["meshes"][0]["primitives"]
        assert len(primitives) == (9 if openings == "cut" and mesh != (2, 2) else 1)
        skin = document(path)["accessors"][primitives[0]["indices"]]
        assert skin["count"] == 3 * len(textured.mesh(*mesh, openings=openings).triangles)
    assert report["info"]["hasTextures"]


@pytest.mark.parametrize("suffix", SUFFIXES)
def test_the_validator_on_a_face_without_texture(
    plain: Face, suffix, tmp_path: Path, khronos
) -> None:
    pdeface.export(plain, tmp_path / f"a.{suffix}")
    report = khronos(tmp_path / f"a.{suffix}")
    # The texture coordinates wait for a texture that another program may give the face.
    codes = {(m["code"], m["pointer"].rpartition("/")[2]) for m in report["issues"]["messages"]}
    assert codes == {("UNUSED_OBJECT", "TEXCOORD_0")}
    assert report["issues"]["numErrors"] == report["issues"]["numWarnings"] == 0


def test_the_validator_on_every_kind_of_face(
    plain: Face, photo: np.ndarray, tmp_path: Path, khronos
) -> None:
    alpha = np.concatenate([photo, np.full((128, 64, 1), 9, np.uint8)], -1)
    noise = np.random.default_rng(0).normal(size=(5, 9, 3))
    pinched = np.repeat(noise[:, :1], 9, axis=1)
    names = {"name": 'Zo\u00eb "\\\n\u2603', "notes": {"copyright": "CC0"}}
    faces = [
        plain.with_texture(photo),
        plain.with_texture(alpha),
        Face(BoundaryCurves(noise), photo, **names),
        Face(BoundaryCurves(noise * 1e9), photo),
        Face(BoundaryCurves(pinched), photo),
        Face(BoundaryCurves(np.zeros((4, 8, 3))), photo),
    ]
    for face in faces:
        pdeface.export(face, tmp_path / "a.glb")
        report = khronos(tmp_path / "a.glb")
        assert report["issues"]["messages"] == []


@pytest.mark.parametrize("suffix", SUFFIXES)
def test_read_back(textured: Face, suffix, tmp_path: Path) -> None:
    pdeface.export(textured, tmp_path / f"a.{suffix}", mesh=(37, 41), join="patchwise")
    mesh, truth = read_back(tmp_path / f"a.{suffix}"), textured.mesh(37, 41, join="patchwise")
    np.testing.assert_allclose(mesh.vertices, truth.vertices, rtol=1e-6, atol=1e-8)
    np.testing.assert_allclose(mesh.vertex_normals, truth.normals, atol=1e-6)
    np.testing.assert_array_equal(mesh.faces, truth.triangles)
    # trimesh counts t from below, glTF from above
    np.testing.assert_allclose(mesh.visual.uv, truth.texcoords * [1, -1] + [0, 1], atol=1e-6)


@pytest.mark.parametrize("suffix", SUFFIXES)
def test_outside_is_outside(textured: Face, suffix, tmp_path: Path) -> None:
    pdeface.export(textured, tmp_path / f"a.{suffix}")
    mesh = read_back(tmp_path / f"a.{suffix}")
    outwards = mesh.triangles_center * [1, 0, 1]
    assert ((mesh.face_normals * outwards).sum(axis=1) > 0).all()
    assert ((mesh.vertex_normals * mesh.vertices * [1, 0, 1]).sum(axis=1) > 0).all()
    assert mesh.vertices[:, 2].mean() > 0.02, "the face looks along +Z"


@pytest.mark.parametrize("suffix", SUFFIXES)
def test_texture_is_the_right_way_up(
    textured: Face, suffix, tmp_path: Path, check_quarters
) -> None:
    pdeface.export(textured, tmp_path / f"a.{suffix}")
    mesh = read_back(tmp_path / f"a.{suffix}")
    check_quarters(mesh.vertices, mesh.visual.to_color().vertex_colors)


def test_texture_is_the_smaller_of_two_kinds(
    plain: Face, quarters: np.ndarray, photo: np.ndarray, tmp_path: Path
) -> None:
    for image, kind in ((quarters, "image/png"), (photo, "image/jpeg")):
        pdeface.export(plain.with_texture(image), tmp_path / "a.glb")
        assert document(tmp_path / "a.glb")["images"][0]["mimeType"] == kind


def test_a_jpeg_is_embedded_as_it_came(plain: Face, photo: np.ndarray, tmp_path: Path) -> None:
    stream = io.BytesIO()
    Image.fromarray(photo).save(stream, "JPEG", quality=20)
    pdeface.export(plain.with_texture(stream.getvalue()), tmp_path / "a.glb")
    assert stream.getvalue() in (tmp_path / "a.glb").read_bytes()


def test_saving_a_face_does_not_change_its_export(
    plain: Face, photo: np.ndarray, tmp_path: Path
) -> None:
    face = plain.with_texture(photo)
    face.save(tmp_path / "a.pdeface")
    pdeface.export(face, tmp_path / "a.glb")
    pdeface.export(pdeface.load(tmp_path / "a.pdeface"), tmp_path / "b.glb")
    assert (tmp_path / "a.glb").read_bytes() == (tmp_path / "b.glb").read_bytes()


def test_material(plain: Face, photo: np.ndarray, tmp_path: Path) -> None:
    opaque = np.concatenate([photo, np.full((128, 64, 1), 255, np.uint8)], -1)
    holes = opaque.copy()
    holes[5, 5, 3] = 0
    for image, mode in ((None, None), (opaque, None), (holes, "MASK")):
        pdeface.export(plain.with_texture(image), tmp_path / "a.glb")
        material, *_ = document(tmp_path / "a.glb")["materials"]
        assert material.get("alphaMode") == mode
        assert ("baseColorTexture" in material["pbrMetallicRoughness"]) == (image is not None)
        assert material["pbrMetallicRoughness"]["metallicFactor"] == 0


def test_texture_neither_repeats_nor_flickers(textured: Face, tmp_path: Path) -> None:
    pdeface.export(textured, tmp_path / "a.glb")
    for sampler in document(tmp_path / "a.glb")["samplers"]:
        assert sampler == {"magFilter": 9729, "minFilter": 9987, "wrapS": 33071, "wrapT": 33071}


def test_eyes_and_mouth_have_materials_of_their_own(textured: Face, tmp_path: Path) -> None:
    pdeface.export(textured, tmp_path / "a.glb")
    file = document(tmp_path / "a.glb")
    used = [file["materials"][p["material"]]["name"] for p in file["meshes"][0]["primitives"]]
    behind = ["eye", "eye", "lids", "lids", "mouth", "teeth", "teeth", "tongue"]
    assert used == ["skin", *behind]
    assert all("baseColorTexture" in m["pbrMetallicRoughness"] for m in file["materials"])


@pytest.mark.parametrize(("mesh", "component"), [((255, 257), 5123), ((256, 256), 5125)])
def test_indices_are_as_wide_as_needed(plain: Face, mesh, component, tmp_path: Path) -> None:
    pdeface.export(plain, tmp_path / "a.glb", mesh=mesh)
    primitive = document(tmp_path / "a.glb")["meshes"][0]["primitives"][0]
    accessor = document(tmp_path / "a.glb")["accessors"][primitive["indices"]]
    assert accessor["componentType"] == component


def test_names_and_credits(plain: Face, tmp_path: Path) -> None:
    pdeface.export(
        plain.with_name("Ada").with_notes({"copyright": "2024 Ada, CC0"}), tmp_path / "a.gltf"
    )
    written = document(tmp_path / "a.gltf")
    assert written["asset"] == {
        "version": "2.0",
        "generator": f"pdeface {pdeface.__version__}",
        "copyright": "2024 Ada, CC0",
    }
    assert written["nodes"][0]["name"] == written["meshes"][0]["name"] == "Ada"


def test_chunks_are_aligned_and_counted(textured: Face, tmp_path: Path) -> None:
    for columns in (2, 3, 4, 5):
        pdeface.export(textured, tmp_path / "a.glb", mesh=(3, columns))
        data = (tmp_path / "a.glb").read_bytes()
        magic, version, total, length = struct.unpack_from("<4sIII", data)
        assert (magic, version, total, length % 4) == (b"glTF", 2, len(data), 0)
        body, kind = struct.unpack_from("<I4s", data, 20 + length)
        assert (body, kind, body % 4) == (len(data) - length - 28, b"BIN\0", 0)


def test_a_glb_over_the_limit_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(_gltf_builder, "_LARGEST_GLB", 1000)
    builder = GltfBuilder("test")
    builder.add_accessor(np.zeros((100, 3), np.float32))
    with pytest.raises(InputError, match="4 GiB"):
        builder.to_glb()


def test_bounds_are_those_of_the_stored_numbers() -> None:
    builder = GltfBuilder("test")
    values = np.float32([[0.1, 5, -3], [0.3, 4, -1e-9]])
    builder.add_accessor(values, "vertices", bounds=True)
    (accessor,) = json.loads(builder.to_gltf())["accessors"]
    assert np.float32(accessor["min"]).tolist() == values.min(axis=0).tolist()
    assert np.float32(accessor["max"][0]) == np.float32(0.3)
    # In as few digits as that takes: the specification has readers round them.
    assert accessor["max"][0] == 0.3


def test_media_type_of_the_texture_is_true(textured: Face, tmp_path: Path) -> None:
    pdeface.export(textured, tmp_path / "a.glb")
    data, written = (tmp_path / "a.glb").read_bytes(), document(tmp_path / "a.glb")
    view = written["bufferViews"][written["images"][0]["bufferView"]]
    start = 28 + struct.unpack_from("<I", data, 12)[0] + view["byteOffset"]
    image = data[start : start + view["byteLength"]]
    assert images.media_type(image) == written["images"][0]["mimeType"]
    np.testing.assert_array_equal(images.decode(image), textured.texture)
