"""What the studio remembers of each browser while it runs."""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Callable
from threading import Lock
from typing import Generic, TypeVar

__all__ = ["PerSession"]

MOST = 200
"""Browsers that are remembered."""

Kept = TypeVar("Kept")


class PerSession(Generic[Kept]):
    """One thing for each browser's session, the oldest forgotten.

    Parameters
    ----------
    new : callable
        Makes what a browser has that comes for the first time.

    Examples
    --------
    >>> notes = PerSession[list[str]](list)
    >>> notes.of("ada").append("a")
    >>> notes.of("ada"), notes.of("bob")
    (['a'], [])
    """

    def __init__(self, new: Callable[[], Kept]) -> None:
        self._new = new
        self._of: OrderedDict[str, Kept] = OrderedDict()
        self._lock = Lock()

    def of(self, session: str) -> Kept:
        """What a browser's session has."""
        with self._lock:
            kept = self._of.pop(session) if session in self._of else self._new()
            self._of[session] = kept
            while len(self._of) > MOST:
                self._of.popitem(last=False)
            return kept
