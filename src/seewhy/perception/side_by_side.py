"""Pieces of work side by side, a thread for each, instead of threads within each."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any, TypeVar

import numpy as np
import numpy.typing as npt
import torch

from seewhy.perception.one_thread import one_thread

__all__ = ["Threads", "even_pieces", "side_by_side", "single_core_threads", "threads"]

Piece = TypeVar("Piece")
Result = TypeVar("Result")
Rows = npt.NDArray[Any]


@dataclass(frozen=True)
class Threads:
    """Does the same with each of several pieces; see :func:`threads`."""

    pool: ThreadPoolExecutor | None

    def map(self, work: Callable[[Piece], Result], pieces: Sequence[Piece]) -> list[Result]:
        """What ``work`` makes of each piece."""
        if self.pool is None:
            return [work(piece) for piece in pieces]
        return list(self.pool.map(work, pieces))


@contextmanager
def threads(count: int) -> Iterator[Threads]:
    """Run a block with threads of one core each, or with one core where there is one thread.

    Examples
    --------
    >>> with threads(2) as two:
    ...     two.map(lambda number: number * number, [1, 2, 3])
    [1, 4, 9]
    """
    with one_thread():
        if count < 2:
            yield Threads(None)
            return
        with single_core_threads(count) as pool:
            yield Threads(pool)


def single_core_threads(count: int, *, name: str = "") -> ThreadPoolExecutor:
    """Threads in each of which PyTorch computes on one core.

    Parameters
    ----------
    count : int
    name : str, optional
        How the threads are called.
    """
    return ThreadPoolExecutor(
        count, thread_name_prefix=name, initializer=lambda: torch.set_num_threads(1)
    )


def side_by_side(work: Callable[[Piece], Result], pieces: Sequence[Piece]) -> list[Result]:
    """What ``work`` makes of each piece, on as many threads as PyTorch has.

    A thread that has a piece of its own waits for no other: half the time of threads that share
    every operation, and a tenth where other programs want the cores too.

    Examples
    --------
    >>> side_by_side(lambda number: number * number, [1, 2, 3])
    [1, 4, 9]
    """
    with threads(min(torch.get_num_threads(), len(pieces))) as several:
        return several.map(work, pieces)


def even_pieces(rows: Rows, *, most: int) -> list[Rows]:
    """Rows in pieces of nearly the same size, at most so many each; every thread gets as many.

    Examples
    --------
    >>> from seewhy.perception.one_thread import one_thread
    >>> with one_thread():
    ...     [len(piece) for piece in even_pieces(np.arange(25), most=8)]
    [7, 6, 6, 6]
    """
    several = torch.get_num_threads()
    count = -(-len(rows) // most)  # so many at least
    count = min(len(rows), -(-count // several) * several)
    return np.array_split(rows, count) if count else []
