"""Files read by several threads, in order and not all at once."""

from __future__ import annotations

import os
from collections import deque
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import Future, ThreadPoolExecutor
from itertools import islice
from typing import TypeVar

__all__ = ["read_ahead"]

Item = TypeVar("Item")
Result = TypeVar("Result")


def read_ahead(
    function: Callable[[Item], Result], items: Iterable[Item], *, ahead: int = 64
) -> Iterator[Result]:
    """Yield ``function`` of every item, in their order, with at most ``ahead`` results waiting.

    It pays where the function spends its time in files and decoders, which let other threads run.

    Examples
    --------
    >>> list(read_ahead(abs, [-1, 2, -3], ahead=2))
    [1, 2, 3]
    """
    remaining = iter(items)
    pool = ThreadPoolExecutor(os.cpu_count() or 1)
    waiting: deque[Future[Result]] = deque()
    try:
        waiting.extend(pool.submit(function, item) for item in islice(remaining, ahead))
        while waiting:
            yield waiting.popleft().result()
            waiting.extend(pool.submit(function, item) for item in islice(remaining, 1))
    finally:
        pool.shutdown(wait=True, cancel_futures=True)
