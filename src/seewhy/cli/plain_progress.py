"""How far long work is, where there is no terminal to draw a bar on: a line now and then."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from threading import Event, Thread
from time import monotonic

from rich.progress import Progress, Task

from seewhy.files.progress_file import PROGRESS_FILE, Stage, write_progress

__all__ = ["SECONDS", "SECONDS_NAMED", "telling_plainly"]

SECONDS = 10.0
"""Between two lines; work that is over sooner says nothing."""

SECONDS_NAMED = "SEEWHY_PROGRESS_SECONDS"
"""The environment's name for another number of seconds; no number above 0 is passed over."""

_LOOKS = 1.0
"""Seconds between two looks at the work."""

_SHOWN = 4
"""Stages that a line names, of work that goes on side by side."""


@contextmanager
def telling_plainly(
    bars: Progress, tell: Callable[[str], None], *, seconds: float | None = None
) -> Iterator[None]:
    """Tell of work while it goes on; in the file that the environment names instead, if it does."""
    ended = Event()
    seconds = _seconds_named() if seconds is None else seconds
    named = os.environ.get(PROGRESS_FILE)
    file = Path(named) if named else None
    look = min(_LOOKS, seconds)

    def keep_telling() -> None:
        start = said = monotonic()
        while not ended.wait(look):
            stages = _stages(bars)
            now = monotonic()
            if file is not None:
                write_progress(file, stages, seconds=now - start)
            elif now - said >= seconds:
                said = now
                tell(_line(stages, now - start))

    thread = Thread(target=keep_telling, daemon=True)
    thread.start()
    try:
        yield
    finally:
        ended.set()
        thread.join()


def _seconds_named() -> float:
    try:
        seconds = float(os.environ.get(SECONDS_NAMED, SECONDS))
    except ValueError:
        return SECONDS
    return seconds if seconds > 0 else SECONDS


def _stages(bars: Progress) -> list[Stage]:
    return [
        Stage(
            task.description,
            int(task.completed),
            None if task.total is None else int(task.total),
            task.time_remaining,
        )
        for task in bars.tasks
        if _is_under_way(task)
    ]


def _is_under_way(task: Task) -> bool:
    return task.visible and not task.finished and (task.total is not None or task.completed > 0)


def _line(stages: list[Stage], seconds: float) -> str:
    told = []
    for stage in stages[:_SHOWN]:
        of = "" if stage.total is None else f" of {stage.total:,}"
        left = "" if stage.seconds_left is None else f", {_clock(stage.seconds_left)} left"
        told.append(f"{stage.what}: {stage.done:,}{of}{left}")
    more = f"; {len(stages) - _SHOWN} more" if len(stages) > _SHOWN else ""
    return f"{'; '.join(told) or 'working'}{more} (since {_clock(seconds)})"


def _clock(seconds: float) -> str:
    minutes, rest = divmod(round(seconds), 60)
    hours, minutes = divmod(minutes, 60)
    return f"{hours}:{minutes:02}:{rest:02}"
