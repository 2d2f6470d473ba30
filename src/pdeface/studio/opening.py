"""Files that the page sends: what each is, by its content, and what is made of it."""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np
from starlette.concurrency import run_in_threadpool
from starlette.requests import Request
from starlette.responses import Response
from starlette.routing import BaseRoute, Route

from pdeface.errors import InputError
from pdeface.face import Face, load
from pdeface.motion import Track, clip, read, write
from pdeface.studio.jobs import Jobs
from pdeface.studio.photos import PhotoDesk
from pdeface.studio.requests import answered, as_json, body, json_body
from pdeface.studio.scans import ScanDesk, scan_suffix
from pdeface.studio.schema import ClipInfo, Opened
from pdeface.studio.store import FaceStore
from pdeface.studio.temporary import as_file

__all__ = ["open_routes", "opened_face"]

_MOST_FRAMES = 36_000
_FPS = 60.0


def kind_of(data: bytes) -> str:
    """``"face"``, ``"photo"``, ``"motion"`` or the suffix of a scan, by the content.

    Raises:
        InputError: none of them.
    """
    if data.startswith(b"PK\x03\x04"):
        return "face"
    if data.startswith((b"\xff\xd8\xff", b"\x89PNG\r\n\x1a\n")):
        return "photo"
    if b"timecode" in data[:1024].lower() or data.lstrip()[:1] == b"{":
        return "motion"
    if suffix := scan_suffix(data):
        return suffix
    raise InputError(
        "expected a .pdeface file, a photo (JPEG or PNG), a scan (PLY, OBJ, STL, GLB) or a Live "
        "Link Face CSV, got something else; choose one of these"
    )


def opened_face(data: bytes) -> Face:
    """The face in the bytes of a ``.pdeface`` file.

    Raises:
        FileFormatError: the file is damaged or something else.
    """
    with as_file(data, ".pdeface") as path:
        return load(path)


def opened_motion(data: bytes) -> ClipInfo:
    """The track in the bytes of a motion file, at up to 60 frames a second.

    Raises:
        FileFormatError: the file is damaged or something else.
    """
    with as_file(data, ".json" if data.lstrip()[:1] == b"{" else ".csv") as path:
        return clip_info("recording", read(path, clamp=True))


def clip_info(name: str, track: Track) -> ClipInfo:
    """A track as the page plays it."""
    if track.fps is not None and track.fps > _FPS:
        track = track.resampled(_FPS)
    if len(track) > _MOST_FRAMES:
        raise InputError(
            f"the studio plays {_MOST_FRAMES:,} frames at most, got {len(track):,}; cut it first"
        )
    start = float(track.times[0])
    return ClipInfo(
        name,
        [round(float(t) - start, 5) for t in track.times],
        list(track.names),
        track.weights.round(5).tolist(),
        track.head.round(6).tolist(),
        list(track.notes),
    )


def motion_file(value: Mapping[str, Any]) -> bytes:
    """A clip as the page has it, as the JSON of a track.

    Raises:
        InputError: no clip.
    """
    try:
        track = Track(
            times=np.array(value["times"], np.float64),
            names=tuple(value["names"]),
            weights=np.array(value["weights"], np.float64),
            head=np.array(value["head"], np.float64),
        )
    except (KeyError, TypeError, ValueError) as error:
        raise InputError(
            f"expected a clip, got something else ({error}); reload the page"
        ) from error
    with TemporaryDirectory(prefix="pdeface-") as folder:
        path = Path(folder) / "motion.json"
        write(track, path)
        return path.read_bytes()


class OpenRoutes:
    """The endpoints that take files, and clips by name."""

    def __init__(self, store: FaceStore, photos: PhotoDesk, scans: ScanDesk, jobs: Jobs) -> None:
        self._store, self._photos, self._scans, self._jobs = store, photos, scans, jobs

    async def open(self, request: Request) -> Response:
        """Whatever file it is."""
        data = await body(request)
        kind = kind_of(data)
        if kind == "face":
            info = self._store.put(await run_in_threadpool(opened_face, data))
            return as_json(Opened(info, None, None))
        if kind == "motion":
            return as_json(Opened(None, await run_in_threadpool(opened_motion, data), None))
        if kind != "photo":
            work = partial(self._scans.fitted, data, kind)
            return as_json(Opened(None, None, self._jobs.start("reading the scan", work)))
        job = self._jobs.start("reading the photo", lambda tell: self._photos.opened(data, tell))
        return as_json(Opened(None, None, job))

    async def keep(self, request: Request) -> Response:
        """A clip of the page's as a file."""
        data = await run_in_threadpool(motion_file, await json_body(request))
        return Response(data, media_type="application/json")

    async def clip(self, request: Request) -> Response:
        """A built-in clip."""
        name = request.path_params["name"]
        return as_json(clip_info(name, await run_in_threadpool(clip, name)))


def open_routes(
    store: FaceStore, photos: PhotoDesk, scans: ScanDesk, jobs: Jobs
) -> list[BaseRoute]:
    """The routes of files and clips."""
    routes = OpenRoutes(store, photos, scans, jobs)
    return [
        Route("/api/open", answered(routes.open), methods=["POST"]),
        Route("/api/clips", answered(routes.keep), methods=["POST"]),
        Route("/api/clips/{name}", answered(routes.clip)),
    ]
