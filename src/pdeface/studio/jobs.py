"""Work that takes seconds: done in threads of its own, told of over one websocket."""

from __future__ import annotations

import asyncio
import dataclasses
import secrets
import threading
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from typing import Protocol

from starlette.routing import BaseRoute, WebSocketRoute
from starlette.websockets import WebSocket, WebSocketDisconnect

from pdeface.errors import PDEFaceError
from pdeface.studio.apart import Arrays
from pdeface.studio.packets import pack_arrays
from pdeface.studio.schema import FaceInfo, JobInfo, PhotoInfo, ScanInfo

__all__ = ["Jobs", "Result", "Tell", "job_routes"]


class Tell(Protocol):
    """Tells the page what a job is doing, and about what share of its time is over."""

    def __call__(self, text: str, share: float = 0.0) -> None:
        """Tell it."""

    def show(self, arrays: Arrays) -> None:
        """Show it what has been made so far."""


@dataclass(frozen=True)
class Result:
    """What a job has made: a face, of photos or of a scan."""

    face: FaceInfo
    photos: Sequence[PhotoInfo] = ()
    scan: ScanInfo | None = None


Message = JobInfo | bytes
"""What a page is sent: how far a job has come, or a packet of what it shows."""

_KEPT = 64


class Jobs:
    """Jobs one after the other, and who wants to hear of them."""

    def __init__(self) -> None:
        self._pool = ThreadPoolExecutor(max_workers=1, thread_name_prefix="pdeface-job")
        self._lock = threading.Lock()
        self._infos: dict[str, JobInfo] = {}
        self._listeners: dict[asyncio.Queue[Message], asyncio.AbstractEventLoop] = {}

    def start(self, message: str, work: Callable[[Tell], Result]) -> JobInfo:
        """Begin a job as soon as the one before is done.

        Args:
            message: what it does, for the page.
            work: does it; is given a function that tells of its progress.
        """
        info = JobInfo(secrets.token_hex(8), "running", message, 0.0, None, [], None)
        self._tell(info)
        self._pool.submit(self._run, info, work)
        return info

    def _run(self, info: JobInfo, work: Callable[[Tell], Result]) -> None:
        try:
            made = work(_Telling(self, info))
            done = dataclasses.replace(info, state="done", share=1.0, face=made.face)
            self._tell(dataclasses.replace(done, photos=list(made.photos), scan=made.scan))
        except Exception as error:  # whatever it is, the page must not wait for ever
            known = isinstance(error, PDEFaceError)
            text = str(error) if known else f"unexpected {type(error).__name__}: {error}"
            message = " ".join(text.split())
            self._tell(dataclasses.replace(info, state="failed", message=message))

    def _tell(self, info: JobInfo) -> None:
        with self._lock:
            self._infos[info.id] = info
            while len(self._infos) > _KEPT:
                del self._infos[next(iter(self._infos))]
        self._send(info)

    def _send(self, message: Message) -> None:
        with self._lock:
            listeners = list(self._listeners.items())
        for queue, loop in listeners:
            loop.call_soon_threadsafe(queue.put_nowait, message)

    async def listen(self, websocket: WebSocket) -> None:
        """Tell one page of every job, the latest first of all."""
        await websocket.accept()
        queue: asyncio.Queue[Message] = asyncio.Queue()
        with self._lock:
            # A page that lost its connection hears what became of its job meanwhile.
            for info in self._infos.values():
                queue.put_nowait(info)
            self._listeners[queue] = asyncio.get_running_loop()
        sender = asyncio.create_task(_send(websocket, queue))
        try:
            while True:
                await websocket.receive_text()
        except WebSocketDisconnect:
            pass
        finally:
            with self._lock:
                del self._listeners[queue]
            sender.cancel()


class _Telling:
    """What a job says, sent to every page.

    Args:
        jobs: of which it is.
        info: what is known of it.
    """

    def __init__(self, jobs: Jobs, info: JobInfo) -> None:
        self._jobs, self._info = jobs, info

    def __call__(self, text: str, share: float = 0.0) -> None:
        self._info = dataclasses.replace(self._info, message=text, share=share)
        self._jobs._tell(self._info)

    def show(self, arrays: Arrays) -> None:
        # Only to who is there: it is soon out of date.
        self._jobs._send(pack_arrays(arrays, job=self._info.id))


async def _send(websocket: WebSocket, queue: asyncio.Queue[Message]) -> None:
    while True:
        message = await queue.get()
        if isinstance(message, bytes):
            await websocket.send_bytes(message)
        else:
            await websocket.send_json(dataclasses.asdict(message))


def job_routes(jobs: Jobs) -> list[BaseRoute]:
    """The websocket."""
    return [WebSocketRoute("/api/jobs", jobs.listen)]
