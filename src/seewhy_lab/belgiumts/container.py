"""Where files lie, a zip archive or a folder: their names, and their bytes when asked for."""

from __future__ import annotations

import lzma
import os
import zipfile
import zlib
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Protocol

from seewhy.errors import DatasetError
from seewhy.files.whole_files import lies_in

LARGEST_FILE = 64 * 2**20
"""Bytes of the largest file that is read; a photograph of a sign has less than one megabyte."""

_DEEPEST = 3


class DamagedFileError(DatasetError):
    """One file in a container cannot be read; the others may be well."""


class Container(Protocol):
    """Files by the names they have from the container: "Training/00021/01153_00000.ppm"."""

    @property
    def path(self) -> Path:
        """The archive or folder."""
        ...

    def names(self) -> list[str]:
        """The names of all files, sorted, with "/" between the folders."""
        ...

    def read(self, name: str) -> bytes:
        """The bytes of a file; raise a DamagedFileError where they cannot be had."""
        ...


class Folder:
    """A folder; its files are sought down to three folders below it.

    Examples
    --------
    >>> import tempfile
    >>> home = Path(tempfile.mkdtemp())
    >>> (home / "note.txt").touch()
    >>> Folder(home).names()
    ['note.txt']
    """

    def __init__(self, path: Path) -> None:
        self.path = path

    def names(self) -> list[str]:
        return sorted(self._files(self.path, depth=0))

    def _files(self, folder: Path, *, depth: int) -> Iterator[str]:
        with os.scandir(folder) as entries:
            for entry in entries:
                if entry.name.startswith("."):
                    continue
                if entry.is_symlink() and not lies_in(entry.path, self.path):
                    raise DatasetError(
                        f"{entry.path}: is a link that leads out of {self.path}; put what it leads "
                        "to in its place"
                    )
                if entry.is_file():
                    yield Path(entry.path).relative_to(self.path).as_posix()
                elif entry.is_dir() and depth < _DEEPEST:
                    yield from self._files(Path(entry.path), depth=depth + 1)

    def read(self, name: str) -> bytes:
        try:
            with (self.path / name).open("rb") as stream:
                content = stream.read(LARGEST_FILE + 1)
        except OSError as problem:
            raise DamagedFileError(f"cannot be read ({problem.strerror})") from None
        return _of_fair_size(content)


class Archive:
    """A zip archive; nothing is unpacked to disk, and no file of it is read beyond 64 MiB.

    Raises
    ------
    DatasetError
        If the file is no zip archive, or a name in it leads out of it.
    """

    def __init__(self, path: Path) -> None:
        self.path = path
        try:
            self._zip = zipfile.ZipFile(path)
        except (zipfile.BadZipFile, ValueError, NotImplementedError, EOFError) as problem:
            raise DatasetError(
                f"{path}: is no zip archive, or was cut short ({problem}); download it again"
            ) from None

    def close(self) -> None:
        self._zip.close()

    def names(self) -> list[str]:
        names = [
            member.filename
            for member in self._zip.infolist()
            if not member.is_dir() and not _is_hidden(member.filename)
        ]
        for name in names:
            if _leads_out(name):
                raise DatasetError(
                    f"{self.path}: a file in the archive is named '{name}', which leads out of "
                    "it; this is not the official archive, download that one"
                )
        return sorted(names)

    def read(self, name: str) -> bytes:
        try:
            with self._zip.open(name) as stream:
                content = stream.read(LARGEST_FILE + 1)
        except (zipfile.BadZipFile, zlib.error, lzma.LZMAError, EOFError, OSError) as problem:
            raise DamagedFileError(f"is damaged in the archive ({problem})") from None
        except (RuntimeError, NotImplementedError):
            raise DamagedFileError(
                "is encrypted in the archive, or packed by an unusual method"
            ) from None
        return _of_fair_size(content)


@contextmanager
def open_container(path: Path) -> Iterator[Container]:
    """Yield the container of a path.

    Raises
    ------
    DatasetError
        If there is nothing at the path, or a file that is no zip archive.

    Examples
    --------
    >>> import tempfile
    >>> with open_container(Path(tempfile.mkdtemp())) as container:
    ...     container.names()
    []
    """
    if path.is_dir():
        yield Folder(path)
        return
    if not path.exists():
        raise DatasetError(f"{path}: there is no such file or folder; check the path")
    archive = Archive(path)
    try:
        yield archive
    finally:
        archive.close()


def _of_fair_size(content: bytes) -> bytes:
    if len(content) > LARGEST_FILE:
        raise DamagedFileError(f"has more than {LARGEST_FILE // 2**20} MiB")
    return content


def _is_hidden(name: str) -> bool:
    return any(
        part.startswith("__MACOSX") or (part.startswith(".") and part.strip("."))
        for part in name.split("/")
    )


def _leads_out(name: str) -> bool:
    parts = name.replace("\\", "/").split("/")
    return ".." in parts or parts[0] == "" or parts[0].endswith(":")
