"""Films: pictures in, one by one, an MP4 out."""

from __future__ import annotations

import numpy as np
import pytest

from pdeface.images import encode_png

pytestmark = pytest.mark.usefixtures("ffmpeg")


def begun(client, width: int = 64, height: int = 48, rate: float = 30.0) -> str:
    answer = client.post("/api/films", json={"width": width, "height": height, "rate": rate})
    assert answer.status_code == 200, answer.text
    return f"/api/films/{answer.json()['id']}"


def picture(width: int = 64, height: int = 48) -> bytes:
    return encode_png(np.full((height, width, 3), 90, np.uint8))


def test_pictures_become_a_film(client) -> None:
    path = begun(client)
    for _ in range(5):
        assert client.post(path, content=picture()).status_code == 200
    answer = client.post(f"{path}/end")
    assert answer.headers["content-type"] == "video/mp4"
    assert answer.content[4:8] == b"ftyp"
    assert "no such film" in client.post(f"{path}/end").json()["error"]


@pytest.mark.parametrize(
    ("value", "message"),
    [
        ({"width": 63}, "even"),
        ({"height": 100_000}, "even"),
        ({"width": "64"}, "even"),
        ({"rate": 0}, "frames a second"),
        ({"rate": "fast"}, "is a number"),
    ],
)
def test_a_film_that_cannot_be_is_refused(client, value, message: str) -> None:
    whole = {"width": 64, "height": 48, "rate": 30.0, **value}
    answer = client.post("/api/films", json=whole)
    assert answer.status_code == 422
    assert message in answer.json()["error"]


def test_pictures_of_another_size_or_film_are_refused(client) -> None:
    path = begun(client)
    assert "64 x 48" in client.post(path, content=picture(32, 32)).json()["error"]
    assert "cannot be read" in client.post(path, content=b"no picture").json()["error"]
    other = begun(client)
    assert "no such film" in client.post(path, content=picture()).json()["error"]
    assert "needs a picture" in client.post(f"{other}/end").json()["error"]
