"""Import a source: read what a tool wrote, agree on names, write a dataset folder."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass, field, replace
from hashlib import sha256
from pathlib import Path
from posixpath import basename
from typing import get_args

from seewhy.data.importers.annotation import AnnotatedPicture, Notes
from seewhy.data.importers.boxes import CLASS_RULES, ClassRule, class_of_boxes
from seewhy.data.importers.class_features import (
    ClassFeatures,
    features_of_parts,
    read_class_features,
)
from seewhy.data.importers.formats import (
    Format,
    check_mixture,
    format_called,
    format_of,
    reader_of,
)
from seewhy.data.importers.source import MISSING, ColumnNames, Source
from seewhy.data.importers.source_files import SourceFiles, is_archive, open_source
from seewhy.data.importers.vocabulary import Vocabulary, vocabulary_of
from seewhy.errors import DatasetError
from seewhy.nearest import did_you_mean

_LONGEST_PATTERN = 200
_FEWEST_GROUPS = 5
_NUMBERED = re.compile(r"(.+)[_-]\d+$")


@dataclass(frozen=True)
class ImportRequest:
    """What is to be imported, and how.

    Attributes
    ----------
    source : Path
        A folder, a zip archive, or the file that a tool exported.
    format : str
        One of :data:`~seewhy.data.importers.formats.FORMATS`.
    pictures : Path or None
        The folder or archive of the pictures, where they lie elsewhere.
    features : Path or None
        A table class → features, which fills what a source does not say itself.
    class_parts : str or None
        What the names of classes are made of, such as ``number-colour-shape``.
    group : str or None
        A regular expression; what its first group (or all of it) finds in a picture's file name
        names the group of the picture.
    class_rule : {"only", "largest", "none"}
        The class that boxes give their picture, see
        :func:`~seewhy.data.importers.boxes.class_of_boxes`.
    image_column, class_column : str or None
        The columns (or controls) of the picture's path and of its class.
    inside : str or None
        The folder of a source whose folders are the classes.
    test_share : float
        The share of pictures that is kept for evaluation where the source has no splits.
    copy : bool
        Whether pictures are copied even where they could be linked.
    """

    source: Path
    format: str
    pictures: Path | None = None
    features: Path | None = None
    class_parts: str | None = None
    group: str | None = None
    class_rule: ClassRule = "only"
    image_column: str | None = None
    class_column: str | None = None
    inside: str | None = None
    test_share: float = 0.0
    copy: bool = False

    def settings(self) -> dict[str, str]:
        """What makes two imports the same one, as text."""
        return {
            "source": str(self.source.resolve()),
            "format": self.format,
            **{
                key: str(value)
                for key, value in (
                    ("pictures", self.pictures and self.pictures.resolve()),
                    ("features", self.features and self.features.resolve()),
                    ("class_parts", self.class_parts),
                    ("group", self.group),
                    ("class_rule", self.class_rule),
                    ("image_column", self.image_column),
                    ("class_column", self.class_column),
                    ("inside", self.inside),
                    ("test_share", self.test_share or None),
                )
                if value is not None
            },
        }


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
    grouping = _grouping(request.group)
    notes = Notes()
    with ExitStack() as stack:
        files = stack.enter_context(open_source(request.source, notes))
        pictures_of = (
            files
            if request.pictures is None
            else stack.enter_context(open_source(request.pictures, notes))
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
        _check_missing(request, notes, len(found))
        pictures = _once_each(found, notes)
        pictures = [_with_class_of_boxes(picture, request.class_rule) for picture in pictures]
        pictures = _grouped(pictures, grouping, request.group, notes)
        pictures = _with_splits(pictures, request.test_share, notes)
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
    with open_source(request.source, notes) as files:
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
        "--pictures": (request.pictures, tuple(f for f in get_args(Format) if f != "folder")),
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


def _grouping(pattern: str | None) -> re.Pattern[str] | None:
    if pattern is None:
        return None
    if len(pattern) > _LONGEST_PATTERN:
        raise DatasetError(
            f"--group has {len(pattern)} characters, at most {_LONGEST_PATTERN} are read"
        )
    try:
        return re.compile(pattern)
    except re.error as problem:
        raise DatasetError(
            f"--group '{pattern}': is no regular expression ({problem}); '^(.+)_' names what "
            "stands before the last _"
        ) from None


def _check_missing(request: ImportRequest, notes: Notes, found: int) -> None:
    missing = notes.count(MISSING)
    if missing <= found:
        return
    first = next(note for note in notes.all() if note.text == MISSING).places[0]
    where = request.pictures or request.source
    raise DatasetError(
        f"{request.source}: {missing:,} of its {missing + found:,} pictures are not in {where}, "
        f"the first of them {first}; say where they lie with --pictures DIR"
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


def _with_class_of_boxes(picture: AnnotatedPicture, rule: ClassRule) -> AnnotatedPicture:
    if picture.class_name or not picture.boxes:
        return picture
    return replace(picture, class_name=class_of_boxes(picture.boxes, rule))


def _grouped(
    pictures: Sequence[AnnotatedPicture],
    grouping: re.Pattern[str] | None,
    pattern: str | None,
    notes: Notes,
) -> list[AnnotatedPicture]:
    if grouping is None:
        _suggest_groups(pictures, notes)
        return list(pictures)
    grouped = []
    for picture in pictures:
        found = grouping.search(basename(picture.file))
        group = "" if found is None else (found.group(1) if found.groups() else found.group()) or ""
        if not group:
            notes.add(
                f"pictures whose name has no '{pattern}', each a group of its own", picture.file
            )
        grouped.append(replace(picture, group=group or picture.group))
    if pictures and not any(picture.group for picture in grouped):
        raise DatasetError(
            f"--group '{pattern}': is found in no file name, the first is "
            f"'{basename(pictures[0].file)}'; correct the expression"
        )
    return grouped


def _suggest_groups(pictures: Sequence[AnnotatedPicture], notes: Notes) -> None:
    """Say so where file names look as if they told which pictures belong together."""
    if any(picture.group for picture in pictures):
        return
    found: dict[str, set[str]] = {}
    count = 0
    for picture in pictures:
        stem = basename(picture.file).rpartition(".")[0]
        match = _NUMBERED.fullmatch(stem)
        if match is not None:
            count += 1
            found.setdefault(match.group(1), set()).add(picture.class_name)
    over_classes = sum(len(classes) > 1 for classes in found.values())
    if (
        count >= 0.8 * len(pictures)
        and len(found) >= _FEWEST_GROUPS
        and count >= 2 * len(found)
        and 2 * over_classes >= len(found)
    ):
        notes.add(
            f"file names such as {basename(pictures[0].file)} may say which pictures belong "
            f"together: --group '^(.+)[_-]' would make {len(found):,} groups of them, which are "
            "kept together when pictures are divided"
        )


def _with_splits(
    pictures: Sequence[AnnotatedPicture], test_share: float, notes: Notes
) -> list[AnnotatedPicture]:
    """Splits as SeeWhy has them: train and test; validation is one of the two."""
    splits = Counter(picture.split for picture in pictures)
    if splits.keys() - {""}:
        if test_share:
            notes.add("the source has splits, --test-share is not used")
        if splits["validation"]:
            into = "train" if splits["test"] else "test"
            notes.add(
                f"the {splits['validation']:,} pictures of the validation split are marked {into}"
            )
            return [
                replace(picture, split=into) if picture.split == "validation" else picture
                for picture in pictures
            ]
        return list(pictures)
    return _divided(pictures, test_share) if test_share else list(pictures)


def _divided(pictures: Sequence[AnnotatedPicture], test_share: float) -> list[AnnotatedPicture]:
    """Pictures of which a share of every class is kept for tests; groups stay together.

    The order is by digests of names, so that it does not depend on what else there is.
    """
    members: dict[str, list[int]] = {}
    for number, picture in enumerate(pictures):
        members.setdefault(picture.group or f"\0{picture.file}", []).append(number)
    wanted = {
        label: test_share * count
        for label, count in Counter(picture.class_name for picture in pictures).items()
    }
    chosen: set[int] = set()
    for group in sorted(members, key=lambda name: sha256(name.encode()).digest()):
        labels = Counter(pictures[number].class_name for number in members[group])
        # Taken where it fills more of what is wanted than it takes beyond that.
        if sum(min(count, wanted[label]) for label, count in labels.items()) * 2 > sum(
            labels.values()
        ):
            chosen.update(members[group])
            for label, count in labels.items():
                wanted[label] = max(0.0, wanted[label] - count)
    return [
        replace(picture, split="test" if number in chosen else "train")
        for number, picture in enumerate(pictures)
    ]


def _class_features(
    request: ImportRequest, pictures: Sequence[AnnotatedPicture]
) -> ClassFeatures | None:
    if request.features is not None:
        return read_class_features(request.features)
    if request.class_parts is not None:
        classes = sorted({picture.class_name for picture in pictures} - {""})
        return features_of_parts(request.class_parts, classes)
    return None


def _with_class_features(
    pictures: Sequence[AnnotatedPicture], said: ClassFeatures, notes: Notes
) -> tuple[ClassFeatures, list[AnnotatedPicture]]:
    """Fill the features that follow from the class; what a source says itself is kept."""
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
