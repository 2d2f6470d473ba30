"""The endpoints of scans."""

from __future__ import annotations

import numpy as np
from starlette.concurrency import run_in_threadpool
from starlette.requests import Request
from starlette.responses import Response
from starlette.routing import BaseRoute, Route

from pdeface.studio.packets import pack_arrays
from pdeface.studio.requests import answered, join_of, json_body, mesh_size, weights_of
from pdeface.studio.scans import ScanDesk
from pdeface.studio.store import FaceStore

__all__ = ["scan_routes"]


class ScanRoutes:
    """The endpoints of scans."""

    def __init__(self, desk: ScanDesk, store: FaceStore) -> None:
        self._desk, self._store = desk, store

    async def drawn(self, request: Request) -> Response:
        """The scan itself, as a packet."""
        arrays = await run_in_threadpool(self._desk.drawn, request.path_params["id"])
        return Response(pack_arrays(arrays), media_type="application/octet-stream")

    async def distances(self, request: Request) -> Response:
        """How far each vertex of the skin is from the scan, as a packet."""
        value = await json_body(request)
        weights = weights_of(value.get("weights"))
        geometry = self._store.geometry(str(value.get("face")), *mesh_size(value), join_of(value))

        def made() -> bytes:
            found = geometry.exact(weights, normals=True)
            count = geometry.counts[0]
            key = request.path_params["id"]
            away = self._desk.distances(key, *(of[:count].astype(np.float64) for of in found))
            return pack_arrays({"away": away})

        return Response(await run_in_threadpool(made), media_type="application/octet-stream")


def scan_routes(desk: ScanDesk, store: FaceStore) -> list[BaseRoute]:
    """The routes of scans."""
    routes = ScanRoutes(desk, store)
    return [
        Route("/api/scans/{id}", answered(routes.drawn)),
        Route("/api/scans/{id}/distances", answered(routes.distances), methods=["POST"]),
    ]
