"""The face model for the page's own tracker: the webcam's pictures never leave the browser."""

from __future__ import annotations

from pathlib import Path

from starlette.concurrency import run_in_threadpool
from starlette.requests import Request
from starlette.responses import FileResponse, Response
from starlette.routing import BaseRoute, Route

from pdeface.studio.requests import answered

__all__ = ["tracker_routes"]


def tracker_routes(model: str | None) -> list[BaseRoute]:
    """The route of the model's file.

    Args:
        model: the file, or None for the one that :func:`pdeface.photo.model_file` finds.
    """

    def file() -> Path:
        from pdeface.photo import model_file

        return model_file(model)

    async def answer(request: Request) -> Response:
        return FileResponse(await run_in_threadpool(file), media_type="application/octet-stream")

    return [Route("/api/tracker/model", answered(answer))]
