"""Files are written whole or not at all, and folders are not left through links."""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from seewhy.files.locks import opened_alone

__all__ = ["put_all_on_disk", "put_on_disk", "whole_file", "write_whole"]


@contextmanager
def whole_file(path: Path | str, *, durable: bool = True) -> Iterator[Path]:
    """Yield a temporary path beside ``path`` that takes its place when the block ends well.

    When the block raises (an interruption included), the temporary file is removed and what
    stood at ``path`` before is untouched. What a killed process left is taken over by the next
    that writes ``path``; of several that write it at a time, one waits for the other.

    Parameters
    ----------
    path : Path or str
    durable : bool, default True
        Whether the file is on the disk, and not only in the system's memory, before it stands at
        ``path``. Files by the thousand wait for the disk together, see :func:`put_all_on_disk`.

    Examples
    --------
    >>> import tempfile
    >>> target = Path(tempfile.mkdtemp()) / "note.txt"
    >>> with whole_file(target) as temporary:
    ...     _ = temporary.write_text("done")
    >>> target.read_text()
    'done'
    """
    target = Path(path)
    target.parent.mkdir(parents=True, exist_ok=True)
    temporary = target.with_name(f".{target.stem}-new{target.suffix}")
    descriptor = opened_alone(temporary, wait=True)
    assert descriptor is not None
    try:
        try:
            os.truncate(descriptor, 0)
            yield temporary
            if durable:
                put_on_disk(temporary)
            temporary.replace(target)
        except BaseException:
            temporary.unlink(missing_ok=True)
            raise
        if durable:
            put_on_disk(target.parent)
    finally:
        os.close(descriptor)


def put_on_disk(*paths: Path) -> None:
    """Wait until files, or which names stand in folders, are on the disk."""
    for path in paths:
        if path.is_dir() and os.name == "nt":
            continue  # there a folder cannot be opened, and is on the disk with its files
        descriptor = os.open(path, os.O_RDONLY)
        try:
            os.fsync(descriptor)
        finally:
            os.close(descriptor)


def put_all_on_disk() -> None:
    """Wait until all that was written before is on the disk: for files by the thousand."""
    if hasattr(os, "sync"):
        os.sync()


def write_whole(path: Path | str, content: str | bytes, *, durable: bool = True) -> None:
    """Write ``content`` to ``path`` in one step; see :func:`whole_file`.

    Examples
    --------
    >>> import tempfile
    >>> target = Path(tempfile.mkdtemp()) / "note.txt"
    >>> write_whole(target, "done")
    >>> target.read_text()
    'done'
    """
    with whole_file(path, durable=durable) as temporary:
        if isinstance(content, bytes):
            temporary.write_bytes(content)
        else:
            temporary.write_text(content, encoding="utf-8")


def lies_in(path: Path | str, folder: Path | str) -> bool:
    """Whether a path lies in a folder, wherever links lead; not where they may not be looked at.

    Examples
    --------
    >>> import tempfile
    >>> folder = Path(tempfile.mkdtemp()) / "photos"
    >>> folder.mkdir()
    >>> (folder / "link").symlink_to("..")
    >>> [lies_in(folder / name, folder) for name in ("a.png", "../a.png", "link/a.png")]
    [True, False, False]
    """
    root = os.path.realpath(folder)
    try:
        real = os.path.realpath(path)
    except OSError:
        return False
    return real == root or real.startswith(root.rstrip(os.sep) + os.sep)
