"""The files of a source, a folder or a zip archive, by their names; nothing is unpacked."""

from __future__ import annotations

import lzma
import os
import stat
import zipfile
import zlib
from collections.abc import Iterator, Sequence
from contextlib import AbstractContextManager, contextmanager
from functools import cached_property
from pathlib import Path, PurePosixPath
from typing import IO, Protocol

from seewhy.data.importers.annotation import Notes
from seewhy.errors import DatasetError
from seewhy.files.whole_files import lies_in

RECORD = "imported.json"
"""What an import leaves in the dataset folder that it writes."""

LARGEST_PICTURE = 512 * 2**20
"""Bytes of the largest picture file that is read."""

LARGEST_TEXT = 4 * 2**30
"""Bytes of the largest table or export that is read."""

_DAMAGED_MEMBER = (zipfile.BadZipFile, zlib.error, lzma.LZMAError, EOFError)
"""What reading a member of a zip archive raises where it is damaged, however it is packed."""

LINKS_OUT = "links that lead out of the folder, left out (--outside follows them)"

_MOST_FILES = 5_000_000
_DEEPEST = 32
_BOMB_RATIO = 200
_BOMB_BYTES = 64 * 2**20
_LITTER = frozenset({"__macosx", "thumbs.db", "desktop.ini", "$recycle.bin"})


class DamagedFileError(DatasetError):
    """One file of a source cannot be read; the others may be well."""


class SourceFiles(Protocol):
    """Files by the names that they have from the source: "cats/first.jpg"."""

    @property
    def path(self) -> Path:
        """The folder or archive."""
        ...

    @property
    def names(self) -> Sequence[str]:
        """The names of all files, sorted, with "/" between the folders; hidden ones left out."""
        ...

    def open(self, name: str) -> AbstractContextManager[IO[bytes]]:
        """Open a file; raises a DamagedFileError where it cannot be read."""
        ...

    def has(self, name: str) -> bool:
        """Whether there is a file of this name."""
        ...

    def bytes_of(self, name: str) -> int:
        """How large a file is."""
        ...

    def changed(self, name: str) -> float:
        """When a file was changed, in seconds."""
        ...

    def on_disk(self, name: str) -> Path | None:
        """Where a file lies, or None for one in an archive."""
        ...

    def said(self, name: str) -> str:
        """How a file is named in a sentence for the user."""
        ...


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
                if _is_litter(entry.name):
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
            return not _leads_out(name) and path.is_file() and self._may_follow(path)
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
            if _leads_out(name):
                raise DatasetError(
                    f"{self.path}: a file in the archive is named '{member.filename}', which "
                    "leads out of it; pack it again from its own folder"
                )
            name = PurePosixPath(name).as_posix()
            if any(_is_litter(part) for part in name.split("/")):
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


@contextmanager
def open_source(path: Path, notes: Notes, *, outside: bool = False) -> Iterator[SourceFiles]:
    """Yield the files of a folder, of a zip archive, or of the folder that a file lies in.

    Links that lead out of a folder are followed only where ``outside`` allows it.

    Raises
    ------
    DatasetError
        If there is nothing at the path, or an archive cannot be used.

    Examples
    --------
    >>> import tempfile
    >>> with open_source(Path(tempfile.mkdtemp()), Notes()) as files:
    ...     files.names
    []
    """
    if path.is_dir():
        yield FolderFiles(path, notes, outside=outside)
        return
    if not path.exists():
        raise DatasetError(f"{path}: there is no such file or folder; check the path")
    if is_archive(path):
        archive = ZipFiles(path, notes)
        try:
            yield archive
        finally:
            archive.close()
        return
    yield FolderFiles(path.parent, notes, outside=outside)


def is_archive(path: Path) -> bool:
    """Whether a path is that of a zip archive (an Excel file, which is one, does not count).

    Raises
    ------
    DatasetError
        If it is an archive of another kind.
    """
    name = path.name.casefold()
    if path.is_dir() or name.endswith((".xlsx", ".xlsm")):
        return False
    if name.endswith((".tar", ".tar.gz", ".tgz", ".tar.bz2", ".tar.xz", ".7z", ".rar", ".gz")):
        raise DatasetError(
            f"{path}: archives other than zip are not read; unpack it and name the folder"
        )
    if name.endswith(".zip"):
        return True
    with path.open("rb") as stream:
        return stream.read(4) == b"PK\x03\x04"


def read_text_file(files: SourceFiles, name: str) -> str:
    """Return the text of a file, in UTF-8 or what Windows writes.

    Raises
    ------
    DamagedFileError
        If it cannot be read, or is larger than a text of its kind can be.
    """
    return decoded(read_bytes(files, name, most=64 * 2**20), files.said(name))


def decoded(content: bytes, said: str) -> str:
    """Return bytes as text, in UTF-8, UTF-16 with its mark, or what Windows writes.

    Examples
    --------
    >>> decoded("größer".encode("cp1252"), "a.txt")
    'größer'
    """
    if content.startswith((b"\xff\xfe", b"\xfe\xff")):
        try:
            return content.decode("utf-16")
        except UnicodeDecodeError:
            raise DamagedFileError(f"{said}: is no text; save it as UTF-8") from None
    try:
        return content.decode("utf-8-sig")
    except UnicodeDecodeError:
        if b"\0" in content:
            raise DamagedFileError(f"{said}: is no text; save it as UTF-8") from None
        return content.decode("cp1252", errors="replace")


def read_bytes(files: SourceFiles, name: str, *, most: int = LARGEST_PICTURE) -> bytes:
    """Return the whole of a file.

    Raises
    ------
    DamagedFileError
        If it cannot be read, or is larger than ``most`` bytes.
    """
    with files.open(name) as stream:
        try:
            content = stream.read(most + 1)
        except OSError as problem:
            if problem.errno is None:
                raise  # what an archive cannot unpack
            raise DamagedFileError(
                f"{files.said(name)}: cannot be read ({problem.strerror})"
            ) from None
    if len(content) > most:
        raise DamagedFileError(f"{files.said(name)}: has more than {most // 2**20} MiB")
    return content


def _is_litter(name: str) -> bool:
    return name.startswith(".") or name.casefold() in _LITTER


def _is_imported(folder: Path) -> bool:
    return (folder / RECORD).is_file()


def _leads_out(name: str) -> bool:
    parts = name.split("/")
    return ".." in parts or parts[0] == "" or parts[0].endswith(":") or "\0" in name
