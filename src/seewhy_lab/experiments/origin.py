"""Where the rows of a trial come from: version, commit, and the kind of machine."""

from __future__ import annotations

import os
import platform
import subprocess
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

from seewhy_lab.experiments.experiment import Row

__all__ = ["COLUMNS", "Origin", "here", "installed", "one_machine", "say_machine", "say_origins"]

COLUMNS = ("machine", "commit")
"""Columns that say where a row was made; not part of what the trial found."""

_WAIT = 20.0  # seconds for git
_CPUINFO = Path("/proc/cpuinfo")


@dataclass(frozen=True)
class Origin:
    """What made a row.

    Attributes
    ----------
    machine : str
        The kind of machine: two of one kind are as fast, and networks come out the same on them.
        The instruction set that PyTorch computes with is part of it; rows of earlier versions
        lack it, and count as made on another kind.
    commit : str
        The commit, where SeeWhy runs from its git checkout; else its version.
    """

    machine: str
    commit: str


@lru_cache(maxsize=1)
def here() -> Origin:
    """Return what makes rows in this process."""
    return Origin(_machine(), _commit(Path(__file__).resolve().parent))


def _machine() -> str:
    cores = os.cpu_count() or 1
    return f"{_processor(_CPUINFO)}, {cores} core{'s' * (cores > 1)}, {platform.system()}"


def _processor(file: Path) -> str:
    """The processor's name, which virtual machines shorten, its model, and its instruction set."""
    from torch.backends import cpu

    try:
        lines = file.read_text(encoding="utf-8").splitlines()
    except OSError:
        lines = []
    said: dict[str, str] = {}
    for line in lines:
        key, _, value = line.partition(":")
        said.setdefault(key.strip(), value.strip())
    name = said.get("model name") or platform.processor() or platform.machine()
    numbers = [f"{key.split()[-1]} {said[key]}" for key in ("cpu family", "model") if key in said]
    return f"{name} ({', '.join([*numbers, cpu.get_cpu_capability()])})"


def _commit(folder: Path) -> str:
    """The commit of the checkout that a folder is part of, or the version."""
    # A folder that git does not know lies in somebody else's checkout.
    known = _git(folder, "ls-files", "--error-unmatch", "__init__.py") is not None
    commit = _git(folder, "rev-parse", "--short=9", "HEAD") if known else None
    if commit is None:
        return f"version {installed('seewhy')}"
    changed = _git(folder, "status", "--porcelain", "--", "..")
    return f"commit {commit}" + (" with uncommitted changes" if changed else "")


def installed(name: str) -> str:
    """Return the version of a library that is installed.

    Examples
    --------
    >>> installed("no-such-library")
    'not installed'
    """
    try:
        return version(name)
    except PackageNotFoundError:
        return "not installed"


def _git(folder: Path, *arguments: str) -> str | None:
    try:
        found = subprocess.run(
            ["git", "-C", str(folder), *arguments],
            capture_output=True,
            text=True,
            timeout=_WAIT,
            check=True,
        )
    except (OSError, subprocess.SubprocessError):
        return None
    return found.stdout.strip()


def one_machine(rows: Sequence[Row]) -> tuple[list[Row], str]:
    """Return the rows of the kind of machine that made most of them, and its name.

    Times of two kinds are never put together. Rows that do not say where they were made count as
    a kind of their own, "".

    Examples
    --------
    >>> rows, machine = one_machine([{"machine": "a"}, {"machine": "b"}, {"machine": "a"}])
    >>> len(rows), machine
    (2, 'a')
    """
    kinds = Counter(str(row.get("machine", "")) for row in rows)
    if not kinds:
        return [], ""
    machine = kinds.most_common(1)[0][0]
    return [row for row in rows if row.get("machine", "") == machine], machine


def say_machine(rows: Sequence[Row], timed: Sequence[Row], machine: str) -> str:
    """Say of which trials, and of which kind of machine, times are told.

    Parameters
    ----------
    rows : sequence of rows
        All that there are.
    timed : sequence of rows
    machine : str
        See :func:`one_machine`.

    Examples
    --------
    >>> rows = [{"seed": 0, "size": 9, "machine": "a"}, {"seed": 1, "size": 9}]
    >>> say_machine(rows, rows[:1], "a")
    '1 of 2 trials, made on a; times of other machines are left out'
    >>> say_machine(rows[1:], rows[1:], "")
    'the trials, made on a machine that is not recorded'
    """
    made = f"made on {machine or 'a machine that is not recorded'}"
    if len(timed) == len(rows):
        return f"the trials, {made}"
    return (
        f"{_trials(timed)} of {_trials(rows)} trials, {made}; times of other machines are left out"
    )


def _trials(rows: Sequence[Row]) -> int:
    return len({(row["seed"], row["size"]) for row in rows})


def say_origins(rows: Sequence[Row]) -> str:
    """Say which commits made how many trials.

    Examples
    --------
    >>> say_origins([{"seed": 0, "size": 9, "commit": "commit 1ab"}, {"seed": 1, "size": 9}])
    'commit 1ab (1 trial), not recorded (1 trial)'
    """
    made = {(row["seed"], row["size"]): str(row.get("commit", "not recorded")) for row in rows}
    counts = Counter(made.values())
    return ", ".join(f"{name} ({n} trial{'s' * (n > 1)})" for name, n in counts.items())
