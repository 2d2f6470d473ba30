"""The model's file is taken from where it is, or fetched once and checked."""

from __future__ import annotations

import hashlib
import threading
from collections.abc import Iterator
from functools import partial
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path

import pytest

from pdeface.errors import InputError
from pdeface.photo import model as room
from pdeface.photo import model_file

CONTENT = b"a model" * 50_000


class Quiet(SimpleHTTPRequestHandler):
    def log_message(self, *words: object) -> None:
        pass


@pytest.fixture
def cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """An empty folder for what is fetched, and nothing named by the environment."""
    pytest.importorskip("pooch", reason="needs the extra 'photo'")
    monkeypatch.setattr("pooch.os_cache", lambda name: tmp_path / "cache" / name)
    monkeypatch.delenv(room.VARIABLE, raising=False)
    return tmp_path / "cache" / "pdeface" / room.NAME


@pytest.fixture
def publisher(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """A server on this machine, which publishes ``CONTENT``; its file."""
    folder = tmp_path / "published"
    folder.mkdir()
    (folder / room.NAME).write_bytes(CONTENT)
    server = ThreadingHTTPServer(("127.0.0.1", 0), partial(Quiet, directory=str(folder)))
    threading.Thread(target=server.serve_forever, daemon=True).start()
    monkeypatch.setattr(room, "URL", f"http://127.0.0.1:{server.server_port}/{room.NAME}")
    monkeypatch.setattr(room, "SHA256", hashlib.sha256(CONTENT).hexdigest())
    yield folder / room.NAME
    server.shutdown()
    server.server_close()


def test_the_one_named_is_taken(tmp_path, monkeypatch) -> None:
    first, second = tmp_path / "a.task", tmp_path / "b.task"
    first.touch()
    second.touch()
    monkeypatch.setenv(room.VARIABLE, str(first))
    assert model_file() == first
    assert model_file(second) == second


def test_a_name_of_nothing_is_refused_with_where_it_came_from(tmp_path, monkeypatch) -> None:
    with pytest.raises(InputError, match="--model .* no file at .*nowhere"):
        model_file(tmp_path / "nowhere")
    monkeypatch.setenv(room.VARIABLE, str(tmp_path))
    with pytest.raises(InputError, match=room.VARIABLE):
        model_file()


def test_it_is_fetched_once(cache, publisher) -> None:
    steps: list[tuple[int, int]] = []
    assert model_file(progress=lambda done, total: steps.append((done, total))) == cache
    assert cache.read_bytes() == CONTENT
    assert max(steps) == (len(CONTENT), len(CONTENT))
    publisher.unlink()
    assert model_file() == cache


def test_a_damaged_copy_is_fetched_anew(cache, publisher) -> None:
    cache.parent.mkdir(parents=True)
    cache.write_bytes(b"half a mod")
    assert model_file().read_bytes() == CONTENT


def test_what_is_not_the_model_is_not_kept(cache, publisher) -> None:
    publisher.write_bytes(b"something else")
    with pytest.raises(InputError, match="damaged"):
        model_file()
    assert not cache.exists()


def test_offline_it_says_what_to_fetch_and_where_to_put_it(cache, monkeypatch) -> None:
    monkeypatch.setattr(room, "URL", "http://127.0.0.1:1/" + room.NAME)
    with pytest.raises(InputError) as caught:
        model_file()
    message = str(caught.value)
    assert "\n" not in message
    assert all(word in message for word in (room.URL, str(cache), "--model", room.VARIABLE))


def test_the_copy_that_the_tests_use_is_the_published_one(shared_data) -> None:
    path = shared_data / "models" / room.NAME
    if not path.is_file():
        pytest.skip(f"no {room.NAME} in {path.parent}")
    assert hashlib.sha256(path.read_bytes()).hexdigest() == room.SHA256
