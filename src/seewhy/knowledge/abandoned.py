"""Calls of clingo that were given up and go on in threads, since nothing can end them."""

from __future__ import annotations

import threading

_threads: set[threading.Thread] = set()


def abandon(thread: threading.Thread) -> None:
    """Leave a thread to itself."""
    _threads.add(thread)


def still_working() -> bool:
    """Whether some of them go on.

    A process that then ends in the usual way takes away what they work with, and crashes.
    """
    return any(thread.is_alive() for thread in tuple(_threads))
