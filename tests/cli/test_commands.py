"""The commands on a small face: files come out, and they hold what was asked for."""

from __future__ import annotations

import json
import struct

import numpy as np
import pytest

import pdeface
from pdeface.photo import fit_shape, portrait_face
from pdeface.texture import FeaturePoints, portrait, uv_texture, write_image


def png_size(path) -> tuple[int, int]:
    header = path.read_bytes()[:24]
    assert header[:8] == b"\x89PNG\r\n\x1a\n"
    return struct.unpack(">II", header[16:24])


def glb_json(path) -> dict:
    data = path.read_bytes()
    assert data[:4] == b"glTF"
    length = struct.unpack("<I", data[12:16])[0]
    return json.loads(data[20 : 20 + length])


@pytest.mark.parametrize(
    "suffix", [".glb", ".gltf", ".vrm", ".obj", ".ply", ".stl", ".pdeface", ".GLB"]
)
def test_export_writes_the_format_of_the_suffix(pdeface_command, bust_file, suffix) -> None:
    out = bust_file.with_name(f"out{suffix}")
    outcome = pdeface_command("export", bust_file, "-o", out, "--mesh", "9x11")
    assert (outcome.status, outcome.err) == (0, "")
    assert out.stat().st_size > 0
    assert str(out) in outcome.out


def test_export_to_several_files_and_into_new_folders(pdeface_command, bust_file) -> None:
    folder = bust_file.parent / "new" / "folder"
    outcome = pdeface_command(
        "export", bust_file, "-o", folder / "a.stl", "-o", folder / "a.glb", "--quiet"
    )
    assert (outcome.status, outcome.out, outcome.err) == (0, "", "")
    assert {"a.stl", "a.glb"} <= {path.name for path in folder.iterdir()}


@pytest.mark.parametrize("mesh", ["2x2", "28x41", "28X41"])
def test_export_samples_at_the_size_asked_for(pdeface_command, bust_file, mesh) -> None:
    out = bust_file.with_name("out.glb")
    assert pdeface_command("export", bust_file, "-o", out, "--mesh", mesh).status == 0
    content = glb_json(out)
    primitive = content["meshes"][0]["primitives"][0]
    rows, columns = map(int, mesh.lower().split("x"))
    position = content["accessors"][primitive["attributes"]["POSITION"]]
    assert position["count"] == rows * columns


def test_the_join_reaches_the_file(pdeface_command, bust_file) -> None:
    smooth, patchwise = bust_file.with_name("s.stl"), bust_file.with_name("p.stl")
    for out, join in ((smooth, "smooth"), (patchwise, "patchwise")):
        pdeface_command("export", bust_file, "-o", out, "--join", join, "--mesh", "30x30")
    assert smooth.read_bytes() != patchwise.read_bytes()


def test_info_shows_what_the_face_is_made_of(pdeface_command, bust_file) -> None:
    outcome = pdeface_command("info", bust_file)
    assert outcome.status == 0
    for words in ("7 of 16 points", "160 mm wide", "200 mm high", "12 x 8 RGB", "CC0", "a = 1"):
        assert words in outcome.out.replace("\n", " ")


def test_info_as_json(pdeface_command, bust_file, bust) -> None:
    facts = json.loads(pdeface_command("info", bust_file, "--json").out)
    assert (facts["curves"], facts["points"]) == bust.curves.shape
    assert facts["texture"]["width"] == bust.texture.shape[1]
    assert facts["bytes"] == bust_file.stat().st_size
    np.testing.assert_allclose(facts["size_mm"], [160.0, 200.0, 80.0], atol=2.0)


def test_markup_in_a_name_is_shown_as_it_is(pdeface_command, bust, tmp_path) -> None:
    path = tmp_path / "x.pdeface"
    bust.with_name("[red]Ada[/red] [/x]").save(path)
    assert "[red]Ada[/red] [/x]" in pdeface_command("info", path).out


def test_render_draws_a_picture_of_the_size_asked_for(pdeface_command, bust_file) -> None:
    out = bust_file.with_name("out.png")
    for look in (["--view", "-35"], ["--style", "curves", "--loops"], ["--view", "profile"]):
        outcome = pdeface_command("render", bust_file, "-o", out, "--size", "90x120", *look)
        assert (outcome.status, outcome.err) == (0, "")
        assert png_size(out) == (90, 120)
        out.unlink()


def test_a_picture_shows_the_face(pdeface_command, bust_file) -> None:
    from PIL import Image

    out = bust_file.with_name("out.png")
    pdeface_command("render", bust_file, "-o", out, "--size", "90x120", "--transparent")
    alpha = np.asarray(Image.open(out))[..., 3]
    assert alpha[60, 45] == 255
    assert alpha[0, 0] == 0


def test_make_without_a_photo_is_the_bundled_portrait(pdeface_command, tmp_path) -> None:
    outs = [tmp_path / "a.pdeface", tmp_path / "a.glb"]
    words = [word for out in outs for word in ("-o", out)]
    outcome = pdeface_command("make", *words, "--level", "28x46", "--mesh", "28x41")
    assert (outcome.status, outcome.err) == (0, "")
    face = pdeface.load(outs[0])
    shape = fit_shape(portrait_face())
    assert face.curves == shape.face.curves
    assert face.weights == shape.identity
    assert face.texture is not None
    assert glb_json(outs[1])["images"]


def test_make_of_a_photo_with_points(pdeface_command, tmp_path) -> None:
    image, points = portrait()
    write_image(image, tmp_path / "ada.png")
    points.save(tmp_path / "ada.json")
    out = tmp_path / "ada.pdeface"
    outcome = pdeface_command(
        "make", tmp_path / "ada.png", "--points", tmp_path / "ada.json", "-o", out
    )
    assert (outcome.status, outcome.err) == (0, "")
    face = pdeface.load(out)
    assert face.name == "ada"
    np.testing.assert_array_equal(face.texture, uv_texture(image, points).image)


def test_make_draws_a_sheet_of_pictures(pdeface_command, tmp_path) -> None:
    out = tmp_path / "sheet.png"
    assert pdeface_command("make", "--level", "28x46", "-o", out).status == 0
    height, width = png_size(out)[::-1]
    assert width > height > 1000


def test_a_photo_with_a_point_outside_names_the_point(pdeface_command, tmp_path) -> None:
    image, points = portrait()
    write_image(image, tmp_path / "ada.png")
    moved = FeaturePoints({**points.positions, "nose_tip": (999.0, 1.0)}, points.image_size)
    moved.save(tmp_path / "ada.json")
    outcome = pdeface_command("make", tmp_path / "ada.png", "--points", tmp_path / "ada.json",
                              "-o", tmp_path / "ada.glb")  # fmt: skip
    assert outcome.status == 2
    assert "nose_tip" in outcome.err
