"""The files of a folder, without links that lead out of it."""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager
from functools import cached_property
from pathlib import Path
from typing import IO

from seewhy.data.importers.annotation import Notes
from seewhy.data.importers.file_names import RECORD, is_litter, leads_out
from seewhy.data.importers.source_files import DamagedFileError
from seewhy.files.whole_files import lies_in

LINKS_OUT = "links that lead out of the folder, left out (--outside follows them)"

_DEEPEST = 32


class FolderFiles:
    """The files of a folder; links are followed in it, circles of them are not.

    A folder may come from a stranger: links that lead out of it are left out and noted. Datasets
    below it that an import has written are left out.

    Parameters
    ----------
    path : Path
    notes : Notes, optional
        Where it is noted what was left out.
    outside : bool, default False
        Whether links are followed out of the folder, too.

    Examples
    --------
    >>> import tempfile
    >>> home = Path(tempfile.mkdtemp())
    >>> (home / "cats").mkdir()
    >>> (home / "cats" / "first.jpg").touch()
    >>> FolderFiles(home).names
    ['cats/first.jpg']
    """

    def __init__(self, path: Path, notes: Notes | None = None, *, outside: bool = False) -> None:
        self.path = path
        self._notes = Notes() if notes is None else notes
        self._outside = outside

    @cached_property
    def names(self) -> list[str]:
        return sorted(self._files(self.path, "", ()))

    def _files(
        self, folder: Path, prefix: str, above: tuple[tuple[int, int], ...]
    ) -> Iterator[str]:
        here = folder.stat()
        identity = (here.st_dev, here.st_ino)
        if identity in above or len(above) >= _DEEPEST:
            return
        with os.scandir(folder) as entries:
            for entry in entries:
                if is_litter(entry.name):
                    continue
                if entry.is_symlink() and not self._may_follow(Path(entry.path)):
                    self._notes.add(LINKS_OUT, f"{prefix}{entry.name}")
                    continue
                if entry.is_dir():
                    if _is_imported(Path(entry.path)):
                        continue  # what an import has written is not imported again
                    yield from self._files(
                        Path(entry.path), f"{prefix}{entry.name}/", (*above, identity)
                    )
                elif entry.is_file():
                    yield f"{prefix}{entry.name}"

    def _may_follow(self, path: Path) -> bool:
        return self._outside or lies_in(path, self.path)

    @contextmanager
    def open(self, name: str) -> Iterator[IO[bytes]]:
        try:
            stream = (self.path / name).open("rb")
        except OSError as problem:
            raise DamagedFileError(
                f"{self.said(name)}: cannot be read ({problem.strerror})"
            ) from None
        with stream:
            yield stream

    def has(self, name: str) -> bool:
        try:
            path = self.path / name
            return not leads_out(name) and path.is_file() and self._may_follow(path)
        except (OSError, ValueError):
            return False

    def bytes_of(self, name: str) -> int:
        return (self.path / name).stat().st_size

    def changed(self, name: str) -> float:
        return (self.path / name).stat().st_mtime

    def on_disk(self, name: str) -> Path | None:
        return self.path / name

    def said(self, name: str) -> str:
        return str(self.path / name)


def _is_imported(folder: Path) -> bool:
    return (folder / RECORD).is_file()
