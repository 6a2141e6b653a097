"""The studio, or a served model, as anybody starts it: a process of its own at a free port."""

from __future__ import annotations

import re
import shutil
import subprocess
import sys
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path

__all__ = ["chromium", "running_server", "running_studio"]

_LONGEST = 120.0
"""Seconds until it says where it is."""


def chromium() -> str:
    """Where the browser is.

    Raises
    ------
    SystemExit
        If there is none.
    """
    found = shutil.which("chromium") or shutil.which("chromium-browser")
    if found is None:
        raise SystemExit("there is no Chromium; apt install chromium")
    return found


@contextmanager
def running_studio(folder: Path, log: Path) -> Iterator[str]:
    """Yield the address of a studio on a folder; what it says goes to the file ``log``.

    Raises
    ------
    SystemExit
        If it does not begin.
    """
    with running_server(["studio", str(folder), "--no-browser"], log) as (address, _):
        yield address


@contextmanager
def running_server(arguments: Sequence[str], log: Path) -> Iterator[tuple[str, int]]:
    """Yield the address and the process of a command that serves; what it says goes to ``log``.

    Raises
    ------
    SystemExit
        If it does not begin.
    """
    command = [sys.executable, "-m", "seewhy", *arguments, "--port", "0"]
    with log.open("w", encoding="utf-8") as written:
        process = subprocess.Popen(command, stdout=written, stderr=subprocess.STDOUT)
    try:
        yield _address(process, log), process.pid
    finally:
        process.terminate()
        process.wait(timeout=60)


def _address(process: subprocess.Popen[bytes], log: Path) -> str:
    ends = time.monotonic() + _LONGEST
    while time.monotonic() < ends and process.poll() is None:
        found = re.search(r"http://[^\s;,]+(?=[\s;,])", log.read_text(encoding="utf-8"))
        if found is not None:
            return found[0].rstrip("/")
        time.sleep(0.1)
    raise SystemExit(f"the server did not begin: {log.read_text(encoding='utf-8').strip()}")
