"""``pdeface studio``: what it says before there is a page."""

from __future__ import annotations

import socket

import pytest

import pdeface
from pdeface.__main__ import main
from pdeface.errors import InputError
from pdeface.studio import assets, server
from pdeface.studio.guard import is_loopback


def test_without_its_page_it_says_in_a_line_how_to_build_it(monkeypatch, tmp_path, capsys) -> None:
    monkeypatch.setattr(assets, "_BUILT", tmp_path)
    assert main(["studio", "--no-browser"]) == 1
    told = capsys.readouterr().err
    assert told.count("\n") == 1
    assert "npm run build --prefix client" in told


def test_a_port_that_is_taken_is_named(monkeypatch, pages) -> None:
    monkeypatch.setattr(assets, "_BUILT", pages)
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        taken.listen()
        port = taken.getsockname()[1]
        with pytest.raises(InputError, match=rf"port {port} .*--port"):
            server.serve(pdeface.neutral(), port=port, browser=False)


def test_an_address_that_is_not_this_machine_s_is_named(monkeypatch, pages) -> None:
    monkeypatch.setattr(assets, "_BUILT", pages)
    with pytest.raises(InputError, match=r"192\.0\.2\.1"):
        server.serve(pdeface.neutral(), host="192.0.2.1", browser=False)


@pytest.mark.parametrize(
    ("host", "loopback"),
    [
        ("127.0.0.1", True),
        ("127.9.9.9", True),
        ("::1", True),
        ("localhost", True),
        ("0.0.0.0", False),
        ("192.168.1.5", False),
        ("127.evil.example", False),
    ],
)
def test_what_counts_as_this_machine(host: str, loopback: bool) -> None:
    assert is_loopback(host) is loopback
