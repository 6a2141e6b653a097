"""Files are written whole or not at all, and folders are not left through links."""

from __future__ import annotations

import os
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path


@contextmanager
def whole_file(path: Path | str) -> Iterator[Path]:
    """Yield a temporary path beside ``path`` that takes its place when the block ends well.

    When the block raises (an interruption included), the temporary file is removed and what
    stood at ``path`` before is untouched.

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
    descriptor, name = tempfile.mkstemp(
        prefix=f".{target.stem}-", suffix=target.suffix, dir=target.parent
    )
    os.close(descriptor)
    temporary = Path(name)
    try:
        yield temporary
        # mkstemp gives 0600; a file that others may read is what a plain open would have made.
        umask = os.umask(0)
        os.umask(umask)
        temporary.chmod(0o666 & ~umask)
        temporary.replace(target)
    finally:
        temporary.unlink(missing_ok=True)


def write_whole(path: Path | str, content: str | bytes) -> None:
    """Write ``content`` to ``path`` in one step.

    Examples
    --------
    >>> import tempfile
    >>> target = Path(tempfile.mkdtemp()) / "note.txt"
    >>> write_whole(target, "done")
    >>> target.read_text()
    'done'
    """
    with whole_file(path) as temporary:
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
