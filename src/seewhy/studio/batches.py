"""Pictures that arrive together are looked at together, by a thread for each core."""

from __future__ import annotations

import asyncio
from collections import deque
from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial
from threading import Lock
from typing import IO, TYPE_CHECKING

import numpy as np
import torch

from seewhy.classification.pictures import BATCH, reasons_of
from seewhy.errors import SeeWhyError
from seewhy.perception.device import device_of
from seewhy.perception.picture import Picture, picture_of_bytes
from seewhy.perception.side_by_side import single_core_threads
from seewhy.studio.answers import Seen

if TYPE_CHECKING:
    from seewhy.agent.agent import Agent

__all__ = ["Batches", "BusyError"]

_TOGETHER = 16
"""Pictures that one thread looks at together: with more, each takes as long as with so many."""


class BusyError(SeeWhyError):
    """More is asked than can be answered in time."""


@dataclass(frozen=True, eq=False)
class _Waiting:
    """A picture that somebody asks about, and where they are told what it shows."""

    image: IO[bytes]
    name: str
    with_reasons: bool
    seen: asyncio.Future[Seen]


class Batches:
    """What sees, for requests that come at any time.

    While some pictures are looked at, others wait; a thread that is free takes its share of those
    that wait by then. Nobody waits for others to come. Threads see side by side and decide one
    after another.

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
        on_processor = device_of(agent.device).type == "cpu"
        self._together = _TOGETHER if on_processor else BATCH
        self._free = torch.get_num_threads() if on_processor else 1
        self._threads = single_core_threads(self._free, name="seeing")
        self._deciding = Lock()

    async def look(self, image: IO[bytes], *, name: str, with_reasons: bool = False) -> Seen:
        """Look at a picture.

        Parameters
        ----------
        image : binary stream
            The picture's file.
        name : str
            What errors call it.
        with_reasons : bool, default False
            Whether to say why it is of its class.

        Raises
        ------
        PictureError
            If it is no picture.
        BusyError
            If too many wait already.
        """
        if len(self._waiting) >= self._most:
            raise BusyError(f"{self._most} pictures wait already; try again in some seconds")
        seen: asyncio.Future[Seen] = asyncio.get_running_loop().create_future()
        self._waiting.append(_Waiting(image, name, with_reasons, seen))
        self._begin()
        return await seen

    def _begin(self) -> None:
        """Give threads that are free their shares of what waits."""
        while self._free and self._waiting:
            share = min(self._together, -(-len(self._waiting) // self._free))
            taken = [self._waiting.popleft() for _ in range(share)]
            # Whoever asked may have gone.
            asked = [waiting for waiting in taken if not waiting.seen.done()]
            if asked:
                self._free -= 1
                loop = asyncio.get_running_loop()
                looking = loop.run_in_executor(self._threads, self._look_at, asked)
                looking.add_done_callback(partial(self._tell, asked))

    def _tell(
        self, asked: Sequence[_Waiting], looking: asyncio.Future[list[Seen | Exception]]
    ) -> None:
        self._free += 1
        if not looking.cancelled():
            problem = looking.exception()
            results = [problem] * len(asked) if problem is not None else looking.result()
            for waiting, result in zip(asked, results, strict=True):
                if waiting.seen.done():
                    continue
                if isinstance(result, Seen):
                    waiting.seen.set_result(result)
                else:
                    waiting.seen.set_exception(result)
        self._begin()

    def _look_at(self, asked: Sequence[_Waiting]) -> list[Seen | Exception]:
        """What pictures show, or what is wrong with them, in their order."""
        read = [self._read(waiting) for waiting in asked]
        pictures = [pixels for pixels in read if not isinstance(pixels, Exception)]
        if not pictures:
            return [problem for problem in read if isinstance(problem, Exception)]
        networks_say = self._agent.see(np.stack(pictures))
        wanted = [
            waiting.with_reasons
            for waiting, pixels in zip(asked, read, strict=True)
            if not isinstance(pixels, Exception)
        ]
        with self._deciding:
            scenes = self._agent.classify_seen(networks_say)
            explained = [scene for scene, why in zip(scenes, wanted, strict=True) if why]
            reasons = iter(self._say_why(explained))
        found = iter(
            [
                (scene, next(reasons) if why else "")
                for scene, why in zip(scenes, wanted, strict=True)
            ]
        )
        return [
            pixels if isinstance(pixels, Exception) else Seen(pixels, *next(found))
            for pixels in read
        ]

    def _read(self, waiting: _Waiting) -> Picture | Exception:
        """The pixels of a picture, or what is wrong with it: the others are looked at then, too."""
        agent = self._agent
        try:
            return picture_of_bytes(
                waiting.image.read(),
                name=waiting.name,
                size=agent.picture_size,
                fit=agent.domain.pictures.fit,
            )
        except Exception as problem:
            return problem

    def close(self) -> None:
        """Let the threads end."""
        self._threads.shutdown(wait=False, cancel_futures=True)
