"""One function, the suffix picks the format."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import pdeface
from pdeface.curves import BoundaryCurves
from pdeface.errors import InputError, MissingExtraError
from pdeface.face import Face
from pdeface.formats import SUFFIXES

SIGNS = {
    ".glb": b"glTF",
    ".gltf": b'{"asset"',
    ".vrm": b"glTF",
    ".obj": b"# pdeface",
    ".ply": b"ply\n",
    ".stl": b"pdeface",
    ".pdeface": b"PK",
}


@pytest.mark.parametrize("suffix", SUFFIXES)
def test_suffix_picks_the_format(textured: Face, suffix: str, tmp_path: Path) -> None:
    for name in (f"a.face{suffix}", f"B{suffix.upper()}"):
        pdeface.export(textured, tmp_path / name)
        assert (tmp_path / name).read_bytes().startswith(SIGNS[suffix])
    assert not [entry for entry in tmp_path.iterdir() if entry.name.startswith(".")]


@pytest.mark.parametrize("name", ["face.fbx", "face", ".glb", "face.glb.zip", ""])
def test_unknown_suffix_lists_the_known(textured: Face, name: str, tmp_path: Path) -> None:
    with pytest.raises(InputError) as caught:
        pdeface.export(textured, tmp_path / name)
    assert all(suffix in str(caught.value) for suffix in SUFFIXES)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("suffix", [".glb", ".gltf", ".vrm", ".stl"])
def test_formats_without_quads_say_so(textured: Face, suffix: str, tmp_path: Path) -> None:
    with pytest.raises(InputError, match="leave quads out"):
        pdeface.export(textured, tmp_path / f"a{suffix}", quads=True)


@pytest.mark.parametrize("mesh", [
    (1, 41), (28, 0), (28,), (28, 41, 2), (28.0, 41), ("28", "41"), (10**6, 10**6), (-5, -5), 28,
])  # fmt: skip
def test_meshes_that_cannot_be(textured: Face, mesh, tmp_path: Path) -> None:
    with pytest.raises(InputError):
        pdeface.export(textured, tmp_path / "a.glb", mesh=mesh)


def test_joins_that_cannot_be(textured: Face, tmp_path: Path) -> None:
    five = textured.with_curves(BoundaryCurves(textured.curves.points[:5]))
    for face, join in ((textured, "welded"), (five, "patchwise")):
        with pytest.raises(InputError, match="join"):
            pdeface.export(face, tmp_path / "a.glb", join=join)  # type: ignore[arg-type]


def test_the_join_reaches_the_file(tmp_path: Path) -> None:
    face = Face(BoundaryCurves(np.random.default_rng(0).normal(size=(7, 8, 3))))
    pdeface.export(face, tmp_path / "a.stl", join="smooth")
    pdeface.export(face, tmp_path / "b.stl", join="patchwise")
    assert (tmp_path / "a.stl").read_bytes() != (tmp_path / "b.stl").read_bytes()


def test_too_large_for_single_precision(plain: Face, tmp_path: Path) -> None:
    face = plain.with_curves(BoundaryCurves(plain.curves.points * 1e60))
    with pytest.raises(InputError, match="single precision"):
        pdeface.export(face, tmp_path / "a.glb")


@pytest.mark.parametrize("suffix", [suffix for suffix in SUFFIXES if suffix != ".stl"])
def test_a_failed_export_leaves_what_was_there(
    textured: Face, suffix: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    target = tmp_path / f"a{suffix}"
    target.write_bytes(b"old")
    monkeypatch.setitem(sys.modules, "PIL.Image", None)
    with pytest.raises(MissingExtraError, match="pip install"):
        pdeface.export(textured, target)
    assert target.read_bytes() == b"old"
    assert [entry.name for entry in tmp_path.iterdir()] == [target.name]


@pytest.mark.parametrize("suffix", SUFFIXES)
def test_missing_folder(plain: Face, suffix: str, tmp_path: Path) -> None:
    with pytest.raises(InputError, match="does not exist"):
        pdeface.export(plain, tmp_path / "nowhere" / f"a{suffix}")


def test_without_texture_numpy_is_enough(tmp_path: Path) -> None:
    program = f"""
import sys
import numpy as np
import pdeface
from pdeface import BoundaryCurves, Face
face = Face(BoundaryCurves(np.random.default_rng(0).normal(size=(4, 8, 3))))
for suffix in {SUFFIXES}:
    pdeface.export(face, {str(tmp_path)!r} + "/a" + suffix)
assert pdeface.load({str(tmp_path)!r} + "/a.pdeface") == face
outside = {{"PIL", "trimesh", "scipy", "pyvista", "vtk", "numba", "typer", "rich", "pygltflib"}}
print(sorted(outside & set(sys.modules)))
"""
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)}
    answer = subprocess.run(
        [sys.executable, "-c", program], env=environment, capture_output=True, text=True, check=True
    )
    assert answer.stdout.strip() == "[]"
