"""Films of what the stage shows: its pictures come one by one, and leave as an MP4."""

from __future__ import annotations

import secrets
import threading
from collections.abc import Mapping
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Any

from starlette.concurrency import run_in_threadpool
from starlette.requests import Request
from starlette.responses import JSONResponse, Response
from starlette.routing import BaseRoute, Route

from pdeface.errors import InputError
from pdeface.studio.photo_reading import pixels_of
from pdeface.studio.requests import answered, body, json_body

if TYPE_CHECKING:
    from pdeface.pictures.encoder import Encoder

__all__ = ["Cutter", "film_routes"]

MOST_FRAMES = 20_000
_SMALLEST, _LARGEST = 16, 3840
_FRAME_BYTES = 24 << 20


class Film:
    """A film that is being written."""

    def __init__(self, size: tuple[int, int], rate: float) -> None:
        from pdeface.pictures.encoder import Encoder

        self.size, self._folder = size, TemporaryDirectory(prefix="pdeface-")
        self.path = Path(self._folder.name) / "film.mp4"
        try:
            self._encoder: Encoder = Encoder(self.path, size, rate).__enter__()
        except BaseException:
            self._folder.cleanup()
            raise
        self.frames = 0

    def add(self, data: bytes) -> None:
        """Add a picture."""
        pixels = pixels_of(data)
        if pixels.shape[1::-1] != self.size:
            raise InputError(
                f"a picture of this film has {self.size[0]} x {self.size[1]} pixels, got "
                f"{pixels.shape[1]} x {pixels.shape[0]}; begin the film anew"
            )
        if self.frames >= MOST_FRAMES:
            raise InputError(f"a film has at most {MOST_FRAMES:,} pictures here; cut the motion")
        self.frames += 1
        self._encoder.add(pixels, self.frames)

    def finished(self) -> bytes:
        """The bytes of the film, which is over."""
        with self._folder:
            self._encoder.__exit__(None, None, None)
            return self.path.read_bytes()

    def dropped(self) -> None:
        """Forget it."""
        with self._folder:
            error = InputError("the film was given up")
            self._encoder.__exit__(InputError, error, None)


class Cutter:
    """The film that is being written, one at a time: another one takes its place."""

    def __init__(self) -> None:
        self._film: Film | None = None
        self._key = ""
        self._lock = threading.Lock()

    def begin(self, value: Mapping[str, Any]) -> str:
        """Begin a film of ``width``, ``height`` and ``rate``, and say its id.

        Raises:
            InputError: such a film cannot be.
            MissingExtraError: imageio-ffmpeg is not installed.
        """
        width, height, rate = (value.get(name) for name in ("width", "height", "rate"))
        if not all(
            isinstance(side, int) and _SMALLEST <= side <= _LARGEST and side % 2 == 0
            for side in (width, height)
        ):
            raise InputError(
                f"a film's width and height are even, {_SMALLEST} to {_LARGEST}, got {width!r} x "
                f"{height!r}; choose others"
            )
        if not isinstance(rate, int | float) or isinstance(rate, bool):
            raise InputError(f"a film's rate is a number, got {rate!r}; try 30")
        with self._lock:
            self._forget()
            self._film = Film((int(str(width)), int(str(height))), float(rate))
            self._key = secrets.token_hex(8)
            return self._key

    def add(self, key: str, data: bytes) -> None:
        """Add a picture, PNG or JPEG, to the film.

        Raises:
            InputError: no such film any more, or no such picture.
        """
        with self._lock:
            self._of(key).add(data)

    def finish(self, key: str) -> bytes:
        """The bytes of the film.

        Raises:
            InputError: no such film any more, or no picture in it.
        """
        with self._lock:
            film = self._of(key)
            if not film.frames:
                raise InputError("a film needs a picture at least, got none; begin it anew")
            self._film = None
            return film.finished()

    def _of(self, key: str) -> Film:
        if self._film is None or not secrets.compare_digest(key, self._key):
            raise InputError("the server knows no such film (any more); begin it anew")
        return self._film

    def _forget(self) -> None:
        film, self._film = self._film, None
        if film is not None:
            film.dropped()


class FilmRoutes:
    """The endpoints of films."""

    def __init__(self, cutter: Cutter) -> None:
        self._cutter = cutter

    async def begin(self, request: Request) -> Response:
        """A film begins: its id."""
        key = await run_in_threadpool(self._cutter.begin, await json_body(request))
        return JSONResponse({"id": key})

    async def add(self, request: Request) -> Response:
        """A picture for it."""
        data = await body(request, _FRAME_BYTES)
        await run_in_threadpool(self._cutter.add, request.path_params["id"], data)
        return JSONResponse({})

    async def finish(self, request: Request) -> Response:
        """The film itself."""
        data = await run_in_threadpool(self._cutter.finish, request.path_params["id"])
        return Response(data, media_type="video/mp4")


def film_routes(cutter: Cutter) -> list[BaseRoute]:
    """The routes of films."""
    routes = FilmRoutes(cutter)
    return [
        Route("/api/films", answered(routes.begin), methods=["POST"]),
        Route("/api/films/{id}", answered(routes.add), methods=["POST"]),
        Route("/api/films/{id}/end", answered(routes.finish), methods=["POST"]),
    ]
