"""The files of a zip archive, read from where they are."""

from __future__ import annotations

import lzma
import stat
import zipfile
import zlib
from collections.abc import Iterator
from contextlib import contextmanager
from functools import cached_property
from pathlib import Path, PurePosixPath
from typing import IO

from seewhy.data.importers.annotation import Notes
from seewhy.data.importers.file_names import is_litter, leads_out
from seewhy.data.importers.source_files import DamagedFileError
from seewhy.errors import DatasetError

_DAMAGED_MEMBER = (zipfile.BadZipFile, zlib.error, lzma.LZMAError, EOFError)
"""What reading a member of a zip archive raises where it is damaged, however it is packed."""

_MOST_FILES = 5_000_000
_BOMB_RATIO = 200
_BOMB_BYTES = 64 * 2**20


class ZipFiles:
    """The files of a zip archive, read from where they are; links in it are not followed.

    Raises
    ------
    DatasetError
        If it is no zip archive, was cut short, is encrypted, has a name that leads out of it, or
        unpacks to what no pictures would.
    """

    def __init__(self, path: Path, notes: Notes) -> None:
        self.path = path
        try:
            self._zip = zipfile.ZipFile(path)
        except (zipfile.BadZipFile, ValueError, NotImplementedError, EOFError) as problem:
            raise DatasetError(
                f"{path}: is no zip archive, or was cut short ({problem}); copy or export it again"
            ) from None
        try:
            self._members = self._check(notes)
        except BaseException:
            self._zip.close()
            raise

    def close(self) -> None:
        """Close the archive."""
        self._zip.close()

    def _check(self, notes: Notes) -> dict[str, zipfile.ZipInfo]:
        members: dict[str, zipfile.ZipInfo] = {}
        infos = self._zip.infolist()
        if len(infos) > _MOST_FILES:
            raise DatasetError(
                f"{self.path}: holds {len(infos):,} files, at most {_MOST_FILES:,} are read; "
                "divide it"
            )
        for member in infos:
            name = member.filename.replace("\\", "/")
            if member.is_dir() or name.endswith("/"):
                continue
            if leads_out(name):
                raise DatasetError(
                    f"{self.path}: a file in the archive is named '{member.filename}', which "
                    "leads out of it; pack it again from its own folder"
                )
            name = PurePosixPath(name).as_posix()
            if any(is_litter(part) for part in name.split("/")):
                continue
            if stat.S_ISLNK(member.external_attr >> 16):
                notes.add("links in the archive, left out", name)
                continue
            if member.flag_bits & 1:
                raise DatasetError(
                    f"{self.path}: '{name}' is encrypted; unpack the archive with its password "
                    "and name the folder"
                )
            if explodes(member):
                raise DatasetError(
                    f"{self.path}: '{name}' would unpack from {member.compress_size:,} to "
                    f"{member.file_size:,} bytes, which no picture or export does; remove it from "
                    "the archive"
                )
            if name in members:
                notes.add("files that are in the archive twice, the last one read", name)
            members[name] = member
        return members

    @cached_property
    def names(self) -> list[str]:
        return sorted(self._members)

    @contextmanager
    def open(self, name: str) -> Iterator[IO[bytes]]:
        try:
            stream = self._zip.open(self._members[name])
        except (zipfile.BadZipFile, OSError, ValueError) as problem:
            raise self._damaged(name, problem) from None
        except (RuntimeError, NotImplementedError):
            raise DamagedFileError(
                f"{self.said(name)}: is packed by a method that is not read; unpack the archive "
                "and name the folder"
            ) from None
        try:
            with stream:
                yield stream
        except _DAMAGED_MEMBER as problem:
            raise self._damaged(name, problem) from None
        except OSError as problem:
            if problem.errno is not None:
                raise
            raise self._damaged(name, problem) from None  # what bzip2 cannot unpack

    def _damaged(self, name: str, problem: Exception) -> DamagedFileError:
        return DamagedFileError(
            f"{self.said(name)}: is damaged in the archive ({problem}); copy or export the archive "
            "again"
        )

    def has(self, name: str) -> bool:
        return name in self._members

    def bytes_of(self, name: str) -> int:
        return self._members[name].file_size

    def changed(self, name: str) -> float:
        year, month, day, hour, minute, second = self._members[name].date_time
        # Only to tell whether it is the same file as before: any fixed clock will do.
        return float(
            ((((year - 1980) * 12 + month) * 31 + day) * 24 + hour) * 3600 + minute * 60 + second
        )

    def on_disk(self, name: str) -> Path | None:  # noqa: ARG002
        return None

    def said(self, name: str) -> str:
        return f"{self.path}: {name}"


def explodes(member: zipfile.ZipInfo) -> bool:
    """Whether a member of a zip archive unpacks to what no picture, table or export does."""
    return member.file_size > max(_BOMB_BYTES, _BOMB_RATIO * member.compress_size)
