"""The endpoints of photos."""

from __future__ import annotations

from dataclasses import replace
from functools import partial
from typing import Any

from starlette.concurrency import run_in_threadpool
from starlette.requests import Request
from starlette.responses import JSONResponse, Response
from starlette.routing import BaseRoute, Route

from pdeface.errors import InputError
from pdeface.studio.jobs import Jobs
from pdeface.studio.photos import MOST_PHOTOS, PhotoDesk
from pdeface.studio.requests import answered, as_json, body, json_body
from pdeface.studio.schema import Opened, PhotosInfo
from pdeface.studio.store import FaceStore

__all__ = ["photo_routes"]

_LIVE = 256


class PhotoRoutes:
    """The endpoints, over the photos on the desk."""

    def __init__(self, desk: PhotoDesk, store: FaceStore, jobs: Jobs) -> None:
        self._desk, self._store, self._jobs = desk, store, jobs

    async def add(self, request: Request) -> Response:
        """A photo beside others: its id."""
        return JSONResponse({"id": await run_in_threadpool(self._desk.add, await body(request))})

    async def person(self, request: Request) -> Response:
        """A job that makes the face of the person in some photos."""
        keys = _keys(await json_body(request))
        job = self._jobs.start("reading the photos", lambda tell: self._desk.person(keys, tell))
        return as_json(Opened(None, None, job))

    async def first(self, request: Request) -> Response:
        """The photos that the studio was started with, or the bundled portrait."""
        return as_json(PhotosInfo(await run_in_threadpool(self._desk.first)))

    async def picture(self, request: Request) -> Response:
        """The photo itself."""
        data = await run_in_threadpool(self._desk.picture, request.path_params["id"])
        kind = "image/png" if data.startswith(b"\x89PNG") else "image/jpeg"
        return Response(data, media_type=kind)

    async def texture(self, request: Request) -> Response:
        """The texture that photos give, small: made anew while points are dragged."""
        value = await json_body(request)
        make = partial(self._desk.texture, _keys(value), str(value.get("way")))

        def made() -> bytes:
            from pdeface.images import encode_jpeg

            return encode_jpeg(make(value.get("points"), _LIVE))

        return Response(await run_in_threadpool(made), media_type="image/jpeg")

    async def apply(self, request: Request) -> Response:
        """A face with the texture of these photos."""
        value = await json_body(request)
        face = self._store.get(str(value.get("face")))
        make = partial(self._desk.textured, face, _keys(value), str(value.get("way")))
        made = await run_in_threadpool(make, value.get("points"))
        return as_json(replace(self._store.put(made), weights={}))

    async def mesh(self, request: Request) -> Response:
        """The 7 x 7 mesh over a photo with these points."""
        value = await json_body(request)
        found = self._desk.mesh(request.path_params["id"], value.get("points"))
        return JSONResponse({"mesh": found})

    async def points(self, request: Request) -> Response:
        """The points as a file."""
        value = await json_body(request)
        data = self._desk.points_file(request.path_params["id"], value.get("points"))
        return Response(data, media_type="application/octet-stream")


def _keys(value: dict[str, Any]) -> list[str]:
    """The ids of the photos that a request is about.

    Raises:
        InputError: none, too many, or no texts.
    """
    keys = value.get("photos")
    if (
        not isinstance(keys, list)
        or not 1 <= len(keys) <= MOST_PHOTOS
        or not all(isinstance(key, str) for key in keys)
    ):
        raise InputError(f"photos are 1 to {MOST_PHOTOS} by their ids; leave some out")
    return keys


def photo_routes(desk: PhotoDesk, store: FaceStore, jobs: Jobs) -> list[BaseRoute]:
    """The routes of photos."""
    routes = PhotoRoutes(desk, store, jobs)
    return [
        Route("/api/photos", answered(routes.add), methods=["POST"]),
        Route("/api/photos/first", answered(routes.first)),
        Route("/api/photos/person", answered(routes.person), methods=["POST"]),
        Route("/api/photos/texture", answered(routes.texture), methods=["POST"]),
        Route("/api/photos/apply", answered(routes.apply), methods=["POST"]),
        Route("/api/photos/{id}", answered(routes.picture)),
        Route("/api/photos/{id}/mesh", answered(routes.mesh), methods=["POST"]),
        Route("/api/photos/{id}/points", answered(routes.points), methods=["POST"]),
    ]
