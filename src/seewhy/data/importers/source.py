"""What a reader of one format is given: the files of a source, and how to read them."""

from __future__ import annotations

import posixpath
import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from seewhy.data.importers.annotation import Notes
from seewhy.data.importers.picture_files import PictureFinder, split_of
from seewhy.data.importers.source_files import SourceFiles
from seewhy.errors import DatasetError

MISSING = "pictures that are not there, left out"
UNREADABLE = "annotations that cannot be read, left out"


@dataclass(frozen=True)
class ColumnNames:
    """Which column (or control of a labelling tool) says what; None where it is to be guessed."""

    image: str | None = None
    label: str | None = None


@dataclass(frozen=True)
class Source:
    """The files of a source and those of its pictures, which may lie elsewhere.

    Attributes
    ----------
    files, pictures : SourceFiles
    only : str or None
        The one file that the user named; all of ``files`` where it is None.
    inside : str or None
        The folder whose folders are the classes, where the user said it.
    columns : ColumnNames
    notes : Notes
    """

    files: SourceFiles
    pictures: SourceFiles
    notes: Notes
    only: str | None = None
    inside: str | None = None
    columns: ColumnNames = ColumnNames()

    @property
    def said(self) -> str:
        """How the source is named in a sentence for the user."""
        return str(self.files.path) if self.only is None else self.files.said(self.only)

    def named(self, *endings: str) -> Sequence[str]:
        """The files whose names end so; the one that the user named, if it does."""
        names = self.files.names if self.only is None else (self.only,)
        return [name for name in names if name.casefold().endswith(endings)]

    def finder(self, *, beside: Iterable[str] = ()) -> PictureFinder:
        """A finder of the pictures; it looks into the folders ``beside`` first."""
        return PictureFinder(self.pictures, self.notes, beside=beside)

    def miss(self, written: str, place: str = "") -> None:
        """Note a picture that is not there."""
        self.notes.add(MISSING, f"{written} ({place})" if place else written)

    def nothing(self, expected: str) -> DatasetError:
        """The error that a source has nothing of a format."""
        return DatasetError(f"{self.said}: there is {expected}")


def split_in_name(path: str) -> str:
    """Return the split that a file's name, or a folder above it, stands for; empty for none.

    Examples
    --------
    >>> split_in_name("annotations/instances_val2017.json"), split_in_name("train/labels.json")
    ('validation', 'train')
    """
    stem = posixpath.splitext(posixpath.basename(path))[0]
    for word in re.split(r"[^A-Za-z0-9]+", stem):
        if split_of(word):
            return split_of(word)
    return split_in_folders(path)


def split_in_folders(path: str) -> str:
    """Return the split that a folder of a path stands for, the lowest first; empty for none.

    Examples
    --------
    >>> split_in_folders("images/valid/1.jpg")
    'validation'
    """
    for part in reversed(posixpath.dirname(path).split("/")):
        if split_of(part):
            return split_of(part)
    return ""
