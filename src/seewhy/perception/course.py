"""How a training is run: nothing of it changes what comes of the training."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

__all__ = ["QUIETLY", "Course"]


@dataclass(frozen=True, kw_only=True)
class Course:
    """How a training is run; the weights do not depend on it.

    Attributes
    ----------
    checkpoints : Path or None
        A folder in which an interrupted training finds where it was. Remove it when what was
        trained is saved.
    workers : int
        Features trained at the same time, each in a process of its own, and processes that draw
        pictures; -1: one a core.
    on_picture : callable or None
        Called with the number of pictures drawn so far.
    on_progress : callable or None
        Called with a :class:`~seewhy.perception.events.TrainingEvent` after every epoch of a
        network, or with an :class:`~seewhy.perception.events.EyesEvent` where eyes are taught.

    Examples
    --------
    >>> Course(workers=1).checkpoints is None
    True
    """

    checkpoints: Path | None = None
    workers: int = -1
    on_picture: Callable[[int], None] | None = None
    on_progress: Callable[[Any], None] | None = None


QUIETLY = Course()
"""On all cores, without checkpoints, and nobody is told."""
