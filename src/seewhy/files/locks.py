"""What only one process at a time may write; the lock of a process that was killed is free."""

from __future__ import annotations

import errno
import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from seewhy.errors import BusyError

if sys.platform != "win32":
    import fcntl

__all__ = ["is_free", "locked", "opened_alone", "sole_writer"]

_WITHOUT_LOCKS = {errno.ENOLCK, errno.ENOSYS, errno.EOPNOTSUPP}


@contextmanager
def locked(work: Path, *, wait: bool = False) -> Iterator[bool]:
    """Lock what is to be written to ``work``; yield whether the lock is ours.

    The lock is the system's, on a file beside ``work``: it ends with its process, however that
    ends, and holds for all machines that see the folder, where their file system has locks.

    Parameters
    ----------
    work : Path
        A file or a folder; it need not be there.
    wait : bool, default False
        Whether to wait for the lock where somebody else has it.

    Examples
    --------
    >>> import tempfile
    >>> work = Path(tempfile.mkdtemp()) / "result"
    >>> with locked(work) as first, locked(work) as second:
    ...     print(first, second)
    True False
    """
    work.parent.mkdir(parents=True, exist_ok=True)
    file = work.with_name(f".{work.name}.lock")
    descriptor = opened_alone(file, wait=wait)
    if descriptor is None:
        yield False
        return
    try:
        yield True
    finally:
        file.unlink(missing_ok=True)
        os.close(descriptor)


@contextmanager
def sole_writer(work: Path) -> Iterator[None]:
    """Lock ``work`` as :func:`locked` does.

    Raises
    ------
    BusyError
        Somebody else has the lock.
    """
    with locked(work) as ours:
        if not ours:
            raise BusyError(
                f"{work}: another run is writing it; wait until that has ended, or choose another "
                "name"
            )
        yield


def opened_alone(file: Path, *, wait: bool) -> int | None:
    """Return the descriptor of a file that nobody else has opened so; it is made where missing.

    None where somebody has and ``wait`` is false. Whoever closes it lets others in.
    """
    while True:
        descriptor = os.open(file, os.O_RDWR | os.O_CREAT, 0o666)
        try:
            if not _taken(descriptor, wait=wait):
                os.close(descriptor)
                return None
            # Whoever had it before may have removed or renamed the file since it was opened.
            with suppress(FileNotFoundError):
                if os.path.samestat(os.fstat(descriptor), file.stat()):
                    return descriptor
        except BaseException:
            os.close(descriptor)
            raise
        os.close(descriptor)


def is_free(descriptor: int) -> bool:
    """Take the lock of an open file or folder; return whether that could be done."""
    return _taken(descriptor, wait=False)


def _taken(descriptor: int, *, wait: bool) -> bool:
    if sys.platform == "win32":
        return True
    try:
        fcntl.flock(descriptor, fcntl.LOCK_EX | (0 if wait else fcntl.LOCK_NB))
    except BlockingIOError:
        return False
    except OSError as problem:
        # Where there are no locks, what is written twice is written alike.
        if problem.errno not in _WITHOUT_LOCKS:
            raise
    return True
