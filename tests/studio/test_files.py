"""Files in and out: by content, limited, and readable by the library."""

from __future__ import annotations

import io
import json
import zipfile
from pathlib import Path

import numpy as np
import pytest

import pdeface
from pdeface.motion import clip, read, write
from pdeface.studio import requests


def saved(visitor, weights, folder: Path) -> pdeface.Face:
    path = folder / "saved.pdeface"
    path.write_bytes(visitor.post("save", name="Bea", weights=weights))
    return pdeface.load(path)


def test_a_saved_face_is_the_face(visitor, face, tmp_path) -> None:
    weights = {"jawOpen": 0.5, "noseWidth": -0.25}
    found = saved(visitor, weights, tmp_path)
    assert found.name == "Bea"
    assert dict(found.weights) == weights
    assert found.curves == face.curves
    assert np.array_equal(found.texture, face.texture)


def test_a_face_comes_back_as_it_was_saved(visitor, sent, tmp_path) -> None:
    saved(visitor, {"jawOpen": 0.5}, tmp_path)
    info = sent((tmp_path / "saved.pdeface").read_bytes()).json()["face"]
    assert info["id"] == visitor.face["id"]
    assert info["weights"] == {"jawOpen": 0.5}


@pytest.mark.parametrize("suffix", [".glb", ".vrm", ".obj", ".ply", ".stl", ".pdeface", ".png"])
def test_every_format_is_written(visitor, suffix: str) -> None:
    data = visitor.post(
        "export", name="Ada", weights={"noseWidth": 0.5}, format=suffix,
        expressions=False, visemes=False,
    )  # fmt: skip
    starts = {".glb": b"glTF", ".vrm": b"glTF", ".stl": b"pdeface", ".png": b"\x89PNG"}
    assert data.startswith(starts.get(suffix, b"PK"))
    beside = {".obj": {".mtl", ".png"}, ".ply": {".png"}}
    if suffix in beside:
        names = zipfile.ZipFile(io.BytesIO(data)).namelist()
        assert {Path(name).suffix for name in names} == {suffix, *beside[suffix]}


def test_targets_are_written_as_asked(visitor) -> None:
    def targets(**asked: bool) -> list[str]:
        data = visitor.post("export", name="Ada", weights={}, format=".glb", **asked)
        length = int.from_bytes(data[12:16], "little")
        mesh = json.loads(data[20 : 20 + length])["meshes"][0]
        return mesh.get("extras", {}).get("targetNames", [])

    assert targets(expressions=False, visemes=False) == []
    assert "jawOpen" in targets(expressions=True, visemes=False)
    assert "viseme_aa" in targets(expressions=False, visemes=True)


@pytest.mark.parametrize(
    ("value", "message"),
    [
        ({"format": ".exe"}, "a face is exported as"),
        ({"format": "../../x.glb"}, "a face is exported as"),
        ({"rows": 9000, "columns": 9000}, "use pdeface export"),
        ({"name": "x" * 999}, "at most 200 letters"),
        ({"name": 3}, "is a text"),
    ],
)
def test_an_export_that_cannot_be_is_refused(visitor, value, message: str) -> None:
    whole = {"name": "Ada", "weights": {}, "format": ".obj", **value}
    assert message in visitor.refused("export", **whole)


def test_a_file_is_what_its_content_is(sent) -> None:
    for data in (b"<html><script>alert(1)</script>", b"MZ\x90", b"GIF89a", b"%PDF-1.7"):
        answer = sent(data)
        assert answer.status_code == 422
        assert "got something else" in answer.json()["error"]
    assert sent(b"").status_code == 422


def test_damaged_files_are_refused_in_a_line(sent) -> None:
    for data in (b"PK\x03\x04 and so on", b"{ no track", b"Timecode,BlendshapeCount\n1,2,3"):
        answer = sent(data)
        assert answer.status_code == 422, answer.text
        assert "\n" not in answer.json()["error"]
        assert "pdeface-" not in answer.json()["error"]


def test_too_large_a_file_is_refused_before_it_is_read(sent, monkeypatch) -> None:
    monkeypatch.setattr(requests.body, "__defaults__", (1000,))
    answer = sent(b"PK\x03\x04" + bytes(2000))
    assert answer.status_code == 422
    assert "make it smaller" in answer.json()["error"]


def test_a_recording_is_a_clip(sent, tmp_path) -> None:
    write(clip("blink", 30), tmp_path / "blink.json")
    info = sent((tmp_path / "blink.json").read_bytes()).json()["clip"]
    assert info["times"][-1] == pytest.approx(1.0)
    closed = np.array(info["weights"])[:, info["names"].index("eyeBlinkLeft")]
    assert closed.max() == 1.0
    assert np.shape(info["head"]) == (len(info["times"]), 3)


def test_a_built_in_clip_is_told(client) -> None:
    info = client.get("/api/clips/talk").json()
    assert info["times"][-1] > 3
    assert client.get("/api/clips/sing").status_code == 422


def test_a_clip_is_kept_as_a_track(client, tmp_path) -> None:
    info = client.get("/api/clips/blink").json()
    path = tmp_path / "blink.json"
    path.write_bytes(client.post("/api/clips", json=info).content)
    track = read(path)
    assert np.allclose(track.weights_of(info["names"]), info["weights"])
    assert np.allclose(track.times, info["times"])


@pytest.mark.parametrize(
    "value",
    [{}, {"times": "long"}, {"times": [0, 1], "names": ["x"], "weights": [[1]], "head": 0}],
)
def test_what_is_no_clip_is_not_kept(client, value) -> None:
    answer = client.post("/api/clips", json=value)
    assert answer.status_code == 422
    assert "\n" not in answer.json()["error"]


def test_the_tracker_s_model_is_served(client, model, told_model) -> None:
    assert client.get("/api/tracker/model").content == model.read_bytes()


def test_a_model_that_is_not_there_is_told_of(client, monkeypatch, tmp_path) -> None:
    monkeypatch.setenv("PDEFACE_MODEL", str(tmp_path / "none.task"))
    assert "found no file" in client.get("/api/tracker/model").json()["error"]
