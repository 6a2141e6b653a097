"""Compute on one thread of PyTorch's, where several would wait for each other."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

import torch


@contextmanager
def one_thread() -> Iterator[None]:
    """Run a block on one thread.

    Small steps, such as a sentence or a single picture, are so short that threads spend longer
    waiting for each other than computing: several times the whole on a quiet machine, a hundred
    times when other programs want the cores too.

    Examples
    --------
    >>> with one_thread():
    ...     torch.get_num_threads()
    1
    """
    before = torch.get_num_threads()
    torch.set_num_threads(1)
    try:
        yield
    finally:
        torch.set_num_threads(before)
