"""Reading what the page sends: limited in size, checked, and told off in one line."""

from __future__ import annotations

import dataclasses
import json
from collections.abc import Awaitable, Callable, Mapping
from typing import Any

from starlette.requests import Request
from starlette.responses import JSONResponse, Response

from pdeface.errors import InputError, PDEFaceError
from pdeface.pde import Join

__all__ = [
    "LARGEST_UPLOAD",
    "answered",
    "as_json",
    "body",
    "join_of",
    "json_body",
    "mesh_size",
    "weights_of",
]

LARGEST_UPLOAD = 64 << 20
"""Bytes of a file that is opened, at most."""

_LARGEST_JSON = 4 << 20

Endpoint = Callable[[Request], Awaitable[Response]]


def answered(endpoint: Endpoint) -> Endpoint:
    """The endpoint, whose errors become one line of JSON: 422 for input, 500 for the rest."""

    async def wrapped(request: Request) -> Response:
        try:
            return await endpoint(request)
        except PDEFaceError as error:
            status = 422 if isinstance(error, InputError) else 500
            return JSONResponse({"error": " ".join(str(error).split())}, status)
        except Exception as error:  # a line in the page rather than a dead button
            text = f"unexpected {type(error).__name__}: {error}"
            return JSONResponse({"error": " ".join(text.split())}, 500)

    return wrapped


async def body(request: Request, most: int = LARGEST_UPLOAD) -> bytes:
    """The bytes that were sent, refused as soon as they are too many.

    Raises:
        InputError: more than ``most``, or none.
    """
    chunks, size = [], 0
    async for chunk in request.stream():
        size += len(chunk)
        if size > most:
            raise InputError(
                f"a file may have {most >> 20} MiB here, got more; make it smaller, or use the "
                "command line"
            )
        chunks.append(chunk)
    if not size:
        raise InputError("expected a file, got nothing; choose one that is not empty")
    return b"".join(chunks)


async def json_body(request: Request) -> dict[str, Any]:
    """The JSON object that was sent.

    Raises:
        InputError: something else.
    """
    try:
        value = json.loads(await body(request, _LARGEST_JSON))
    except (ValueError, RecursionError) as error:
        raise InputError(f"expected JSON, got something else ({error}); reload the page") from error
    if not isinstance(value, dict):
        raise InputError("expected a JSON object, got another value; reload the page")
    return value


def mesh_size(value: Mapping[str, Any]) -> tuple[int, int]:
    """``rows`` and ``columns``.

    Raises:
        InputError: no whole numbers.
    """
    try:
        return int(value["rows"]), int(value["columns"])
    except (KeyError, TypeError, ValueError) as error:
        raise InputError("rows and columns are whole numbers; reload the page") from error


def join_of(value: Mapping[str, Any]) -> Join:
    """``join``, ``"smooth"`` if it is not said.

    Raises:
        InputError: another.
    """
    join = value.get("join", "smooth")
    if join not in ("smooth", "patchwise"):
        raise InputError(f"a join is 'smooth' or 'patchwise', got {join!r}; reload the page")
    return join


def weights_of(value: Any) -> dict[str, float]:
    """Weights by name; :meth:`Face.with_weights` checks names and values.

    Raises:
        InputError: no JSON object of numbers.
    """
    if not isinstance(value, dict) or not all(
        isinstance(v, int | float) and not isinstance(v, bool) for v in value.values()
    ):
        raise InputError("weights are numbers by the names of controls; reload the page")
    return value


def as_json(value: Any) -> Response:
    """A dataclass of the schema as an answer."""
    return JSONResponse(dataclasses.asdict(value))
