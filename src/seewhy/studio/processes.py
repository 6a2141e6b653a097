"""Processes that outlive whoever started them: found again by their number and when they began."""

from __future__ import annotations

import os
import signal
import subprocess
from contextlib import suppress
from pathlib import Path

__all__ = ["began", "interrupt", "kill"]

_SYSTEM = Path("/proc")
_STATE, _BEGAN = 0, 19
"""Of a process's ``stat``, counted behind its name."""


def began(number: int) -> str:
    """When the process of a number began; empty where there is none, or only its remains.

    Numbers are given again to other processes; together with this text they are not.

    Examples
    --------
    >>> import os
    >>> began(os.getpid()) == began(os.getpid()) != ""
    True
    """
    if (_SYSTEM / "self" / "stat").is_file():
        try:
            told = (_SYSTEM / str(number) / "stat").read_text(errors="replace")
        except OSError:
            return ""
        fields = told.rpartition(")")[2].split()
        return "" if fields[_STATE] in "ZX" else f"{_boot()}{fields[_BEGAN]}"
    try:
        asked = ["ps", "-o", "stat=,lstart=", "-p", str(number)]
        said = subprocess.run(asked, capture_output=True, text=True, check=False).stdout.split()
    except OSError:
        return ""
    return "" if not said or said[0].startswith("Z") else " ".join(said[1:])


def interrupt(session: int) -> None:
    """Interrupt the processes of a session, as Ctrl-C does."""
    _send(session, signal.SIGINT)


def kill(session: int) -> None:
    """End the processes of a session, whatever they are doing."""
    _send(session, signal.SIGKILL if hasattr(signal, "SIGKILL") else signal.SIGTERM)


def _send(session: int, what: signal.Signals) -> None:
    with suppress(ProcessLookupError, PermissionError):
        if hasattr(os, "killpg"):
            os.killpg(session, what)
        else:
            os.kill(session, what)


def _boot() -> str:
    """Which start of the machine this is: processes count from it."""
    try:
        return (_SYSTEM / "sys/kernel/random/boot_id").read_text().strip() + "-"
    except OSError:
        return ""
