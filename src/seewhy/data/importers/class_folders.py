"""Class folders: each folder is a class, the pictures in and below it are of that class."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property

from seewhy.data.importers.annotation import AnnotatedPicture, readable
from seewhy.data.importers.picture_files import is_picture_name, split_of
from seewhy.data.importers.source import Source
from seewhy.errors import DatasetError
from seewhy.text.nearest import did_you_mean

NO_PICTURE = "files that are no pictures, left out"
DEEPER = "classes whose folder holds further folders (--inside FOLDER makes those the classes)"
_NEARLY_ALL = 0.95


@dataclass(frozen=True)
class _Level:
    """A folder in which folders are classes, or splits that hold classes.

    ``prefix`` ends with "/" unless it is the source itself; ``pictures`` are all below it.
    """

    prefix: str
    pictures: Sequence[str]

    @cached_property
    def folders(self) -> dict[str, list[str]]:
        """Folder → the pictures in and below it; "" for those that lie here."""
        found: dict[str, list[str]] = {}
        for picture in self.pictures:
            first, slash, _ = picture[len(self.prefix) :].partition("/")
            found.setdefault(first if slash else "", []).append(picture)
        return found

    @property
    def named(self) -> list[str]:
        """The folders that there are."""
        return [folder for folder in self.folders if folder]

    def inside(self, folder: str) -> _Level:
        """The level that one of its folders is."""
        return _Level(f"{self.prefix}{folder}/", self.folders[folder])


def read_class_folders(source: Source) -> Iterator[AnnotatedPicture]:
    """Yield the pictures of class folders, with splits where folders are called so.

    Pictures that lie in no class folder have no class. Folders around all others are passed
    through, and one that holds nearly all pictures in folders of its own as well.

    Raises
    ------
    DatasetError
        If there is no picture, or it is not plain which folders are the classes.
    """
    pictures = []
    for name in source.pictures.names:
        if is_picture_name(name):
            pictures.append(name)
        else:
            source.notes.add(NO_PICTURE, name)
    level = _chosen(source, pictures)
    folders = level.folders
    splits = {folder: split_of(folder) for folder in folders if folder}
    if splits and all(splits.values()):
        for folder, split in splits.items():
            yield from _of_classes(source, level.inside(folder), split)
        yield from (AnnotatedPicture(file=name) for name in folders.get("", ()))
        return
    yield from _of_classes(source, level, "")


def _of_classes(source: Source, level: _Level, split: str) -> Iterator[AnnotatedPicture]:
    for folder, pictures in level.folders.items():
        if folder and "" not in (below := level.inside(folder)).folders and len(below.named) > 1:
            source.notes.add(DEEPER, f"{level.prefix}{folder}")
        for name in pictures:
            yield AnnotatedPicture(file=name, class_name=readable(folder), split=split)


def _chosen(source: Source, pictures: Sequence[str]) -> _Level:
    """The level whose folders are the classes (or the splits)."""
    if not pictures:
        raise source.nothing("no picture in it or below; name the folder that holds them")
    if source.inside is not None:
        return _named(source, source.inside, pictures)
    level = _Level("", pictures)
    while True:
        if len(level.named) == 1 and not split_of(level.named[0]):
            below = level.inside(level.named[0])
            if "" in level.folders or not below.named:
                return level  # one class folder
            level = below
            continue
        container = _container(level)
        if container is None:
            return level
        for folder in level.named:
            if folder != container:
                for name in level.folders[folder]:
                    source.notes.add(f"pictures beside {level.prefix}{container}, left out", name)
        level = level.inside(container)


def _container(level: _Level) -> str | None:
    """The folder that holds class folders while its neighbours are none, if there is one."""
    if len(level.named) < 2 or any(split_of(folder) for folder in level.named):
        return None
    largest = max(level.named, key=lambda folder: len(level.folders[folder]))
    inside = level.inside(largest)
    holds_classes = "" not in inside.folders and len(inside.named) > 1
    nearly_all = len(inside.pictures) >= _NEARLY_ALL * len(level.pictures)
    return largest if holds_classes and nearly_all else None


def _named(source: Source, inside: str, pictures: Sequence[str]) -> _Level:
    folder = inside.replace("\\", "/").strip("/")
    prefix = "" if folder in ("", ".") else f"{folder}/"
    below = [name for name in pictures if name.startswith(prefix)]
    if not below:
        known = sorted(
            {"/".join(name.split("/")[:depth]) for name in pictures for depth in (1, 2)}
            - set(pictures)
        )
        raise DatasetError(
            f"{source.said}: '{inside}' is no folder with pictures in it; "
            f"{did_you_mean(folder, known)}"
        )
    return _Level(prefix, below)
