"""Photos: faces found in them, one person of several, both ways to a texture."""

from __future__ import annotations

import io
import json

import numpy as np
import pytest
from PIL import Image

from pdeface.images import encode_png
from pdeface.texture import portrait


@pytest.fixture
def first(client):
    """The bundled portrait, as the page hears of it, and its points by name."""
    photo = client.get("/api/photos/first").json()["photos"][0]
    return photo, {point["name"]: [point["x"], point["y"]] for point in photo["points"]}


def pixels(data: bytes) -> np.ndarray:
    return np.asarray(Image.open(io.BytesIO(data)).convert("RGB"), dtype=int)


def test_the_portrait_has_its_points_its_mesh_and_its_camera(first) -> None:
    photo, points = first
    assert len(points) >= 25
    mesh = np.reshape(photo["mesh"], (7, 7, 2))
    assert np.allclose(mesh[3, 3], points["nose_tip"], atol=0.02)
    assert (np.diff(mesh[..., 0], axis=1) > 0).all()
    assert (np.diff(mesh[..., 1], axis=0) > 0).all()
    turn = np.reshape(photo["camera"]["rotation"], (3, 3))
    assert np.allclose(turn @ turn.T, np.eye(3), atol=1e-6)
    assert photo["expression"]["mouthSmileLeft"] > 0.3


def test_the_mesh_follows_a_point(client, first) -> None:
    photo, points = first
    x, y = points["nose_tip"]
    moved = {"points": {**points, "nose_tip": [x + 2.0, y]}}
    mesh = client.post(f"/api/photos/{photo['id']}/mesh", json=moved).json()["mesh"]
    away = np.abs(np.subtract(mesh, photo["mesh"])).reshape(7, 7, 2)
    assert away[3, 3, 0] == pytest.approx(2.0, abs=0.02)
    assert away[1:-1, 1:-1].sum() == pytest.approx(2.0, abs=0.5)


def test_both_ways_make_a_texture_of_a_photo(client, visitor, first) -> None:
    photo, points = first
    asked = {"photos": [photo["id"]], "points": points}
    made = {}
    for way in ("project", "warp"):
        answer = client.post("/api/photos/texture", json={**asked, "way": way})
        made[way] = pixels(answer.content)
        assert made[way].shape == (256, 256, 3)
        face = {**asked, "way": way, "face": visitor.face["id"]}
        made[f"{way} face"] = client.post("/api/photos/apply", json=face).json()
    assert np.abs(made["project"] - made["warp"]).mean() > 2
    ids = {made["project face"]["texture"], made["warp face"]["texture"]}
    assert len(ids | {visitor.face["texture"]}) == 3


@pytest.mark.parametrize(
    ("value", "message"),
    [
        ({"way": "paint"}, "'project' or by 'warp'"),
        ({"photos": []}, "photos are 1 to"),
        ({"photos": ["0123456789abcdef"]}, "knows no"),
        ({"way": "warp", "points": None}, "reload the page"),
        ({"way": "warp", "points": {"nose_tip": [5.0, 5.0]}}, "points"),
    ],
)
def test_a_texture_that_cannot_be_is_refused(client, first, value, message: str) -> None:
    photo, points = first
    asked = {"photos": [photo["id"]], "points": points, "way": "project", **value}
    answer = client.post("/api/photos/texture", json=asked)
    assert answer.status_code == 422
    assert message in answer.json()["error"]


def test_a_photo_without_a_face_fails_with_a_line(finished, sent, told_model) -> None:
    job = sent(encode_png(np.full((64, 64, 3), 128, np.uint8))).json()["job"]
    assert "no face was found" in finished(job["id"], "failed")["message"]


def test_a_photo_becomes_a_face(client, finished, sent, told_model) -> None:
    job = sent(encode_png(portrait()[0])).json()["job"]
    done = finished(job["id"], "done")
    assert done["face"]["texture"]
    assert done["face"]["weights"]
    (photo,) = done["photos"]
    points = {point["name"]: [point["x"], point["y"]] for point in photo["points"]}
    path = f"/api/photos/{photo['id']}"
    assert client.get(path).headers["content-type"].startswith("image/")
    kept = json.loads(client.post(f"{path}/points", json={"points": points}).content)
    assert kept["format"] == "pdeface-points"
    assert kept["points"]["nose_tip"] == pytest.approx(points["nose_tip"], abs=0.01)
    wrong = {name: [5.0, 5.0] for name in points}
    asked = {"photos": [photo["id"]], "points": wrong, "way": "warp"}
    assert client.post("/api/photos/texture", json=asked).status_code == 422


def test_several_photos_are_of_one_person(client, finished, told_model) -> None:
    photo = portrait()[0]
    sides = [photo, np.ascontiguousarray(photo[:, ::-1])]
    keys = [client.post("/api/photos", content=encode_png(s)).json()["id"] for s in sides]
    job = client.post("/api/photos/person", json={"photos": keys}).json()["job"]
    done = finished(job["id"], "done")
    assert {each["id"] for each in done["photos"]} == set(keys)
    yaws = [np.reshape(each["camera"]["rotation"], (3, 3))[0, 2] for each in done["photos"]]
    assert yaws[0] * yaws[1] < 0

    def texture(*ids: str) -> np.ndarray:
        asked = {"photos": ids, "way": "project"}
        return pixels(client.post("/api/photos/texture", json=asked).content)

    both = texture(*keys)
    assert np.array_equal(both, texture(*reversed(keys)))
    first = client.get("/api/photos/first").json()["photos"][0]["id"]
    assert np.abs(both - texture(first)).mean() > 2


def test_a_photo_among_others_without_a_face_is_named(client, finished, told_model) -> None:
    blank = np.full((64, 64, 3), 128, np.uint8)
    photos = [portrait()[0], blank]
    keys = [client.post("/api/photos", content=encode_png(p)).json()["id"] for p in photos]
    job = client.post("/api/photos/person", json={"photos": keys}).json()["job"]
    assert "photo 2 of 2" in finished(job["id"], "failed")["message"]


def test_a_picture_of_too_many_pixels_is_refused(finished, sent, monkeypatch) -> None:
    monkeypatch.setattr("pdeface.studio.photo_reading.MOST_PIXELS", 100)
    job = sent(encode_png(np.zeros((64, 64, 3), np.uint8))).json()["job"]
    assert "make it smaller" in finished(job["id"], "failed")["message"]
