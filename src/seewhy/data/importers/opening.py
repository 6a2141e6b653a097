"""Open a source: a folder, a zip archive, or the folder that a file lies in."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from seewhy.data.importers.annotation import Notes
from seewhy.data.importers.folder_files import FolderFiles
from seewhy.data.importers.source_files import SourceFiles
from seewhy.data.importers.zip_files import ZipFiles
from seewhy.errors import DatasetError


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
