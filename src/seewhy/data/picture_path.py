"""Where the picture of a row lies: in the folder of its table, unless more is allowed."""

from __future__ import annotations

import os
import stat
from collections.abc import Callable
from errno import EACCES, ELOOP, ENAMETOOLONG
from pathlib import Path

from seewhy.errors import DatasetError
from seewhy.files.whole_files import lies_in

__all__ = ["picture_finder", "require_own_table"]

_SHOWN = 160
"""Of longer paths, the beginning is shown."""


def picture_finder(folder: Path, *, outside: bool = False) -> Callable[[str, str], Path]:
    """Return a function that finds a row's picture: of its cell and where that stands.

    A table may come from a stranger. What is named by an absolute path, by ``..`` or through a
    link must lie in ``folder`` all the same, unless ``outside`` allows more: nothing out there is
    looked at, not even whether it exists.

    Parameters
    ----------
    folder : Path
    outside : bool, default False

    Returns
    -------
    callable
        Of the cell and its place for errors; raises a DatasetError where there is no such file.

    Examples
    --------
    >>> import tempfile
    >>> folder = Path(tempfile.mkdtemp())
    >>> (folder / "a.png").touch()
    >>> find = picture_finder(folder)
    >>> find("a.png", "scenes.csv:2").name
    'a.png'
    >>> find("../b.png", "scenes.csv:3").name  # doctest: +ELLIPSIS
    Traceback (most recent call last):
    ...
    seewhy.errors.DatasetError: scenes.csv:3: the picture '../b.png' lies outside of ...
    """
    root = os.path.realpath(folder)
    below = root.rstrip(os.sep) + os.sep
    directories: dict[str, tuple[Path, bool]] = {}

    def directory(cell: str) -> tuple[Path, bool]:
        """The directory of a cell, and whether it lies in the folder, whatever links say."""
        if cell not in directories:
            path = folder / cell
            real = os.path.realpath(path)
            directories[cell] = path, real == root or real.startswith(below)
        return directories[cell]

    def existing(cell: str, here: str) -> Path | None:
        before, _, name = cell.rpartition("/")
        parent, inside = directory("/" if cell.startswith("/") and not before else before)
        path = parent / name
        if name in ("", ".", ".."):
            path, inside = directory(cell)
        if inside or outside:
            try:
                mode = os.lstat(path).st_mode
                if stat.S_ISLNK(mode):
                    inside = os.path.realpath(path).startswith(below)
                    mode = os.stat(path).st_mode if inside or outside else mode  # noqa: PTH116
            except (FileNotFoundError, NotADirectoryError):
                return None
        if not inside and not outside:
            raise DatasetError(
                f"{here}: the picture '{_shown(cell)}' lies outside of {folder}; copy it into the "
                "folder, or allow it with --outside (in Python: outside=True)"
            )
        if stat.S_ISDIR(mode):
            raise DatasetError(
                f"{here}: '{_shown(cell)}' is a folder, not a picture; name a picture in it"
            )
        if not stat.S_ISREG(mode):
            raise DatasetError(f"{here}: '{_shown(cell)}' is no file; name a picture's file")
        return path

    def find(cell: str, here: str) -> Path:
        try:
            found = existing(cell, here)
            if found is None and "\\" in cell:
                found = existing(cell.replace("\\", "/"), here)
        except DatasetError:
            raise
        except (OSError, ValueError) as problem:
            raise DatasetError(f"{here}: {_unreadable(cell, problem)}") from None
        if found is None:
            remedy = "use / in paths, and correct it" if "\\" in cell else "correct the path"
            raise DatasetError(
                f"{here}: there is no picture '{_shown(cell)}' in {folder}; {remedy} or remove "
                "the row"
            )
        return found

    return find


def require_own_table(file: Path, *, outside: bool = False) -> None:
    """Raise a DatasetError if the table of a folder is a link that leads out of it.

    Complaints about a table show cells of it, and what lies out there is nobody's table.
    """
    if not outside and not lies_in(file, file.parent):
        raise DatasetError(
            f"{file}: is a link that leads out of the folder; copy the table into it, or allow it "
            "with --outside (in Python: outside=True)"
        )


def _unreadable(cell: str, problem: OSError | ValueError) -> str:
    shown = _shown(cell)
    code = problem.errno if isinstance(problem, OSError) else None
    if code == ENAMETOOLONG:
        return (
            f"the picture's path '{shown}' has {len(cell)} characters, more than a file can have; "
            "shorten the name"
        )
    if code == ELOOP:
        return f"the picture '{shown}' is a link to itself; replace it by the picture"
    if code == EACCES:
        return f"the picture '{shown}' may not be read; check the rights of its folder"
    return f"the picture's path '{shown}' cannot be used ({problem}); correct it"


def _shown(cell: str) -> str:
    printable = "".join(letter if letter.isprintable() else "�" for letter in cell)
    return printable if len(printable) <= _SHOWN else f"{printable[:_SHOWN]}…"
