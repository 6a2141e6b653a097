"""Work that several processes or machines share is claimed by files that only one can make."""

from __future__ import annotations

import json
import os
import socket
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

__all__ = ["claimed"]

_ABANDONED = 2 * 3600.0  # seconds after which a claim of another machine counts for nothing
_WRITING = 60.0  # seconds that a claim may take to be written


@contextmanager
def claimed(work: Path) -> Iterator[bool]:
    """Claim the work whose result will be the file ``work``; yield whether the claim is ours.

    A claim of a process that is gone, or of another machine two hours ago, is taken over.

    Examples
    --------
    >>> import tempfile
    >>> work = Path(tempfile.mkdtemp()) / "result"
    >>> with claimed(work) as first, claimed(work) as second:
    ...     print(first, second)
    True False
    """
    file = work.with_name(f"{work.name}.claim")
    file.parent.mkdir(parents=True, exist_ok=True)
    if _is_abandoned(file):
        file.unlink(missing_ok=True)
    claim = json.dumps(
        {"host": socket.gethostname(), "process": os.getpid(), "started": _started(os.getpid())}
    )
    try:
        with file.open("x", encoding="utf-8") as stream:
            stream.write(claim)
    except FileExistsError:
        yield False
        return
    try:
        yield True
    finally:
        with suppress(FileNotFoundError):
            if file.read_text(encoding="utf-8") == claim:  # else another took it over
                file.unlink()


def _is_abandoned(file: Path) -> bool:
    try:
        age = time.time() - file.stat().st_mtime
        claim = json.loads(file.read_text(encoding="utf-8"))
        host, process, started = claim["host"], int(claim["process"]), claim.get("started")
    except FileNotFoundError:
        return False
    except (ValueError, KeyError, TypeError, AttributeError):
        return age > _WRITING  # half written by a process that was killed, or just being written
    if host != socket.gethostname():
        return age > _ABANDONED
    try:
        os.kill(process, 0)
    except (ProcessLookupError, OverflowError):
        return True
    except PermissionError:
        pass  # somebody else's process
    now = _started(process)
    return started is not None and now is not None and bool(started != now)


def _started(process: int) -> str | None:
    """When a process began, where the system says so (Linux).

    Numbers of processes are used again, after a restart soon.
    """
    try:
        boot = Path("/proc/sys/kernel/random/boot_id").read_text(encoding="ascii").strip()
        status = Path(f"/proc/{process}/stat").read_text(encoding="utf-8", errors="replace")
        return f"{boot} {status.rpartition(')')[2].split()[19]}"
    except (OSError, UnicodeDecodeError, IndexError):
        return None
