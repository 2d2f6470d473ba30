"""Who may speak to the server: this machine's own page, and nobody's that it happens to show.

A page of any site can send requests to 127.0.0.1. So the Host must be the address that is served
(no name that was rebound to it), the Origin, where there is one, must be the same, and a request
that changes or starts something must have an Origin. Beyond loopback a token is needed besides.
"""

from __future__ import annotations

import ipaddress
import secrets
from http.cookies import CookieError, SimpleCookie
from urllib.parse import parse_qs

from starlette.datastructures import Headers, MutableHeaders
from starlette.responses import PlainTextResponse, RedirectResponse
from starlette.types import ASGIApp, Message, Receive, Scope, Send

__all__ = ["CONTENT_SECURITY_POLICY", "Guard", "is_loopback"]

COOKIE = "pdeface_token"

CONTENT_SECURITY_POLICY = "; ".join(
    (
        "default-src 'none'",
        # The tracker of the webcam is WebAssembly, from here as all else.
        "script-src 'self' 'wasm-unsafe-eval'",
        "style-src 'self'",
        "img-src 'self' data: blob:",
        "connect-src 'self' blob:",
        "font-src 'self'",
        "worker-src 'self'",
        "base-uri 'none'",
        "form-action 'none'",
        "frame-ancestors 'none'",
    )
)
"""What the page may load and do: what comes from this server, and nothing inline."""

_HEADERS = {
    "Content-Security-Policy": CONTENT_SECURITY_POLICY,
    "X-Content-Type-Options": "nosniff",
    "Referrer-Policy": "no-referrer",
    "Cross-Origin-Opener-Policy": "same-origin",
    "Cross-Origin-Resource-Policy": "same-origin",
    "Permissions-Policy": "camera=(self), microphone=(), geolocation=()",
}
_LOOPBACK = ("127.0.0.1", "localhost", "[::1]")


def is_loopback(host: str) -> bool:
    """Whether an address to serve at is reached from this machine alone."""
    try:
        return host == "localhost" or ipaddress.ip_address(host).is_loopback
    except ValueError:
        return False


class Guard:
    """Middleware that refuses strangers and adds the headers that keep the page to itself.

    Args:
        app: what is guarded.
        host, port: where it is served.
        token: what a visitor must know; None on loopback.
    """

    def __init__(self, app: ASGIApp, host: str, port: int, token: str | None) -> None:
        self._app, self._token, self._port = app, token, port
        shown = f"[{host}]" if ":" in host else host
        # Served at every address of the machine, it is reached by names that nobody can list.
        self._hosts = None if host in ("0.0.0.0", "::") else {shown, *_LOOPBACK}
        if is_loopback(host):
            self._hosts = {shown, *_LOOPBACK}

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Answer, refuse, or pass on a request or a websocket."""
        if scope["type"] not in ("http", "websocket"):
            await self._app(scope, receive, send)
            return
        headers = Headers(scope=scope)
        if reason := self._refusal(scope, headers):
            await self._refuse(scope, receive, send, reason)
            return
        if self._token is not None and not self._has_token(headers):
            if scope["type"] == "http" and self._told_token(scope):
                await self._welcome(scope, receive, send)
            else:
                await self._refuse(scope, receive, send, "open the address with its token")
            return
        await self._app(scope, receive, _with_headers(send))

    def _refusal(self, scope: Scope, headers: Headers) -> str | None:
        host = headers.get("host", "")
        if not self._is_ours(host):
            return "this host is not served here"
        origin = headers.get("origin")
        if origin is not None and origin not in (f"http://{host}", f"https://{host}"):
            return "this origin may not use the studio"
        safe = scope["type"] == "http" and scope["method"] in ("GET", "HEAD")
        if origin is None and not safe:
            return "a request that changes something needs an Origin"
        if headers.get("sec-fetch-site") in ("cross-site", "same-site") and scope["path"] != "/":
            return "another site may not use the studio"
        return None

    def _is_ours(self, host: str) -> bool:
        name, _, port = host.rpartition(":")
        if not name or port != str(self._port):
            return False
        return self._hosts is None or name.lower() in self._hosts

    def _has_token(self, headers: Headers) -> bool:
        try:
            cookie = SimpleCookie(headers.get("cookie", "")).get(COOKIE)
        except CookieError:
            return False
        return cookie is not None and self._equals(cookie.value)

    def _told_token(self, scope: Scope) -> bool:
        told = parse_qs(scope["query_string"].decode("latin-1")).get("token", [""])
        return self._equals(told[0])

    def _equals(self, told: str) -> bool:
        return secrets.compare_digest(told.encode(), (self._token or "").encode())

    async def _welcome(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Keep the token in a cookie and out of the address, which others may see."""
        answer = RedirectResponse("/", status_code=303)
        answer.set_cookie(COOKIE, self._token or "", httponly=True, samesite="strict")
        await answer(scope, receive, _with_headers(send))

    async def _refuse(self, scope: Scope, receive: Receive, send: Send, reason: str) -> None:
        if scope["type"] == "websocket":
            await send({"type": "websocket.close", "code": 1008, "reason": reason})
            return
        answer = PlainTextResponse(f"refused: {reason}\n", status_code=403)
        await answer(scope, receive, _with_headers(send))


def _with_headers(send: Send) -> Send:
    async def sending(message: Message) -> None:
        if message["type"] == "http.response.start":
            headers = MutableHeaders(scope=message)
            for name, value in _HEADERS.items():
                headers.setdefault(name, value)
            headers.setdefault("Cache-Control", "no-store")
        await send(message)

    return sending
