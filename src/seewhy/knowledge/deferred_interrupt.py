"""Hear Ctrl-C after a call, and not within the functions that clingo calls while it works.

An exception that such a function raises cannot pass through clingo, which then ends the process.
"""

from __future__ import annotations

import signal
import threading
from types import TracebackType
from typing import Self


class DeferredInterrupt:
    """A block at whose end Ctrl-C is heard; other threads than the main one never hear it.

    Examples
    --------
    >>> done = []
    >>> try:
    ...     with DeferredInterrupt():
    ...         signal.raise_signal(signal.SIGINT)
    ...         done.append("all of it")
    ... except KeyboardInterrupt:
    ...     done.append("interrupted")
    >>> done
    ['all of it', 'interrupted']
    """

    def __enter__(self) -> Self:
        self._heard = False
        self._usual = None
        if threading.current_thread() is threading.main_thread():
            usual = signal.getsignal(signal.SIGINT)
            if callable(usual):
                self._usual = usual
                signal.signal(signal.SIGINT, self._hear)
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        problem: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        if self._usual is not None:
            signal.signal(signal.SIGINT, self._usual)
            if self._heard:
                self._usual(signal.SIGINT, None)

    def _hear(self, *_: object) -> None:
        self._heard = True
