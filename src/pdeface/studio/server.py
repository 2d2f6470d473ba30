"""The server: the routes together, guarded, at an address of this machine."""

from __future__ import annotations

import secrets
import socket
import sys
import threading
import webbrowser
from pathlib import Path

import uvicorn
from starlette.applications import Starlette
from starlette.middleware import Middleware
from starlette.routing import Mount
from starlette.staticfiles import StaticFiles

from pdeface.errors import InputError
from pdeface.face import Face
from pdeface.studio.assets import folder
from pdeface.studio.faces import face_routes
from pdeface.studio.films import Cutter, film_routes
from pdeface.studio.guard import Guard, is_loopback
from pdeface.studio.jobs import Jobs, job_routes
from pdeface.studio.memory import give_back_what_is_freed
from pdeface.studio.opening import open_routes
from pdeface.studio.photo_routes import photo_routes
from pdeface.studio.photos import PhotoDesk, Views
from pdeface.studio.scan_routes import scan_routes
from pdeface.studio.scans import ScanDesk
from pdeface.studio.store import FaceStore
from pdeface.studio.tracker import tracker_routes

__all__ = ["application", "serve"]

_FIRST_PORT, _PORTS = 8640, 20
_BACKLOG = 128


def application(
    face: Face,
    pages: Path,
    host: str,
    port: int,
    token: str | None = None,
    model: str | None = None,
    photos: Views = (),
) -> Starlette:
    """The studio as an ASGI application.

    Args:
        face: with which it begins.
        pages: the folder of the built page.
        host, port: where it is served.
        token: what a visitor must know, or None.
        model: MediaPipe's model file, or None for the usual one.
        photos: of which the face was made, if it was.
    """
    store, jobs = FaceStore(), Jobs()
    desk, scans = PhotoDesk(store, model, photos), ScanDesk(store, model)
    routes = [
        *face_routes(store, store.put(face)),
        *open_routes(store, desk, scans, jobs),
        *photo_routes(desk, store, jobs),
        *scan_routes(scans, store),
        *film_routes(Cutter()),
        *tracker_routes(model),
        *job_routes(jobs),
        Mount("/", StaticFiles(directory=pages, html=True)),
    ]
    guard = Middleware(Guard, host=host, port=port, token=token)
    return Starlette(routes=routes, middleware=[guard])


def serve(face: Face, *, host: str = "127.0.0.1", port: int | None = None, browser: bool = True,
          model: str | None = None, photos: Views = ()) -> None:  # fmt: skip
    """Serve the studio until it is interrupted, and open a browser on it.

    Args:
        face: with which it begins.
        host: address to listen at; any but loopback's needs the random token in the printed URL.
        port: port to listen at; None for the first free one from 8640 on.
        browser: whether to open the page.
        model: MediaPipe's model file, or None for the usual one.
        photos: of which the face was made, if it was.

    Raises:
        InputError: the port is taken, or the address is not this machine's.
        PDEFaceError: the page has not been built.
    """
    give_back_what_is_freed()
    pages = folder()
    listener = _listener(host, port)
    number = int(listener.getsockname()[1])
    token = None if is_loopback(host) else secrets.token_urlsafe(24)
    app = application(face, pages, host, number, token, model, photos)
    shown = f"[{host}]" if ":" in host else host
    url = f"http://{shown}:{number}/" + (f"?token={token}" if token else "")
    sys.stdout.write(f"studio at {url} (Ctrl+C ends it)\n")
    sys.stdout.flush()
    if browser:
        threading.Timer(0.3, webbrowser.open, [url]).start()
    config = uvicorn.Config(
        app, log_level="warning", access_log=False, server_header=False, ws_max_size=1 << 16
    )
    uvicorn.Server(config).run(sockets=[listener])


def _listener(host: str, port: int | None) -> socket.socket:
    """A socket that is bound already: the port that is printed is the port that is served."""
    tried = range(_FIRST_PORT, _FIRST_PORT + _PORTS) if port is None else [port]
    family = socket.AF_INET6 if ":" in host else socket.AF_INET
    reason = "no such address or port"
    for number in tried:
        listener = socket.socket(family, socket.SOCK_STREAM)
        listener.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            listener.bind((host, number))
            # Who reads the address and comes at once waits, rather than be turned away.
            listener.listen(_BACKLOG)
            return listener
        except (OSError, OverflowError) as error:
            listener.close()
            reason = getattr(error, "strerror", None) or str(error)
    raise InputError(
        f"cannot serve at {host}, port {tried[0]} ({reason}); choose another with --port"
    )
