"""Folders are written whole or not at all, and what killed processes left is cleared away."""

from __future__ import annotations

import ctypes
import os
import shutil
import sys
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from seewhy.files.locks import is_free, locked
from seewhy.files.whole_files import put_on_disk

__all__ = ["scratch_folder", "settle_folder", "whole_folder"]

_EXCHANGE = 2  # the flag RENAME_EXCHANGE of Linux's renameat2
_HERE = -100  # AT_FDCWD: paths are from the working folder
_SCRATCH = "seewhy-scratch-"


@contextmanager
def whole_folder(folder: Path, *, replacing: bool = False) -> Iterator[Path]:
    """Yield a temporary folder beside ``folder`` that takes its place when the block ends well.

    Whenever the process is killed, the folder that stood there or the new one stands whole under
    the name, or :func:`settle_folder` puts it there. What a killed process left is removed by the
    next that writes the folder; one that writes it at the same time waits.

    Parameters
    ----------
    folder : Path
    replacing : bool, default False
        Whether a folder of this name, with all that is in it, is replaced; else it is an error.

    Raises
    ------
    FileExistsError
        There is such a folder, and it is not to be replaced.

    Examples
    --------
    >>> target = Path(tempfile.mkdtemp()) / "notes"
    >>> with whole_folder(target) as temporary:
    ...     _ = (temporary / "a.txt").write_text("done")
    >>> [file.name for file in target.iterdir()]
    ['a.txt']
    >>> [folder.name for folder in target.parent.iterdir()]
    ['notes']
    """
    target = _place_of(folder)
    temporary = target.with_name(f".{target.name}-new")
    with locked(target, wait=True):
        _settle(target)
        shutil.rmtree(temporary, ignore_errors=True)
        temporary.mkdir()
        try:
            yield temporary
            for inside, _, names in os.walk(temporary):
                put_on_disk(*(Path(inside) / name for name in names), Path(inside))
            if not target.exists():
                temporary.rename(target)
            elif not replacing:
                raise FileExistsError(17, "there is such a folder already", str(folder))
            elif not _exchanged(temporary, target):
                _replace_in_two_steps(temporary, target)
            put_on_disk(target.parent)
        finally:
            shutil.rmtree(temporary, ignore_errors=True)


def settle_folder(folder: Path) -> None:
    """Put a folder back under its name that a killed process had set aside to replace it.

    Examples
    --------
    >>> target = Path(tempfile.mkdtemp()) / "notes"
    >>> _aside(target).mkdir()
    >>> settle_folder(target)
    >>> target.is_dir(), _aside(target).exists()
    (True, False)
    """
    target = _place_of(folder)
    if not target.exists() and _aside(target).is_dir():
        # Who may not write here reads that the folder is missing.
        with suppress(OSError), locked(target, wait=True):
            _settle(target)


def _place_of(folder: Path) -> Path:
    """The folder that a link leads to: it is replaced, and the link stays."""
    return Path(os.path.realpath(folder)) if folder.is_symlink() or not folder.name else folder


def _settle(target: Path) -> None:
    aside = _aside(target)
    if aside.is_dir() and not target.exists():
        aside.rename(target)
    shutil.rmtree(aside, ignore_errors=True)


def _aside(target: Path) -> Path:
    return target.with_name(f".{target.name}-old")


def _exchanged(one: Path, other: Path) -> bool:
    """Exchange two folders in one step; False where the system or its disk cannot."""
    if not sys.platform.startswith("linux"):
        return False
    try:
        exchange = ctypes.CDLL(None).renameat2
    except (OSError, AttributeError):
        return False
    code = exchange(_HERE, os.fsencode(one), _HERE, os.fsencode(other), _EXCHANGE)
    return bool(code == 0)


def _replace_in_two_steps(new: Path, target: Path) -> None:
    aside = _aside(target)
    try:
        target.rename(aside)
        new.rename(target)
    except BaseException:
        _settle(target)
        raise
    shutil.rmtree(aside, ignore_errors=True)


@contextmanager
def scratch_folder() -> Iterator[Path]:
    """Yield a folder for what is needed for a while; it is removed when the block ends.

    So are those that killed processes of the same user left.

    Examples
    --------
    >>> with scratch_folder() as folder:
    ...     folder.is_dir()
    True
    >>> folder.exists()
    False
    """
    _remove_abandoned()
    while True:
        folder = Path(tempfile.mkdtemp(prefix=_SCRATCH))
        descriptor = _locked_folder(folder)
        if descriptor is not None:
            break
    try:
        yield folder
    finally:
        shutil.rmtree(folder, ignore_errors=True)
        if descriptor >= 0:
            os.close(descriptor)


def _remove_abandoned() -> None:
    if os.name == "nt":
        return  # there a folder has no lock, which would tell that its process is alive
    for folder in Path(tempfile.gettempdir()).glob(f"{_SCRATCH}*"):
        with suppress(OSError):
            if folder.is_symlink() or folder.stat().st_uid != os.getuid():
                continue
            descriptor = _locked_folder(folder)
            if descriptor is not None:
                shutil.rmtree(folder, ignore_errors=True)
                os.close(descriptor)


def _locked_folder(folder: Path) -> int | None:
    """The descriptor of a folder, locked; None where it is another's or gone."""
    if os.name == "nt":
        return -1
    try:
        descriptor = os.open(folder, os.O_RDONLY | os.O_DIRECTORY)
    except FileNotFoundError:
        return None
    if is_free(descriptor) and folder.is_dir():
        return descriptor
    os.close(descriptor)
    return None
