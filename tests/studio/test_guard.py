"""Strangers are refused, and the page is kept to itself."""

from __future__ import annotations

import pytest
from starlette.testclient import TestClient
from starlette.websockets import WebSocketDisconnect

from pdeface.studio.server import application

HOME = "http://127.0.0.1:8640"
SOCKET = "ws://127.0.0.1:8640/api/jobs"


ELSEWHERE = [
    *("evil.example", "evil.example:8640", "127.0.0.1.evil.example:8640"),
    *("127.0.0.1:9", "127.0.0.1", ""),
]


@pytest.mark.parametrize("host", ELSEWHERE)
def test_another_host_is_refused(client, host: str) -> None:
    """A name that was rebound to this machine's address is not this machine's."""
    answer = client.get("/api/first", headers={"Host": host})
    assert answer.status_code == 403


@pytest.mark.parametrize("host", ["127.0.0.1:8640", "localhost:8640", "[::1]:8640"])
def test_this_machine_s_names_are_served(client, host: str) -> None:
    headers = {"Host": host, "Origin": f"http://{host}"}
    assert client.get("/api/first", headers=headers).status_code == 200


@pytest.mark.parametrize(
    "origin", ["http://evil.example", "null", "http://127.0.0.1:9", f"{HOME}0"]
)
def test_another_origin_is_refused(client, visitor, origin: str) -> None:
    for path in ("/", "/api/first"):
        assert client.get(path, headers={"Origin": origin}).status_code == 403
    answer = client.post(visitor.path("save"), headers={"Origin": origin}, json={})
    assert answer.status_code == 403


def test_nothing_is_started_without_an_origin(face, pages) -> None:
    with TestClient(application(face, pages, "127.0.0.1", 8640), base_url=HOME) as bare:
        assert bare.get("/api/first").status_code == 200
        assert bare.post("/api/open", content=b"PK\x03\x04").status_code == 403


def test_another_site_may_not_read_what_it_embeds(client) -> None:
    answer = client.get("/api/first", headers={"Sec-Fetch-Site": "cross-site"})
    assert answer.status_code == 403


def test_the_websocket_is_served(client) -> None:
    with client.websocket_connect(SOCKET):
        pass


@pytest.mark.parametrize("headers", [{"Origin": "http://evil.example"}, {"Host": "evil.example"}])
def test_the_websocket_is_guarded_too(client, headers) -> None:
    with (
        pytest.raises(WebSocketDisconnect) as refusal,
        client.websocket_connect(SOCKET, headers=headers),
    ):
        pass
    assert refusal.value.code == 1008


def test_the_websocket_needs_an_origin(face, pages) -> None:
    with (
        TestClient(application(face, pages, "127.0.0.1", 8640), base_url=HOME) as bare,
        pytest.raises(WebSocketDisconnect),
        bare.websocket_connect(SOCKET),
    ):
        pass


def test_every_answer_keeps_the_page_to_itself(client) -> None:
    for path in ("/", "/api/first", "/nowhere"):
        headers = client.get(path).headers
        policy = headers["content-security-policy"]
        assert "default-src 'none'" in policy
        assert "unsafe" not in policy.replace("'wasm-unsafe-eval'", "")
        assert "*" not in policy
        assert "http" not in policy
        assert headers["x-content-type-options"] == "nosniff"
        assert "script-src 'self' 'wasm-unsafe-eval';" in policy
        assert headers["referrer-policy"] == "no-referrer"


@pytest.mark.parametrize(
    "path",
    ["/../secret.txt", "/%2e%2e/secret.txt", "/..%2fsecret.txt", "//etc/passwd", "/%2fetc%2fpasswd",
     "/assets/..%5c..%5csecret.txt"],
)  # fmt: skip
def test_no_path_leads_out_of_the_page_s_folder(client, path: str) -> None:
    answer = client.get(path)
    assert answer.status_code in (403, 404)
    assert "secret" not in answer.text
    assert "root:" not in answer.text


@pytest.mark.parametrize("name", ["..%2f..%2fetc%2fpasswd", "face.pdeface", "%00"])
def test_an_id_is_no_path(client, name: str) -> None:
    answer = client.get(f"/api/faces/{name}")
    assert answer.status_code in (404, 422)


def test_beyond_loopback_a_token_is_needed(face, pages) -> None:
    home = "http://192.0.2.7:8640"
    app = application(face, pages, "192.0.2.7", 8640, "token-of-the-test")
    with TestClient(app, base_url=home, headers={"Origin": home}) as visitor:
        assert visitor.get("/").status_code == 403
        assert visitor.get("/api/first").status_code == 403
        assert visitor.get("/?token=wrong").status_code == 403
        with (
            pytest.raises(WebSocketDisconnect),
            visitor.websocket_connect("ws://192.0.2.7:8640/api/jobs"),
        ):
            pass
        answer = visitor.get("/?token=token-of-the-test", follow_redirects=False)
        assert answer.status_code == 303
        assert "token" not in answer.headers["location"]
        assert "httponly" in answer.headers["set-cookie"].lower()
        assert "samesite=strict" in answer.headers["set-cookie"].lower()
        assert visitor.get("/").status_code == 200
        assert visitor.get("/api/first").status_code == 200
