"""Endpoints of one face: its GLB, its columns, where it is exactly, its files."""

from __future__ import annotations

from collections.abc import AsyncIterator, Mapping, Sequence
from functools import partial
from typing import Any

import numpy as np
from starlette.concurrency import run_in_threadpool
from starlette.requests import Request
from starlette.responses import Response, StreamingResponse
from starlette.routing import BaseRoute, Route

from pdeface.errors import InputError
from pdeface.face import Face
from pdeface.studio.blending import blended
from pdeface.studio.geometry import Geometry
from pdeface.studio.meetings import meetings
from pdeface.studio.moves import with_moves
from pdeface.studio.packets import pack_arrays, packed
from pdeface.studio.requests import answered, as_json, join_of, json_body, mesh_size, weights_of
from pdeface.studio.saving import exported, saved
from pdeface.studio.schema import FaceInfo, schema
from pdeface.studio.store import FaceStore, describe

__all__ = ["face_routes"]

_BYTES = "application/octet-stream"
_MOST_STATES = 32
_SECONDS_OF_CACHE = "private, max-age=86400, immutable"


class FaceRoutes:
    """The endpoints, over the faces that the server keeps."""

    def __init__(self, store: FaceStore, first: FaceInfo) -> None:
        self._store, self._first = store, first

    async def schema(self, request: Request) -> Response:
        """What the page has to know beforehand."""
        return as_json(schema())

    async def first(self, request: Request) -> Response:
        """The face that the studio was started with."""
        return as_json(self._first)

    async def known(self, request: Request) -> Response:
        """What the server knows of a face."""
        return as_json(describe(self._store.get(request.path_params["id"])))

    async def model(self, request: Request) -> Response:
        """The GLB of a face without weights."""
        geometry = self._geometry(request, request.query_params)
        data = await run_in_threadpool(geometry.glb)
        return Response(data, media_type="model/gltf-binary", headers=_cached())

    async def columns(self, request: Request) -> Response:
        """What each control adds, as a packet."""
        geometry = self._geometry(request, request.query_params)

        def made() -> list[bytes | memoryview]:
            return packed(geometry.columns(), **geometry.facts())

        # In pieces: at the finest density they are 70 MB.
        chunks = await run_in_threadpool(made)
        return StreamingResponse(_each(chunks), media_type=_BYTES, headers=_cached())

    async def evaluate(self, request: Request) -> Response:
        """All vertices at one or more states of the weights, and normals at the first."""
        value = await json_body(request)
        states = value.get("states")
        if not isinstance(states, list) or not 1 <= len(states) <= _MOST_STATES:
            raise InputError(f"states are 1 to {_MOST_STATES} sets of weights; reload the page")
        weights = [weights_of(state) for state in states]
        geometry = self._geometry(request, value)

        def made() -> bytes:
            found = [geometry.exact(w, normals=not n) for n, w in enumerate(weights)]
            positions = np.array([one[0] for one in found])
            return pack_arrays({"positions": positions, "normals": found[0][1]})

        return Response(await run_in_threadpool(made), media_type=_BYTES)

    async def response(self, request: Request) -> Response:
        """What a metre of some handles together adds to the skin and to the curves."""
        value = await json_body(request)
        geometry = self._geometry(request, value)
        handles, symmetric = value.get("handles"), bool(value.get("symmetric"))
        if not isinstance(handles, list) or not all(
            isinstance(handle, list) and len(handle) == 3 for handle in handles
        ):
            raise InputError("handles are a list of (curve, point, share); reload the page")
        skin, curves = await run_in_threadpool(geometry.response, handles, symmetric)
        return Response(pack_arrays({"skin": skin, "curves": curves}), media_type=_BYTES)

    async def edit(self, request: Request) -> Response:
        """The face with handles of its curves moved: a face of its own."""
        value = await json_body(request)
        face = self._store.get(request.path_params["id"])
        return as_json(
            self._store.put(await run_in_threadpool(with_moves, face, value.get("moves")))
        )

    async def blend(self, request: Request) -> Response:
        """A face between this one and another."""
        value = await json_body(request)
        one = self._store.get(request.path_params["id"])
        other, share = self._store.get(str(value.get("other"))), value.get("share")
        if not isinstance(share, int | float) or isinstance(share, bool):
            raise InputError(f"a share of a blend is a number, got {share!r}; reload the page")
        return as_json(self._store.put(await run_in_threadpool(blended, one, other, share)))

    async def meetings(self, request: Request) -> Response:
        """What the page's sum of columns lacks where expressions meet."""
        geometry = self._geometry(request, request.query_params)
        found = await run_in_threadpool(meetings, geometry)
        return Response(pack_arrays(found), media_type=_BYTES, headers=_cached())

    async def save(self, request: Request) -> Response:
        """The face with these weights as a ``.pdeface`` file."""
        value = await json_body(request)
        face = self._face(request, value)
        return Response(await run_in_threadpool(saved, face), media_type=_BYTES)

    async def export(self, request: Request) -> Response:
        """The face with these weights as a file of another format."""
        value = await json_body(request)
        face = self._face(request, value)
        make = partial(exported, face, str(value.get("format")), mesh_size(value), join_of(value))
        data, kind = await run_in_threadpool(
            make, bool(value.get("expressions")), bool(value.get("visemes"))
        )
        return Response(data, media_type=kind)

    def _geometry(self, request: Request, value: Mapping[str, Any]) -> Geometry:
        key = request.path_params["id"]
        return self._store.geometry(key, *mesh_size(value), join_of(value))

    def _face(self, request: Request, value: dict[str, Any]) -> Face:
        face = self._store.get(request.path_params["id"])
        weights = weights_of(value.get("weights"))
        name = value.get("name")
        if not isinstance(name, str) or len(name) > 200:
            raise InputError("the name of a face is a text of at most 200 letters; shorten it")
        bare = face.with_weights(dict.fromkeys(face.weights, 0.0))
        return bare.with_weights(weights).with_name(name)


async def _each(chunks: Sequence[bytes | memoryview]) -> AsyncIterator[bytes | memoryview]:
    for chunk in chunks:
        yield chunk


def _cached() -> dict[str, str]:
    # A face is known by its content, so that its model never changes.
    return {"Cache-Control": _SECONDS_OF_CACHE}


def face_routes(store: FaceStore, first: FaceInfo) -> list[BaseRoute]:
    """The routes of faces."""
    routes = FaceRoutes(store, first)
    one = "/api/faces/{id}"
    return [
        Route("/api/schema", answered(routes.schema)),
        Route("/api/first", answered(routes.first)),
        Route(one, answered(routes.known)),
        Route(f"{one}/model.glb", answered(routes.model)),
        Route(f"{one}/columns", answered(routes.columns)),
        Route(f"{one}/evaluate", answered(routes.evaluate), methods=["POST"]),
        Route(f"{one}/response", answered(routes.response), methods=["POST"]),
        Route(f"{one}/meetings", answered(routes.meetings)),
        Route(f"{one}/blend", answered(routes.blend), methods=["POST"]),
        Route(f"{one}/edit", answered(routes.edit), methods=["POST"]),
        Route(f"{one}/save", answered(routes.save), methods=["POST"]),
        Route(f"{one}/export", answered(routes.export), methods=["POST"]),
    ]
