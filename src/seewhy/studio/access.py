"""Who may ask: hosts and origins that are this server's, whoever has the token, bounded bodies."""

from __future__ import annotations

import secrets
from contextlib import suppress
from dataclasses import dataclass
from urllib.parse import urlsplit

from starlette.datastructures import Headers
from starlette.responses import JSONResponse
from starlette.types import ASGIApp, Message, Receive, Scope, Send

__all__ = ["LOOPBACK", "Access", "AccessRules"]

LOOPBACK = frozenset({"127.0.0.1", "localhost", "::1"})
"""Names of the machine itself: who asks them needs no token."""

OPEN = frozenset({"/health"})
"""Paths that need no token."""


@dataclass(frozen=True)
class AccessRules:
    """What is let in.

    Attributes
    ----------
    hosts : frozenset of str
        Names by which the server may be called; a page of another name that leads here is refused.
    token : str
        What ``Authorization: Bearer`` has to say; empty: nothing.
    most_bytes : int
        Of a request.
    """

    hosts: frozenset[str]
    token: str
    most_bytes: int


class _TooLargeError(Exception):
    """More came than was announced, or than is read."""


class Access:
    """Refuses what :class:`AccessRules` do not let in, before anything is read of it."""

    def __init__(self, application: ASGIApp, rules: AccessRules) -> None:
        self._application = application
        self._rules = rules

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] != "http":
            await self._application(scope, receive, send)
            return
        headers = Headers(scope=scope)
        refused = self._refused(headers, scope["path"])
        if refused is not None:
            status, text = refused
            await JSONResponse({"error": text}, status)(scope, receive, send)
            return
        left = self._rules.most_bytes

        async def bounded() -> Message:
            nonlocal left
            message = await receive()
            left -= len(message.get("body", b""))
            if left < 0:
                raise _TooLargeError
            return message

        async def unless_too_large(message: Message) -> None:
            # Whoever reads forms takes the error for a damaged one, and would say so.
            if left >= 0:
                await send(message)

        with suppress(_TooLargeError):
            await self._application(scope, bounded, unless_too_large)
        if left < 0:
            await JSONResponse({"error": self._too_large()}, 413)(scope, receive, send)

    def _refused(self, headers: Headers, path: str) -> tuple[int, str] | None:
        host = headers.get("host", "")
        if _name(host) not in self._rules.hosts:
            return 403, f"the server is not called '{_name(host)}'; --allow-host lets a name in"
        origin = headers.get("origin")
        if origin is not None and urlsplit(origin).netloc != host:
            return 403, "a page of another origin may not ask"
        given = headers.get("authorization", "").removeprefix("Bearer ")
        if (
            self._rules.token
            and path not in OPEN
            and not secrets.compare_digest(given.encode(), self._rules.token.encode())
        ):
            return 401, "the token is missing or wrong; send 'Authorization: Bearer TOKEN'"
        length = headers.get("content-length", "0")
        if not length.isdecimal() or int(length) > self._rules.most_bytes:
            return 413, self._too_large()
        return None

    def _too_large(self) -> str:
        return f"more than {self._rules.most_bytes:,} bytes; send a smaller picture"


def _name(host: str) -> str:
    """The name in a header such as ``localhost:8000`` or ``[::1]:8000``."""
    if host.startswith("["):
        return host[1:].partition("]")[0]
    return host.partition(":")[0]
