"""The face as a value."""

from __future__ import annotations

import copy
import dataclasses
import io
import pickle
import sys
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

import pdeface
from pdeface.curves import BoundaryCurves, curve_parameters
from pdeface.errors import FileFormatError, InputError, MissingExtraError
from pdeface.face import Face

RNG = np.random.default_rng(3)
TEXTURE = RNG.integers(0, 256, (16, 32, 3), dtype=np.uint8)


def cylinder(curves: int = 7, points: int = 46, radius: float = 0.08) -> BoundaryCurves:
    """Rings of a cylinder about the y axis, 20 cm high."""
    v = curve_parameters(points)
    ring = radius * np.stack([-np.cos(v), np.zeros_like(v), np.sin(v)], -1)
    height = np.linspace(0.1, -0.1, curves)
    return BoundaryCurves(ring + height[:, None, None] * [0.0, 1.0, 0.0])


@pytest.fixture
def face() -> Face:
    return Face(cylinder(), TEXTURE, name="Ada", notes={"licence": "CC0"})


def jpeg() -> bytes:
    stream = io.BytesIO()
    Image.fromarray(TEXTURE).save(stream, "JPEG", quality=60)
    return stream.getvalue()


def test_nothing_of_it_can_be_changed(face: Face) -> None:
    with pytest.raises(dataclasses.FrozenInstanceError):
        face.name = "Bob"  # type: ignore[misc]
    with pytest.raises(ValueError, match="read-only"):
        face.curves.points[0, 0, 0] = 1.0
    assert face.texture is not None
    with pytest.raises(ValueError, match="read-only"):
        face.texture[0, 0, 0] = 1
    with pytest.raises(TypeError):
        face.notes["x"] = "y"  # type: ignore[index]


def test_it_shares_nothing_with_what_it_was_made_from() -> None:
    image, notes = TEXTURE.copy(), {"a": "b"}
    window = image[:]
    window.setflags(write=False)
    faces = [Face(cylinder(), image, notes=notes), Face(cylinder(), window)]
    image[:] = 0
    notes["a"] = "c"
    assert all(np.array_equal(face.texture, TEXTURE) for face in faces)  # type: ignore[arg-type]
    assert faces[0].notes == {"a": "b"}


def test_equal_by_value(face: Face) -> None:
    assert face == Face(cylinder(), TEXTURE.copy(), name="Ada", notes={"licence": "CC0"})
    others = [
        face.with_name("Bob"),
        face.with_texture(None),
        face.with_texture(TEXTURE[:, :, ::-1]),
        face.with_texture(TEXTURE[:8]),
        face.with_curves(cylinder(10)),
        face.with_notes({"source": "x"}),
        dataclasses.replace(face, a=2.0),
        dataclasses.replace(face, modes=5),
        "a face",
    ]
    assert all(face != other for other in others)


@pytest.mark.parametrize("again", [
    copy.copy, copy.deepcopy, lambda face: pickle.loads(pickle.dumps(face)),
])  # fmt: skip
def test_copies_are_equal_and_as_unchangeable(face: Face, again) -> None:
    other = again(face.with_texture(jpeg()))
    assert other == face.with_texture(jpeg())
    assert other.texture_file() == jpeg()
    assert not other.texture.flags.writeable
    assert not other.curves.points.flags.writeable


def test_mesh_of_a_cylinder_is_nearly_one_and_faces_outwards(face: Face) -> None:
    mesh = face.mesh(31, 45)
    assert mesh.grid == (31, 45)
    v, height = np.tile(np.linspace(0, np.pi, 45), 31), np.repeat(np.linspace(0.1, -0.1, 31), 45)
    normals = np.stack([-np.cos(v), np.zeros_like(v), np.sin(v)], -1)
    # A cylinder is no solution of equation (1): between its rings the surface bulges a little.
    vertices = 0.08 * normals + height[:, None] * [0, 1, 0]
    np.testing.assert_allclose(mesh.vertices, vertices, atol=3e-4)
    assert (mesh.normals * normals).sum(axis=1).min() > 0.999
    np.testing.assert_allclose(mesh.texcoords[:, 0], v / np.pi, atol=1e-15)
    np.testing.assert_allclose(mesh.texcoords[:, 1], (0.1 - height) / 0.2, atol=1e-12)
    corners = mesh.vertices[mesh.triangles]
    facing = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    assert ((facing * mesh.normals[mesh.triangles[:, 0]]).sum(axis=1) > 0).all()


def test_closed_mesh_goes_all_round(face: Face) -> None:
    mesh = face.mesh(5, 40, extent="loop")
    assert mesh.vertices[:, 2].min() == pytest.approx(-0.08, abs=1e-4)
    assert len(mesh.quads) == 4 * 40


@pytest.mark.parametrize("join", ["smooth", "patchwise"])
def test_mesh_and_surface_agree(join) -> None:
    face = Face(BoundaryCurves(RNG.normal(size=(7, 12, 3))), a=2.0, modes=3)
    mesh, surface = face.mesh(9, 11, join=join), face.surface(join)
    u, v = np.meshgrid(np.linspace(0, 1, 9), np.linspace(0, np.pi, 11), indexing="ij")
    np.testing.assert_allclose(mesh.vertices, surface(u, v).reshape(-1, 3), atol=1e-9)
    np.testing.assert_allclose(mesh.normals, surface.normal(u, v).reshape(-1, 3), atol=1e-7)


def test_texture_from_a_file_is_kept_as_it_came(face: Face, tmp_path: Path) -> None:
    other = face.with_texture(jpeg())
    np.testing.assert_array_equal(other.texture, np.asarray(Image.open(io.BytesIO(jpeg()))))
    for kept in (other, other.with_name("Bob"), other.with_curves(cylinder(4))):
        assert kept.texture_file() == kept.texture_file(compact=True) == jpeg()
    other.save(tmp_path / "a.pdeface")
    assert pdeface.load(tmp_path / "a.pdeface").texture_file() == jpeg()


def test_a_replaced_texture_is_not_confused_with_its_file(face: Face) -> None:
    other = dataclasses.replace(face.with_texture(jpeg()), texture=TEXTURE)
    data = other.texture_file()
    assert data is not None
    np.testing.assert_array_equal(np.asarray(Image.open(io.BytesIO(data))), TEXTURE)
    assert face.with_texture(None).texture_file() is None


def test_saved_only_as_pdeface(face: Face, tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"pdeface\.export"):
        face.save(tmp_path / "a.glb")
    face.save(tmp_path / "A.PDEFACE")
    assert pdeface.load(str(tmp_path / "A.PDEFACE")) == face


def test_a_failed_save_keeps_the_old_file(
    face: Face, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    face.save(tmp_path / "a.pdeface")

    def interrupted(*_: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr("os.replace", interrupted)
    with pytest.raises(KeyboardInterrupt):
        face.with_name("Bob").save(tmp_path / "a.pdeface")
    assert pdeface.load(tmp_path / "a.pdeface") == face
    assert len(list(tmp_path.iterdir())) == 1


def test_loading_what_is_not_there(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="found none at"):
        pdeface.load(tmp_path / "a.pdeface")
    with pytest.raises(InputError, match="folder"):
        pdeface.load(tmp_path)
    with pytest.raises(InputError, match="cannot read"):
        pdeface.load("a\0b")


def test_a_huge_file_is_not_read(tmp_path: Path) -> None:
    with open(tmp_path / "a.pdeface", "wb") as file:
        file.truncate(1 << 40)  # sparse: it takes no room
    with pytest.raises(FileFormatError, match="at most 512 MiB"):
        pdeface.load(tmp_path / "a.pdeface")


@pytest.mark.parametrize("changes", [
    {"a": 0.5}, {"a": float("nan")}, {"modes": -1}, {"modes": 1.5}, {"name": 3},
    {"name": "\udc80"}, {"notes": {"x": 1}}, {"notes": {1: "x"}}, {"texture": TEXTURE / 255},
    {"texture": TEXTURE[..., 0]}, {"curves": np.zeros((4, 8, 3))},
], ids=str)  # fmt: skip
def test_what_no_face_has(face: Face, changes) -> None:
    with pytest.raises(InputError):
        dataclasses.replace(face, **changes)


def test_only_a_texture_needs_pillow(
    face: Face, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    face.save(tmp_path / "textured.pdeface")
    monkeypatch.setitem(sys.modules, "PIL.Image", None)
    plain = face.with_texture(None)
    plain.save(tmp_path / "plain.pdeface")
    assert pdeface.load(tmp_path / "plain.pdeface") == plain
    with pytest.raises(MissingExtraError, match="pip install"):
        face.save(tmp_path / "b.pdeface")
    with pytest.raises(MissingExtraError, match="pip install"):
        pdeface.load(tmp_path / "textured.pdeface")


def test_repr_is_short(face: Face) -> None:
    assert repr(face) == "Face('Ada', BoundaryCurves(7 curves x 46 points), texture 32 x 16)"
    assert "no texture" in repr(face.with_texture(None))
