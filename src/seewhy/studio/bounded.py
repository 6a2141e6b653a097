"""How long a request may take, and that it was answered."""

from __future__ import annotations

import asyncio
import time
from collections.abc import Collection

from starlette.responses import JSONResponse
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from seewhy.studio.metrics import Metrics

__all__ = ["Bounded"]

_OTHER = "other"
_FAILED = 500


class Bounded:
    """Says that there is no answer where one takes too long, and counts what was answered.

    Parameters
    ----------
    application : ASGI application
    seconds : float
        Of a request, waiting included.
    paths : collection of str
        Those that are counted by name; all others are counted together.
    metrics : Metrics
        Where they are counted.
    """

    def __init__(
        self,
        application: ASGIApp,
        seconds: float,
        paths: Collection[str],
        metrics: Metrics,
    ) -> None:
        self._application = application
        self._seconds = seconds
        self._paths = frozenset(paths)
        self._metrics = metrics

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] != "http":
            await self._application(scope, receive, send)
            return
        path = scope["path"] if scope["path"] in self._paths else _OTHER
        began = time.perf_counter()
        status = 0  # none yet

        async def noting(message: Message) -> None:
            nonlocal status
            if message["type"] == "http.response.start":
                status = message["status"]
            await send(message)

        try:
            async with asyncio.timeout(self._seconds):
                await self._application(scope, receive, noting)
        except TimeoutError:
            if status:
                raise  # half an answer is no answer
            text = f"no answer within {self._seconds:g} seconds; try again, or raise --seconds"
            await JSONResponse({"error": text}, 503)(scope, receive, noting)
        finally:
            self._metrics.note(path, status or _FAILED, time.perf_counter() - began)
