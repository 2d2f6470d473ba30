"""``--set``, ``--expressions``, ``--random`` and the table of controls."""

from __future__ import annotations

import json
import struct
from pathlib import Path

import numpy as np
import pytest

import pdeface
from pdeface.controls import CONTROLS
from pdeface.controls.visemes import VISEMES

EXPRESSIONS = [c.name for c in CONTROLS.values() if c.kind == "expression"]


@pytest.fixture
def face_file(tmp_path: Path) -> Path:
    path = tmp_path / "someone.pdeface"
    pdeface.random(1).set(jawOpen=0.5, browInnerUp=0.25).save(path)
    return path


def mesh_of(path: Path) -> dict:
    data = path.read_bytes()
    length = struct.unpack("<I", data[12:16])[0]
    (mesh,) = json.loads(data[20 : 20 + length])["meshes"]
    return mesh


def weights_in(path: Path) -> dict[str, float]:
    """Default weights that are not 0."""
    mesh = mesh_of(path)
    named = zip(mesh["extras"]["targetNames"], mesh["weights"], strict=True)
    return {name: weight for name, weight in named if weight}


def test_set_changes_the_face_that_is_written(pdeface_command, face_file) -> None:
    outs = [face_file.with_name(name) for name in ("a.pdeface", "a.glb", "a.stl")]
    outcome = pdeface_command(
        "export", face_file, *(word for out in outs for word in ("-o", out)), "--mesh", "9x11",
        "--set", "jawOpen=1, identity02=-1.5", "--set", "eyeBlinkLeft=0.5,browInnerUp=0",
    )  # fmt: skip
    assert (outcome.status, outcome.err) == (0, "")
    truth = pdeface.random(1).set(jawOpen=1, identity02=-1.5, eyeBlinkLeft=0.5)
    assert pdeface.load(outs[0]).weights == truth.weights
    assert weights_in(outs[1]) == {"jawOpen": 1.0, "eyeBlinkLeft": 0.5}
    pdeface.export(truth, face_file.with_name("b.stl"), mesh=(9, 11))
    assert outs[2].read_bytes() == face_file.with_name("b.stl").read_bytes()


def test_the_last_value_counts(pdeface_command, face_file) -> None:
    out = face_file.with_name("a.pdeface")
    pdeface_command("export", face_file, "-o", out, "--set", "jawOpen=1", "--set", "jawOpen=0.1")
    assert pdeface.load(out).weights["jawOpen"] == 0.1


def test_clamp_brings_values_into_range(pdeface_command, face_file) -> None:
    out = face_file.with_name("a.pdeface")
    words = ["export", face_file, "-o", out, "--set", "jawOpen=7,identity01=-9"]
    assert pdeface_command(*words).status == 2
    assert not out.exists()
    assert pdeface_command(*words, "--clamp").status == 0
    weights = pdeface.load(out).weights
    assert (weights["jawOpen"], weights["identity01"]) == (1.0, -3.0)


@pytest.mark.parametrize(
    ("words", "names"),
    [
        ([], EXPRESSIONS),
        (["--expressions", "all"], EXPRESSIONS),
        (["--expressions", "none"], None),
        (["--expressions", "jawOpen, eyeBlinkLeft"], ["jawOpen", "eyeBlinkLeft"]),
    ],
)
def test_expressions_become_targets(pdeface_command, face_file, words, names) -> None:
    outs = [face_file.with_name(name) for name in ("a.glb", "a.obj")]
    outcome = pdeface_command(
        "export", face_file, "-o", outs[0], "-o", outs[1], "--mesh", "9x11", *words
    )
    assert (outcome.status, outcome.err) == (0, "")
    extras = mesh_of(outs[0]).get("extras")
    assert extras == (names and {"targetNames": names})


def test_an_expression_option_without_use_is_said_and_nothing_written(
    pdeface_command, face_file
) -> None:
    out = face_file.with_name("a.obj")
    outcome = pdeface_command("export", face_file, "-o", out, "--expressions", "jawOpen")
    assert outcome.status == 2
    assert ".glb or .gltf or .vrm" in outcome.err
    assert not out.exists()
    assert pdeface_command("export", face_file, "-o", out, "--expressions", "none").status == 0


def test_a_refusal_makes_no_folder(pdeface_command, face_file) -> None:
    for command in (["export", face_file], ["render", face_file], ["make"]):
        suffix = "png" if command[0] == "render" else "glb"
        out = face_file.parent / "new" / f"a.{suffix}"
        assert pdeface_command(*command, "-o", out, "--set", "jawOpn=1").status == 2
        assert not out.parent.exists()


def test_make_random_is_a_person_with_the_texture(pdeface_command, tmp_path) -> None:
    outs = [tmp_path / "a.pdeface", tmp_path / "a.glb"]
    words = [word for out in outs for word in ("-o", out)]
    outcome = pdeface_command(
        "make", *words, "--random", "7", "--set", "jawOpen=0.3", "--mesh", "9x11",
        "--expressions", "jawOpen",
    )  # fmt: skip
    assert (outcome.status, outcome.err) == (0, "")
    face = pdeface.load(outs[0])
    assert face.weights == pdeface.random(7).set(jawOpen=0.3).weights
    assert face.name == "random 7"
    assert face.texture is not None
    assert weights_in(outs[1]) == {"jawOpen": 0.3}


def test_render_shows_what_was_set(pdeface_command, face_file) -> None:
    from PIL import Image

    pictures = []
    for words in ([], ["--set", "jawOpen=1"], ["--set", "jawOpen=9", "--clamp"]):
        out = face_file.with_name("a.png")
        outcome = pdeface_command("render", face_file, "-o", out, "--size", "120x150", *words)
        assert (outcome.status, outcome.err) == (0, "")
        pictures.append(np.asarray(Image.open(out)).astype(int))
    assert np.abs(pictures[0] - pictures[1]).max() > 50
    np.testing.assert_array_equal(pictures[1], pictures[2])


def test_controls_are_a_table_one_line_each(pdeface_command, face_file) -> None:
    head, *rows = pdeface_command("controls").out.splitlines()
    assert head.split() == ["name", "group", "range", "value", "description"]
    assert [row.split()[0] for row in rows] == list(CONTROLS)
    assert {row.split()[3] for row in rows} == {"0"}
    (jaw,) = (r for r in pdeface_command("controls", face_file).out.splitlines() if "jawOpen" in r)
    assert jaw.split()[:4] == ["jawOpen", "jaw", "0..1", "0.5"]
    assert CONTROLS["jawOpen"].description in jaw


@pytest.mark.parametrize("kind", ["shape", "identity", "expression"])
def test_controls_of_one_kind(pdeface_command, kind) -> None:
    outcome = pdeface_command("controls", "--kind", kind)
    assert outcome.status == 0
    names = [row.split()[0] for row in outcome.out.splitlines()[1:]]
    assert names == [c.name for c in CONTROLS.values() if c.kind == kind]


def test_controls_as_json(pdeface_command, face_file) -> None:
    facts = json.loads(pdeface_command("controls", face_file, "--json").out)
    assert [fact["name"] for fact in facts] == list(CONTROLS)
    by_name = {fact["name"]: fact for fact in facts}
    assert by_name["browInnerUp"] == {
        "name": "browInnerUp", "group": "brows", "kind": "expression", "low": 0.0, "high": 1.0,
        "description": CONTROLS["browInnerUp"].description, "value": 0.25,
    }  # fmt: skip


def test_info_shows_the_controls_that_are_not_at_rest(pdeface_command, face_file) -> None:
    out = " ".join(pdeface_command("info", face_file).out.replace("│", " ").split())
    assert "jawOpen 0.5, browInnerUp 0.25" in out
    assert "identity01" in out
    assert "eyeBlinkLeft" not in out
    facts = json.loads(pdeface_command("info", face_file, "--json").out)
    assert facts["weights"] == dict(pdeface.load(face_file).weights)


@pytest.mark.parametrize("words", [["export", "FACE"], ["make"]], ids=lambda words: words[0])
def test_visemes_go_where_they_can(pdeface_command, face_file, words) -> None:
    outs = [face_file.with_name(name) for name in ("a.glb", "a.vrm", "a.stl")]
    words = [face_file if word == "FACE" else word for word in words]
    words += [word for out in outs for word in ("-o", out)]
    words += ["--mesh", "9x11", "--expressions", "jawOpen", "--visemes"]
    assert pdeface_command(*words).status == 0
    for out in outs[:2]:
        assert mesh_of(out)["extras"]["targetNames"] == ["jawOpen", *VISEMES]
    assert outs[2].exists()


def test_visemes_of_no_use_are_said(pdeface_command, face_file, bust_file) -> None:
    out = face_file.with_name("a.stl")
    outcome = pdeface_command("export", face_file, "-o", out, "--visemes")
    assert (outcome.status, out.exists()) == (2, False)
    assert "--visemes needs an output that ends in .glb or .gltf or .vrm" in outcome.err
    out = face_file.with_name("a.glb")
    outcome = pdeface_command("export", bust_file, "-o", out, "--visemes")
    assert (outcome.status, out.exists()) == (2, False)
    assert "27 n + 1 curves" in outcome.err
