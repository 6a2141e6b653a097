"""The files of a source, a folder or a zip archive, by their names; nothing is unpacked."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import AbstractContextManager
from pathlib import Path
from typing import IO, Protocol

from seewhy.errors import DatasetError

LARGEST_PICTURE = 512 * 2**20
"""Bytes of the largest picture file that is read."""


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
