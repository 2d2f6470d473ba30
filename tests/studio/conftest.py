"""A studio whose server is asked directly, without a browser."""

from __future__ import annotations

import json
import struct
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from starlette.testclient import TestClient

import pdeface
from pdeface import Face
from pdeface.studio.server import application

HOST, PORT = "127.0.0.1", 8640
HOME = f"http://{HOST}:{PORT}"
SIZE = {"rows": 28, "columns": 41}

Arrays = dict[str, np.ndarray]


def unpacked(data: bytes) -> Arrays:
    """The arrays of a packet, read as its description says."""
    (length,) = struct.unpack_from("<I", data)
    header = json.loads(data[4 : 4 + length])
    types = {"float32": "<f4", "int32": "<i4"}
    return {
        info["name"]: np.frombuffer(
            data, types[info["type"]], int(np.prod(info["shape"])), 4 + length + info["offset"]
        ).reshape(info["shape"])
        for info in header["arrays"]
    }


class Visitor:
    """The page, as the server sees it."""

    def __init__(self, client: TestClient) -> None:
        self.client = client
        self.face: dict[str, Any] = client.get("/api/first").json()

    def path(self, what: str) -> str:
        return f"/api/faces/{self.face['id']}/{what}"

    def get(self, what: str) -> bytes:
        answer = self.client.get(self.path(what), params=SIZE)
        assert answer.status_code == 200, answer.text
        return answer.content

    def post(self, what: str, **value: Any) -> Any:
        answer = self.client.post(self.path(what), json={**SIZE, **value})
        assert answer.status_code == 200, answer.text
        kind = answer.headers["content-type"]
        return answer.json() if kind == "application/json" else answer.content

    def refused(self, what: str, **value: Any) -> str:
        answer = self.client.post(self.path(what), json={**SIZE, **value})
        assert answer.status_code == 422, answer.text
        message = answer.json()["error"]
        assert "\n" not in message
        return message


@pytest.fixture(scope="session")
def pages(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A page that stands for the built one."""
    folder = tmp_path_factory.mktemp("pages")
    (folder / "index.html").write_text("<!doctype html><title>studio</title>", encoding="utf-8")
    (folder.parent / "secret.txt").write_text("secret", encoding="utf-8")
    return folder


@pytest.fixture(scope="session")
def face() -> Face:
    """Someone with a texture."""
    texture = np.full((32, 32, 3), (200, 150, 120), np.uint8)
    return pdeface.neutral().with_name("Ada").set(noseLength=0.25).with_texture(texture)


@pytest.fixture(scope="session")
def client(face: Face, pages: Path) -> Iterator[TestClient]:
    """The page's requests, with the headers that a browser sends."""
    app = application(face, pages, HOST, PORT)
    with TestClient(app, base_url=HOME, headers={"Origin": HOME}) as client:
        yield client


@pytest.fixture(scope="session")
def visitor(client: TestClient) -> Visitor:
    return Visitor(client)


@pytest.fixture(scope="session")
def unpack() -> Callable[[bytes], Arrays]:
    """Reads a packet."""
    return unpacked


@pytest.fixture
def sent(client: TestClient) -> Callable[[bytes], Any]:
    """The server's answer to a file."""
    return lambda data: client.post("/api/open", content=data)


@pytest.fixture
def finished(client: TestClient) -> Callable[[str, str], dict[str, Any]]:
    """What the websocket tells of a job in the end."""

    def waited(job: str, state: str) -> dict[str, Any]:
        with client.websocket_connect("ws://127.0.0.1:8640/api/jobs") as socket:
            while True:
                message = socket.receive()
                if "text" not in message:  # what the job shows meanwhile
                    continue
                told = json.loads(message["text"])
                if told["id"] == job and told["state"] != "running":
                    assert told["state"] == state, told["message"]
                    return told

    return waited


@pytest.fixture
def told_model(model: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """MediaPipe's model, where the server looks for it."""
    monkeypatch.setenv("PDEFACE_MODEL", str(model))
