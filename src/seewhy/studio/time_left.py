"""How long a whole training still takes: as long as the last one did, for as many pictures."""

from __future__ import annotations

from collections.abc import Iterable
from datetime import UTC, datetime

from seewhy.studio.jobs import FINISHED, Job

__all__ = ["PICTURES", "WENT_ON", "time_left"]

PICTURES, WENT_ON = "pictures", "went_on"
"""What a training was asked for: how many pictures it trains on, and whether it goes on."""

_FEWEST_SECONDS = 5.0
"""A training that took less says nothing about others."""


def time_left(job: Job, before: Iterable[Job], *, now: datetime | None = None) -> str:
    """Say how long the whole training still takes, and from what that is known.

    Empty where it is not known: no training has finished here, or this one went on where another
    was stopped.

    Parameters
    ----------
    job : Job
        The training that runs.
    before : iterable of Job
        The trainings before it, the last one first.
    now : datetime, optional

    Examples
    --------
    >>> from pathlib import Path
    >>> def training(began, ended, pictures):
    ...     return Job(1, "train", FINISHED, "", "Ada", f"2026-01-01T{began}+00:00",
    ...                f"2026-01-01T{ended}+00:00", {"pictures": pictures}, Path())
    >>> here = training("11:00:00.000", "", 90)
    >>> last = training("10:00:00.000", "10:02:00.000", 60)
    >>> time_left(here, [last], now=datetime(2026, 1, 1, 11, 1, tzinfo=UTC))
    'About 2:00 left in all: the last training took 2:00 for 60 pictures, and this one has 90.'
    >>> time_left(here, [], now=datetime(2026, 1, 1, 11, 1, tzinfo=UTC))
    ''
    """
    pictures = job.asked.get(PICTURES)
    last = next((job for job in before if _is_measure(job)), None)
    if last is None or not pictures or job.asked.get(WENT_ON):
        return ""
    took, of = _seconds(last.started, last.ended), last.asked[PICTURES]
    known = f"the last training took {_clock(took)} for {of} pictures, and this one has {pictures}"
    current = datetime.now(UTC) if now is None else now
    spent = (current - datetime.fromisoformat(job.started)).total_seconds()
    left = took * pictures / of - spent
    if left <= 0:
        return f"It takes longer than was to be expected: {known}."
    return f"About {_clock(left)} left in all: {known}."


def _is_measure(job: Job) -> bool:
    return (
        job.state == FINISHED
        and bool(job.asked.get(PICTURES))
        and not job.asked.get(WENT_ON)
        and _seconds(job.started, job.ended) >= _FEWEST_SECONDS
    )


def _seconds(began: str, ended: str) -> float:
    return (datetime.fromisoformat(ended) - datetime.fromisoformat(began)).total_seconds()


def _clock(seconds: float) -> str:
    minutes, rest = divmod(round(seconds), 60)
    return f"{minutes}:{rest:02}"
