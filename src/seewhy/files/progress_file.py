"""How far long work is, in a file that another process reads."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from pathlib import Path

from seewhy.files.whole_files import write_whole

__all__ = ["PROGRESS_FILE", "Progress", "Stage", "read_progress", "write_progress"]

PROGRESS_FILE = "SEEWHY_PROGRESS_FILE"
"""The environment variable with the name of the file, for commands that are started."""


@dataclass(frozen=True)
class Stage:
    """A part of the work that is under way.

    Attributes
    ----------
    what : str
        In words.
    done : int
    total : int or None
        None where it is not known.
    seconds_left : float or None
        None where it cannot be told yet.
    """

    what: str
    done: int
    total: int | None = None
    seconds_left: float | None = None


@dataclass(frozen=True)
class Progress:
    """How far work is: its stages that are under way, and the seconds since it began."""

    stages: tuple[Stage, ...]
    seconds: float


def write_progress(file: Path, stages: Sequence[Stage], *, seconds: float) -> None:
    """Write how far work is, whole; a file that cannot be written ends no work."""
    text = json.dumps({"stages": [asdict(stage) for stage in stages], "seconds": seconds})
    try:
        write_whole(file, text, durable=False)
    except OSError:
        return


def read_progress(file: Path) -> Progress | None:
    """Read how far work is; None where nothing is said yet.

    Examples
    --------
    >>> import tempfile
    >>> file = Path(tempfile.mkdtemp()) / "progress.json"
    >>> write_progress(file, [Stage("colour", 3, 12)], seconds=1.5)
    >>> found = read_progress(file)
    >>> found.stages[0].total, found.seconds
    (12, 1.5)
    """
    try:
        told = json.loads(file.read_text(encoding="utf-8"))
        return Progress(tuple(Stage(**stage) for stage in told["stages"]), float(told["seconds"]))
    except (OSError, ValueError, KeyError, TypeError):
        return None
