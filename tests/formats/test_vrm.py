"""VRM 1.0: what its specification demands, checked on the file, and the Khronos validator."""

from __future__ import annotations

import json
import struct
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import pdeface
from pdeface.controls.presets import VRM_PRESETS
from pdeface.curves import BoundaryCurves
from pdeface.errors import InputError
from pdeface.face import Face
from pdeface.formats import Animation

# Required bones and their parents, as humanoid.md of the specification has them.
LIMBS = {
    "UpperLeg": "hips", "LowerLeg": "UpperLeg", "Foot": "LowerLeg",
    "UpperArm": "spine", "LowerArm": "UpperArm", "Hand": "LowerArm",
}  # fmt: skip
EMOTIONS = {"happy", "angry", "sad", "relaxed", "surprised"}
VOWELS = {"aa", "ih", "ou", "ee", "oh"}
LIDS = {"blink", "blinkLeft", "blinkRight"}
GAZE = {"lookUp", "lookDown", "lookLeft", "lookRight"}
PRESETS = {*EMOTIONS, *VOWELS, *LIDS, *GAZE, "neutral"}
# Nothing but these may be said: the validator does not know VRM, and bones show nothing.
HARMLESS = {"UNSUPPORTED_EXTENSION", "NODE_EMPTY", "UNUSED_OBJECT"}


def required() -> dict[str, str | None]:
    bones: dict[str, str | None] = {"hips": None, "spine": "hips", "head": "spine"}
    for side in ("left", "right"):
        for name, parent in LIMBS.items():
            bones[side + name] = side + parent if parent in LIMBS else parent
    return bones


def document(path: Path) -> dict[str, Any]:
    data = path.read_bytes()
    (length,) = struct.unpack_from("<I", data, 12)
    return json.loads(data[20 : 20 + length])


def extension(path: Path) -> dict[str, Any]:
    return document(path)["extensions"]["VRMC_vrm"]


def nodes(path: Path) -> tuple[dict[int, int], dict[int, np.ndarray]]:
    """Parent and place in the model of each node by its index."""
    listed = document(path)["nodes"]
    parents = {child: i for i, node in enumerate(listed) for child in node.get("children", [])}

    def place(index: int) -> np.ndarray:
        own = np.array(listed[index].get("translation", [0.0, 0.0, 0.0]))
        return own + place(parents[index]) if index in parents else own

    return parents, {index: place(index) for index in range(len(listed))}


@pytest.fixture(scope="module")
def avatar(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("vrm") / "ada.vrm"
    face = pdeface.random(2).with_name("Ada")
    pdeface.export(face.with_notes({"author": "Bo", "copyright": "2024 Bo"}), path)
    return path


@pytest.mark.parametrize("texture", [False, True])
@pytest.mark.parametrize("expressions", [None, (), ("jawOpen",)], ids=["all", "none", "one"])
def test_the_validator_finds_no_fault(
    texture, expressions, quarters, tmp_path: Path, khronos
) -> None:
    face = pdeface.random(3).with_texture(quarters if texture else None)
    pdeface.export(face, tmp_path / "a.vrm", expressions=expressions, visemes=expressions is None)
    issues = khronos(tmp_path / "a.vrm")["issues"]
    assert issues["numErrors"] == issues["numWarnings"] == 0
    assert {message["code"] for message in issues["messages"]} <= HARMLESS


def test_every_bone_that_must_be_there_is_and_hangs_from_its_parent(avatar: Path) -> None:
    bones = {n: b["node"] for n, b in extension(avatar)["humanoid"]["humanBones"].items()}
    parents, _ = nodes(avatar)
    assert len(set(bones.values())) == len(bones)
    by_node = {index: name for name, index in bones.items()}

    def ancestors(index: int) -> list[str]:
        above = parents.get(index)
        return [] if above is None else [by_node.get(above, ""), *ancestors(above)]

    for name, parent in required().items():
        above = [each for each in ancestors(bones[name]) if each in required()]
        assert above[:1] == ([parent] if parent else []), name
    assert document(avatar)["nodes"][bones["hips"]]["name"] == "hips"
    assert all(
        set(n) <= {"name", "translation", "children", "mesh"} for n in document(avatar)["nodes"]
    )


def test_it_stands_in_a_t_pose_on_the_ground(avatar: Path) -> None:
    bones = {n: b["node"] for n, b in extension(avatar)["humanoid"]["humanBones"].items()}
    _, at = nodes(avatar)
    arm = [at[bones[f"left{part}"]] for part in ("UpperArm", "LowerArm", "Hand")]
    assert arm[0][0] < arm[1][0] < arm[2][0], "+X is the subject's left"
    assert np.ptp([place[1:] for place in arm], axis=0).max() < 1e-9, "arms are level"
    leg = [at[bones[f"left{part}"]] for part in ("UpperLeg", "LowerLeg", "Foot")]
    assert leg[0][1] > leg[1][1] > leg[2][1] > 0.0
    for name in required():
        if name.startswith("left"):
            mirrored = at[bones[name.replace("left", "right")]] * [-1.0, 1.0, 1.0]
            np.testing.assert_allclose(at[bones[name]], mirrored, atol=1e-12)
    spine = [at[bones[name]][1] for name in ("hips", "spine", "neck", "head")]
    assert spine == sorted(spine)


def test_the_face_is_where_the_head_is_and_turns_with_it(avatar: Path) -> None:
    written, (parents, at) = document(avatar), nodes(avatar)
    (shown,) = (i for i, node in enumerate(written["nodes"]) if "mesh" in node)
    head = extension(avatar)["humanoid"]["humanBones"]["head"]["node"]
    assert parents[shown] == head
    offset = np.array(extension(avatar)["lookAt"]["offsetFromHeadBone"])
    eyes = at[head] + offset - at[shown]
    mesh = pdeface.random(2).mesh(109, 161).vertices
    assert np.linalg.norm(mesh - eyes, axis=1).min() < 0.03
    assert 0.0 < eyes[1] < 0.06
    assert 1.4 < at[shown][1] < 1.7, "as high as an adult's"


def test_presets_are_sums_of_targets_as_the_table_says(avatar: Path) -> None:
    written, told = document(avatar), extension(avatar)["expressions"]
    (mesh,) = written["meshes"]
    names = mesh["extras"]["targetNames"]
    assert set(told["preset"]) == PRESETS == set(VRM_PRESETS)
    for preset, expression in told["preset"].items():
        binds = expression.get("morphTargetBinds", [])
        assert all(written["nodes"][bind["node"]].get("mesh") == 0 for bind in binds)
        assert all(0.0 < bind["weight"] <= 1.0 for bind in binds)
        assert {names[b["index"]]: b["weight"] for b in binds} == dict(VRM_PRESETS[preset])
    assert [name for name, e in told["preset"].items() if "overrideBlink" in e] == ["relaxed"]


def test_every_target_is_a_custom_expression(avatar: Path) -> None:
    names = document(avatar)["meshes"][0]["extras"]["targetNames"]
    custom = extension(avatar)["expressions"]["custom"]
    assert list(custom) == names
    assert not set(custom) & PRESETS
    for index, expression in enumerate(custom.values()):
        (bind,) = expression["morphTargetBinds"]
        assert (bind["index"], bind["weight"]) == (index, 1.0)


def test_who_may_use_it_is_said(avatar: Path, tmp_path: Path) -> None:
    written = document(avatar)
    assert written["extensionsUsed"] == ["VRMC_vrm"]
    assert extension(avatar)["specVersion"] == "1.0"
    meta = extension(avatar)["meta"]
    assert meta["licenseUrl"] == "https://vrm.dev/licenses/1.0/"
    assert (meta["name"], meta["authors"]) == ("Ada", ["Bo"])
    assert meta["copyrightInformation"] == written["asset"]["copyright"] == "2024 Bo"
    assert meta["avatarPermission"] == "onlyAuthor"
    assert not any(value for key, value in meta.items() if key.startswith("allow"))
    pdeface.export(Face(pdeface.neutral().curves), tmp_path / "a.vrm", expressions=())
    meta = extension(tmp_path / "a.vrm")["meta"]
    assert (meta["name"], meta["authors"]) == ("face", ["unknown"])


def test_a_preset_is_whole_or_not_there(tmp_path: Path) -> None:
    chosen = ("eyeBlinkLeft", "mouthSmileLeft")
    pdeface.export(pdeface.neutral(), tmp_path / "a.vrm", expressions=chosen)
    told = extension(tmp_path / "a.vrm")["expressions"]
    assert set(told["preset"]) == {"blinkLeft", "neutral"}
    assert tuple(told["custom"]) == chosen


def test_curves_that_lie_on_no_lids_still_make_an_avatar(tmp_path: Path, khronos) -> None:
    face = Face(BoundaryCurves(pdeface.neutral().curves.points[:27]))
    pdeface.export(face, tmp_path / "a.vrm")
    assert set(extension(tmp_path / "a.vrm")["expressions"]["preset"]) == {"neutral"}
    assert khronos(tmp_path / "a.vrm")["issues"]["numErrors"] == 0


def test_avatars_play_no_animation(tmp_path: Path) -> None:
    animation = Animation("blink", [0.0, 1.0], {"eyeBlinkLeft": [0.0, 1.0]})
    with pytest.raises(InputError, match=r"written to \.glb and \.gltf, not to \.vrm"):
        pdeface.export(pdeface.neutral(), tmp_path / "a.vrm", animation=animation)
    assert list(tmp_path.iterdir()) == []
