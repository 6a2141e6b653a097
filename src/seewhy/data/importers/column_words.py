"""Which column of a table says what, by the words that people use for it."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from seewhy.data.importers.names import same_words

IMAGE_WORDS = (
    "image", "images", "picture", "photo", "photograph", "img", "file", "filename", "file name",
    "file path", "filepath", "path", "image path", "image file", "image name", "image id",
    "imagepath", "imagefile", "imagename", "picture path", "url", "name", "id",
)  # fmt: skip
CLASS_WORDS = (
    "class", "label", "category", "class name", "classname", "label name", "class label",
    "species", "kind", "type", "target", "diagnosis", "verdict", "result", "breed", "grade",
    "defect", "defect type", "choice", "y",
)  # fmt: skip
SPLIT_WORDS = ("split", "subset", "partition", "set", "fold", "dataset")
GROUP_WORDS = (
    "group", "patient", "patient id", "subject", "subject id", "person", "person id", "object id",
    "item id", "specimen", "specimen id", "lesion id", "capture", "series", "session",
)  # fmt: skip


def column_like(columns: Iterable[str], words: Sequence[str]) -> str | None:
    """Return the column that is called by one of some words, the earlier word first.

    Examples
    --------
    >>> column_like(["File_Name", "label"], IMAGE_WORDS)
    'File_Name'
    >>> column_like(["colour"], IMAGE_WORDS) is None
    True
    """
    by_words = {same_words(column): column for column in reversed(list(columns))}
    return next((by_words[word] for word in words if word in by_words), None)


def class_column(columns: Iterable[str]) -> str | None:
    """Return the column that says the class, by what it is called.

    Examples
    --------
    >>> class_column(["ripe", "Class"])
    'Class'
    """
    return column_like(columns, CLASS_WORDS)
