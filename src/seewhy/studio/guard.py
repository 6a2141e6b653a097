"""What the pages let in: this machine's own browser, with what the page itself gave it."""

from __future__ import annotations

import hashlib
import hmac
import secrets
from urllib.parse import parse_qs

from fastapi import HTTPException, Request
from starlette.datastructures import Headers, MutableHeaders
from starlette.requests import cookie_parser
from starlette.responses import RedirectResponse
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from seewhy.studio.access import Access, AccessRules

__all__ = ["CSRF", "CSRF_HEADER", "Guard", "csrf_of", "require_csrf"]

CSRF = "csrf"
"""The field of every form that says that one of our pages sent it."""

CSRF_HEADER = "X-CSRF-Token"
"""The same, of requests that scripts of our pages send."""

_SESSION = "seewhy_session"
_TOKEN = "seewhy_token"
_COOKIE = "; HttpOnly; SameSite=Strict; Path=/"
_HEADERS = {
    # Nothing but our own files is run or shown, and nothing inline.
    "Content-Security-Policy": (
        "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data: blob:; "
        "connect-src 'self'; form-action 'self'; base-uri 'none'; frame-ancestors 'none'"
    ),
    "X-Content-Type-Options": "nosniff",
    "X-Frame-Options": "DENY",
    # With "no-referrer" browsers would send forms with the origin "null".
    "Referrer-Policy": "same-origin",
    "Cross-Origin-Opener-Policy": "same-origin",
    "Cross-Origin-Resource-Policy": "same-origin",
}


class Guard:
    """Refuses what :class:`~seewhy.studio.access.AccessRules` do not let in, and gives sessions.

    A browser says the token once, in the address that the command prints (``/?token=…``), and
    keeps it in a cookie. Every browser has a session of its own, to which forms are bound.

    Parameters
    ----------
    application : ASGI application
    rules : AccessRules
    """

    def __init__(self, application: ASGIApp, rules: AccessRules) -> None:
        self._rules = rules
        self._inner = Access(application, rules)

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] != "http":
            await self._inner(scope, receive, send)
            return
        cookies = cookie_parser(Headers(scope=scope).get("cookie", ""))
        session = cookies.get(_SESSION, "")
        new = not session
        if new:
            session = secrets.token_urlsafe(24)
        scope.setdefault("state", {})["session"] = session
        token = cookies.get(_TOKEN, "")
        headers = MutableHeaders(scope=scope)
        if token and "authorization" not in headers:
            headers["authorization"] = f"Bearer {token}"

        async def with_headers(message: Message) -> None:
            if message["type"] == "http.response.start":
                answered = MutableHeaders(scope=message)
                for name, text in _HEADERS.items():
                    answered.setdefault(name, text)
                answered.setdefault("Cache-Control", "no-store")
                if new:
                    answered.append("Set-Cookie", f"{_SESSION}={session}{_COOKIE}")
            await send(message)

        given = parse_qs(scope["query_string"].decode("latin-1")).get("token", [""])[0]
        if given and scope["method"] == "GET" and self._rules.token:
            headers["authorization"] = f"Bearer {given}"
            if secrets.compare_digest(given.encode(), self._rules.token.encode()):
                scope["query_string"] = b""
                keep = _Keeping(given)
                await Access(keep, self._rules)(scope, receive, with_headers)
                return
        await self._inner(scope, receive, with_headers)


class _Keeping:
    """Gives a browser the token in a cookie and sends it to the page without the token."""

    def __init__(self, token: str) -> None:
        self._token = token

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        response = RedirectResponse(scope["path"], 303)
        response.headers.append("Set-Cookie", f"{_TOKEN}={self._token}{_COOKIE}")
        await response(scope, receive, send)


def csrf_of(request: Request) -> str:
    """The text that forms of this browser's session have to bring."""
    key: bytes = request.app.state.csrf_key
    session: str = request.state.session
    return hmac.new(key, session.encode(), hashlib.sha256).hexdigest()


async def require_csrf(request: Request) -> None:
    """Refuse what changes something and was not sent by one of our pages.

    Raises
    ------
    HTTPException
        403, if the session's text is missing or wrong.
    """
    if request.method in ("GET", "HEAD", "OPTIONS"):
        return
    given: object = request.headers.get(CSRF_HEADER)
    if given is None:
        given = (await request.form()).get(CSRF)
    if not isinstance(given, str) or not secrets.compare_digest(
        given.encode(), csrf_of(request).encode()
    ):
        raise HTTPException(
            403, "the form is not from this session's page; load the page again and repeat"
        )
