"""Pictures that arrive together are looked at in one pass."""

from __future__ import annotations

import asyncio
from collections import deque
from concurrent.futures import ThreadPoolExecutor
from typing import TYPE_CHECKING

import numpy as np

from seewhy.classification.pictures import BATCH, reasons_of
from seewhy.errors import SeeWhyError
from seewhy.perception.picture import Picture
from seewhy.studio.answers import Seen

if TYPE_CHECKING:
    from seewhy.agent.agent import Agent

__all__ = ["Batches", "BusyError"]

_Waiting = tuple[Picture, bool, "asyncio.Future[Seen]"]


class BusyError(SeeWhyError):
    """More is asked than can be answered in time."""


class Batches:
    """What sees, for requests that come at any time.

    While some pictures are looked at, others wait; all that wait by then are looked at together.
    Nobody waits for others to come.

    Parameters
    ----------
    agent : Agent
        A trained one.
    most : int
        Pictures that may wait; more are refused.
    """

    def __init__(self, agent: Agent, *, most: int) -> None:
        self._agent = agent
        self._most = most
        self._say_why = reasons_of(agent)
        self._waiting: deque[_Waiting] = deque()
        self._work: asyncio.Task[None] | None = None
        self._thread = ThreadPoolExecutor(1, thread_name_prefix="seeing")

    async def look(self, pixels: Picture, *, with_reasons: bool = False) -> Seen:
        """Look at a picture.

        Raises
        ------
        BusyError
            If too many wait already.
        """
        if len(self._waiting) >= self._most:
            raise BusyError(f"{self._most} pictures wait already; try again in some seconds")
        seen: asyncio.Future[Seen] = asyncio.get_running_loop().create_future()
        self._waiting.append((pixels, with_reasons, seen))
        if self._work is None or self._work.done():
            self._work = asyncio.create_task(self._look_at_all())
        return await seen

    async def _look_at_all(self) -> None:
        loop = asyncio.get_running_loop()
        while self._waiting:
            batch = [self._waiting.popleft() for _ in range(min(BATCH, len(self._waiting)))]
            # Whoever asked may have gone.
            batch = [waiting for waiting in batch if not waiting[2].done()]
            if not batch:
                continue
            try:
                found = await loop.run_in_executor(self._thread, self._see, batch)
            except Exception as problem:
                for _, _, seen in batch:
                    if not seen.done():
                        seen.set_exception(problem)
                continue
            for (_, _, seen), result in zip(batch, found, strict=True):
                if not seen.done():
                    seen.set_result(result)

    def _see(self, batch: list[_Waiting]) -> list[Seen]:
        scenes = self._agent.classify_all(np.stack([pixels for pixels, _, _ in batch]))
        wanted = [number for number, (_, with_reasons, _) in enumerate(batch) if with_reasons]
        reasons = dict(
            zip(wanted, self._say_why([scenes[number] for number in wanted]), strict=True)
        )
        return [
            Seen(pixels, scene, reasons.get(number, ""))
            for number, ((pixels, _, _), scene) in enumerate(zip(batch, scenes, strict=True))
        ]

    def close(self) -> None:
        """Let the thread end."""
        self._thread.shutdown(wait=False, cancel_futures=True)
