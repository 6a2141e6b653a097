"""From labelled pictures to a domain, and to the dataset that goes with it."""

from __future__ import annotations

import shlex
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from seewhy.data.dataset import TABLE
from seewhy.data.importers.annotation import Note
from seewhy.data.importers.class_features import ClassFeatures
from seewhy.data.importers.imported import ImportedDataset
from seewhy.data.importers.reading import ReadSource, detect_format, read_source
from seewhy.data.importers.record import read_record
from seewhy.data.importers.request import ImportRequest
from seewhy.data.importers.writing import (
    CLASSES,
    check_out_folder,
    class_table,
    write_dataset,
)
from seewhy.dialogue.vocabulary import says_something
from seewhy.errors import DomainError
from seewhy.new_domain.from_pictures import WrittenDomain, write_domain_of
from seewhy.new_domain.sketch import look_features, sketch_of
from seewhy.new_domain.template import check_new_folder

CommandOf = Callable[[ImportRequest, Path | None, Path], str]
"""The command line that imports a request, with a table of features, into a folder."""


@dataclass(frozen=True)
class NewDomain:
    """A domain written from labelled pictures.

    Attributes
    ----------
    written : WrittenDomain
    dataset : ImportedDataset or None
        The dataset written with it.
    commands : tuple of str
        What to do next.
    has_look : bool
        Whether its one feature is what a picture looks like as a whole.
    notes : tuple of Note
        What was odd in the source, and what was guessed.
    """

    written: WrittenDomain
    dataset: ImportedDataset | None
    commands: tuple[str, ...]
    has_look: bool
    notes: tuple[Note, ...]

    def as_json(self) -> dict[str, Any]:
        """Everything, for a program."""
        folder = self.written.folder
        return {
            "folder": str(folder),
            "files": sorted(path.name for path in folder.iterdir()),
            "classes": self.written.classes,
            "features": self.written.features,
            "axioms": self.written.axioms,
            "alike": list(self.written.alike),
            "has_look": self.has_look,
            "dataset": None if self.dataset is None else self.dataset.as_json(),
            "commands": list(self.commands),
            "notes": [{"text": note.text, "places": list(note.places)} for note in self.notes],
        }


def new_domain_from(
    request: ImportRequest,
    folder: Path,
    *,
    command_of: CommandOf,
    data: Path | None = None,
    subject: str = "the picture",
    on_progress: Callable[[int, int], None] | None = None,
) -> NewDomain:
    """Write a domain with the classes and features of labelled pictures.

    Parameters
    ----------
    request : ImportRequest
        Where the format is empty, it is found.
    folder : Path
        The domain's.
    command_of : callable
        Words the command that imports a request, with a table of features, into a folder.
    data : Path, optional
        A new folder: the pictures are imported there as well.
    subject : str
        How answers name the picture.
    on_progress : callable, optional
        Called with the pictures imported and the pictures in all.

    Raises
    ------
    DatasetError, DomainError
        If the source cannot be used, shows fewer than two classes, or a folder is taken.
    """
    check_new_folder(folder)
    if not says_something(subject):
        raise DomainError(f"--subject '{subject}' has no word; write one such as 'the apple'")
    is_dataset = (request.source / TABLE).is_file()
    if not request.format:
        request = replace(request, format="table" if is_dataset else detect_format(request))
    if data is not None:
        check_out_folder(data, request)
    table = request.source / CLASSES
    if is_dataset and request.features is None and not request.class_parts and table.is_file():
        request = replace(request, features=table)
    look = _look_where_nothing_else(request)
    with read_source(request, class_features=look) as read:
        record = read_record(request.source) if is_dataset else None
        sketch = sketch_of(
            read,
            name=folder.name,
            subject=subject,
            words=None if record is None else record.words,
            is_look=look is not None,
        )
        dataset = None if data is None else write_dataset(read, data, on_progress=on_progress)
        goes_as_it_is = is_dataset and _is_ready(read)
        pictures = data or (request.source if goes_as_it_is else Path(f"{folder}_data"))
        classes = (
            "" if read.class_features is None else class_table(read.class_features, read.vocabulary)
        )
        imports = () if pictures in (data, request.source) else (
            command_of(request, folder / CLASSES if classes else None, pictures),
        )  # fmt: skip
        commands = (
            f"seewhy check {_word(folder)}",
            *imports,
            f"seewhy data show {_word(pictures)} --domain {_word(folder)}",
            f"seewhy train {_word(folder)} --data {_word(pictures)} --out {_word(folder)}_model",
            f"seewhy evaluate {_word(folder)}_model --data {_word(pictures)}",
        )
        notes = read.notes.all()
    written = write_domain_of(
        sketch, folder, classes_table=classes, commands=commands, data=str(pictures)
    )
    return NewDomain(written, dataset, commands, look is not None, notes)


def _look_where_nothing_else(request: ImportRequest) -> ClassFeatures | None:
    """The feature that stands in for others, where a source has none."""
    with read_source(request) as read:
        has_features = bool(read.vocabulary.features)
        return None if has_features else look_features(read.vocabulary)


def _is_ready(read: ReadSource) -> bool:
    """Whether a dataset folder can be trained on as it is: its words are names already."""
    said = {feature for picture in read.pictures for feature in picture.features}
    words = read.vocabulary.features
    return (
        not read.filled
        and said == set(words)
        and all(text == name for text, name in read.vocabulary.classes.items())
        and all(text == feature.name for text, feature in words.items())
        and all(text == name for feature in words.values() for text, name in feature.values.items())
    )


def _word(path: Path) -> str:
    return shlex.quote(str(path))
