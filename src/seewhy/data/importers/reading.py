"""Read a source as a whole: what a tool wrote, with classes, features, groups, splits, names."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import get_args

from seewhy.data.annotation_formats import Format, format_called
from seewhy.data.importers.annotation import AnnotatedPicture, Notes
from seewhy.data.importers.boxes import CLASS_RULES, ClassRule, class_of_boxes
from seewhy.data.importers.class_features import (
    ClassFeatures,
    doubtful_values,
    features_of_parts,
    read_class_features,
)
from seewhy.data.importers.formats import check_mixture, format_of, reader_of
from seewhy.data.importers.groups import grouped, grouping
from seewhy.data.importers.opening import is_archive, open_source
from seewhy.data.importers.request import ImportRequest
from seewhy.data.importers.source import MISSING, ColumnNames, Source
from seewhy.data.importers.source_files import SourceFiles
from seewhy.data.importers.splits import with_splits
from seewhy.data.importers.vocabulary import Vocabulary, vocabulary_of
from seewhy.errors import DatasetError
from seewhy.text.nearest import did_you_mean

_LONGEST_PATTERN = 200
_FEWEST_GROUPS = 5
_NUMBERED = re.compile(r"(.+)[_-]\d+$")


@dataclass(frozen=True)
class ReadSource:
    """What a source says, with the names that it gets; its files are open.

    Attributes
    ----------
    pictures : tuple of AnnotatedPicture
        With the class, the features, the split ("train", "test" or empty) and the group of each.
    class_features : ClassFeatures or None
        Those of the classes that there are.
    filled : int
        How many features of pictures follow from their class and are not said by the source.
    """

    request: ImportRequest
    format: Format
    pictures: tuple[AnnotatedPicture, ...]
    vocabulary: Vocabulary
    class_features: ClassFeatures | None
    files: SourceFiles
    filled: int = 0
    notes: Notes = field(default_factory=Notes)


@contextmanager
def read_source(
    request: ImportRequest, *, class_features: ClassFeatures | None = None
) -> Iterator[ReadSource]:
    """Yield what a source says; nothing is written, no picture is looked at.

    Raises
    ------
    DatasetError
        If the source, a table or an option is wrong; the text names the file and the place.

    Examples
    --------
    >>> import tempfile
    >>> home = Path(tempfile.mkdtemp())
    >>> for name in ("cat/1.jpg", "dog/1.jpg"):
    ...     (home / name).parent.mkdir()
    ...     (home / name).touch()
    >>> with read_source(ImportRequest(home, "folder")) as found:
    ...     [(picture.file, picture.class_name) for picture in found.pictures]
    [('cat/1.jpg', 'cat'), ('dog/1.jpg', 'dog')]
    """
    kind = format_called(request.format)
    _check_options(request, kind)
    pattern = grouping(request.group)
    notes = Notes()
    with ExitStack() as stack:
        files = stack.enter_context(open_source(request.source, notes, outside=request.outside))
        pictures_of = (
            files
            if request.pictures is None
            else stack.enter_context(open_source(request.pictures, notes, outside=request.outside))
        )
        source = Source(
            files=files,
            pictures=pictures_of,
            notes=notes,
            only=_only(request.source),
            inside=request.inside,
            columns=ColumnNames(request.image_column, request.class_column),
        )
        check_mixture(source, kind)
        found = list(reader_of(kind)(source))
        _check_missing(source, len(found))
        pictures = _once_each(found, notes)
        pictures = _with_classes_of_boxes(pictures, request.class_rule, notes)
        pictures = grouped(pictures, pattern, notes)
        pictures = with_splits(pictures, request.test_share, notes)
        said = class_features or _class_features(request, pictures)
        known = sum(len(picture.features) for picture in pictures)
        if said is not None:
            said, pictures = _with_class_features(pictures, said, notes)
        _note_classes(pictures, notes)
        yield ReadSource(
            request=request,
            format=kind,
            pictures=tuple(pictures),
            vocabulary=vocabulary_of(pictures, said, notes),
            class_features=said,
            files=pictures_of,
            filled=sum(len(picture.features) for picture in pictures) - known,
            notes=notes,
        )


def detect_format(request: ImportRequest) -> Format:
    """Return the format that the source of a request is in.

    Raises
    ------
    DatasetError
        If it is in none that is read, or in several.
    """
    notes = Notes()
    with open_source(request.source, notes, outside=request.outside) as files:
        return format_of(Source(files, files, notes, only=_only(request.source)))


def _only(source: Path) -> str | None:
    """The one file that a user named; None for folders and archives."""
    return source.name if source.is_file() and not is_archive(source) else None


def _check_options(request: ImportRequest, kind: Format) -> None:
    """Refuse what goes with other formats, and values that cannot be."""
    others: Mapping[str, tuple[object, tuple[Format, ...]]] = {
        "--image-column": (request.image_column, ("table", "labelstudio")),
        "--class-column": (request.class_column, ("table", "labelstudio")),
        "--inside": (request.inside, ("folder",)),
        "--pictures": (
            request.pictures,
            tuple(format_name for format_name in get_args(Format) if format_name != "folder"),
        ),
    }
    for option, (value, formats) in others.items():
        if value is not None and kind not in formats:
            raise DatasetError(
                f"{option} {value}: goes with {', '.join(formats)}, not with {kind}; leave it out"
            )
    if request.class_rule not in CLASS_RULES:
        raise DatasetError(
            f"--class {request.class_rule}: {did_you_mean(request.class_rule, CLASS_RULES)}"
        )
    if not 0.0 <= request.test_share < 1.0:
        raise DatasetError(
            f"--test-share must be from 0 to below 1, got {request.test_share:g}; 0.25 keeps a "
            "quarter"
        )
    if request.features is not None and request.class_parts is not None:
        raise DatasetError(
            "--features and --class-parts both say the features of a class; give one of them"
        )


def _check_missing(source: Source, found: int) -> None:
    missing = source.notes.count(MISSING)
    if missing <= found:
        return
    first = next(note for note in source.notes.all() if note.text == MISSING).places[0]
    raise DatasetError(
        f"{source.said}: {missing:,} of its {missing + found:,} pictures are not in "
        f"{source.pictures.path}, the first of them {first}; say where they lie with --pictures DIR"
    )


def _once_each(pictures: Sequence[AnnotatedPicture], notes: Notes) -> list[AnnotatedPicture]:
    """Every file once; what several entries say of it is put together."""
    if not pictures:
        return []
    by_file: dict[str, AnnotatedPicture] = {}
    for picture in pictures:
        first = by_file.get(picture.file)
        if first is None:
            by_file[picture.file] = picture
            continue
        notes.add("pictures that the source lists several times, put together", picture.file)
        labels = {first.class_name, picture.class_name} - {""}
        if len(labels) > 1:
            notes.add(
                "pictures that are said to be of several classes, left without one",
                f"{picture.file} ({' and '.join(sorted(labels))})",
            )
        by_file[picture.file] = replace(
            first,
            class_name=labels.pop() if len(labels) == 1 else "",
            features={**picture.features, **first.features},
            boxes=(*first.boxes, *(box for box in picture.boxes if box not in first.boxes)),
            split=first.split or picture.split,
            group=first.group or picture.group,
        )
    return list(by_file.values())


def _with_classes_of_boxes(
    pictures: Sequence[AnnotatedPicture], rule: ClassRule, notes: Notes
) -> list[AnnotatedPicture]:
    """Pictures whose class is that of their boxes where nobody said another."""
    found, several = [], 0
    for picture in pictures:
        label = picture.class_name or class_of_boxes(picture.boxes, rule)
        several += rule == "only" and bool(picture.boxes) and not label
        found.append(replace(picture, class_name=label))
    if several:
        notes.add(
            f"{several:,} pictures have boxes of several kinds and so no class; --class largest "
            "gives them that of the largest box"
        )
    return found


def _class_features(
    request: ImportRequest, pictures: Sequence[AnnotatedPicture]
) -> ClassFeatures | None:
    classes = sorted({picture.class_name for picture in pictures} - {""})
    if request.features is not None:
        return read_class_features(request.features, classes)
    if request.class_parts is not None:
        return features_of_parts(request.class_parts, classes)
    return None


def _with_class_features(
    pictures: Sequence[AnnotatedPicture], said: ClassFeatures, notes: Notes
) -> tuple[ClassFeatures, list[AnnotatedPicture]]:
    """Fill the features that follow from the class; what a source says itself is kept."""
    for doubt in doubtful_values(said):
        notes.add(doubt)
    classes = sorted({picture.class_name for picture in pictures} - {""})
    ours = said.for_classes(classes)
    shown = {tuple(sorted(values.items())) for values in ours.values.values()}
    for name, values in said.values.items():
        if tuple(sorted(values.items())) not in shown or not classes:
            notes.add(f"classes of {said.said} that no picture shows", name)
    filled = []
    for picture in pictures:
        values = ours.values.get(picture.class_name, {})
        for feature, value in values.items():
            if picture.features.get(feature, value) != value:
                notes.add(
                    f"features that are said otherwise than {said.said} has them, kept",
                    f"{picture.file} {feature} {picture.features[feature]}",
                )
        filled.append(replace(picture, features={**values, **picture.features}))
    return ours, filled


def _note_classes(pictures: Sequence[AnnotatedPicture], notes: Notes) -> None:
    counts = Counter(picture.class_name for picture in pictures)
    without = counts.pop("", 0)
    if len(counts) == 1:
        notes.add(
            f"all pictures are of one class ({next(iter(counts))}): training needs pictures of "
            "another"
        )
    if without:
        notes.add(
            f"{without:,} of {len(pictures):,} pictures have no class: they are there to be "
            "labelled or classified"
        )
