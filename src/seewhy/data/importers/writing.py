"""Write what a source says as a dataset folder: pictures, scenes.csv, things.csv."""

from __future__ import annotations

import csv
import shutil
from collections import Counter
from collections.abc import Callable, Iterable, Mapping, Sequence
from contextlib import ExitStack
from pathlib import Path
from typing import Any, TextIO

from seewhy.data.dataset import TABLE
from seewhy.data.importers.annotation import AnnotatedPicture, Box
from seewhy.data.importers.boxes import boxes_in_pixels
from seewhy.data.importers.class_features import ClassFeatures
from seewhy.data.importers.file_names import RECORD
from seewhy.data.importers.imported import ImportedDataset
from seewhy.data.importers.picture_files import PictureHeader
from seewhy.data.importers.placing import Placing, image_names
from seewhy.data.importers.reading import ReadSource, read_source
from seewhy.data.importers.record import Record, read_record, words_of_vocabulary
from seewhy.data.importers.request import ImportRequest
from seewhy.data.importers.source_files import DamagedFileError
from seewhy.data.importers.vocabulary import (
    THING_COLUMNS,
    Vocabulary,
    named_box,
    named_features,
)
from seewhy.data.thing import THINGS
from seewhy.errors import DatasetError, PictureError
from seewhy.files.csv_text import csv_text
from seewhy.files.locks import sole_writer
from seewhy.files.whole_files import put_all_on_disk, whole_file, write_whole

CLASSES = "classes.csv"
UNUSABLE = "pictures that cannot be used, left out"
_SPARE_BYTES = 64 * 2**20

Progress = Callable[[int, int], None]
"""Called with the pictures done and the pictures in all."""


def import_pictures(
    request: ImportRequest,
    folder: Path | str,
    *,
    on_progress: Progress | None = None,
) -> ImportedDataset:
    """Import a source into a new dataset folder.

    Pictures come under ``images/`` as they are, linked where the file system can, copied where
    it cannot. The tables are written last; an interrupted call with the same request goes on
    where it was.

    Parameters
    ----------
    request : ImportRequest
    folder : Path
    on_progress : callable, optional
        Called with the pictures done and the pictures in all.

    Raises
    ------
    DatasetError
        If the source or the request is wrong, most pictures cannot be used, or the folder holds
        something else.

    Examples
    --------
    >>> import tempfile
    >>> from PIL import Image
    >>> home = Path(tempfile.mkdtemp())
    >>> for name in ("red", "blue"):
    ...     (home / "pictures" / name).mkdir(parents=True)
    ...     Image.new("RGB", (20, 20), name).save(home / "pictures" / name / "1.png")
    >>> imported = import_pictures(ImportRequest(home / "pictures", "folder"), home / "data")
    >>> print((home / "data" / "scenes.csv").read_text())
    image,class
    images/blue/1.png,blue
    images/red/1.png,red
    <BLANKLINE>
    """
    folder = Path(folder)
    check_out_folder(folder, request)
    with read_source(request) as read:
        return write_dataset(read, folder, on_progress=on_progress)


def write_dataset(
    read: ReadSource, folder: Path, *, on_progress: Progress | None = None
) -> ImportedDataset:
    """Write a source that was read; see :func:`import_pictures`."""
    check_out_folder(folder, read.request)
    if not read.pictures:
        raise DatasetError(f"{read.request.source}: holds no picture; nothing is imported")
    _check_space(read, folder)
    folder.mkdir(parents=True, exist_ok=True)
    record = Record(settings=read.request.settings())
    writer = _Writer(read, folder)
    with ExitStack() as stack:
        stack.enter_context(sole_writer(folder / TABLE))
        write_whole(folder / RECORD, record.model_dump_json(indent=2) + "\n")
        # What is opened last takes its place first: the table of scenes comes to stand last.
        scenes = stack.enter_context(whole_file(folder / TABLE))
        things = stack.enter_context(whole_file(folder / THINGS)) if writer.has_boxes else None
        writer.write(scenes, things, on_progress)
        dataset = writer.account()
        finished = Record(
            settings=record.settings,
            finished=True,
            words=words_of_vocabulary(read.vocabulary),
            report=dataset.as_json(),
        )
        put_all_on_disk()  # the pictures, before a table says that they are there
        if read.class_features is not None:
            write_whole(folder / CLASSES, class_table(read.class_features, read.vocabulary))
        write_whole(folder / RECORD, finished.model_dump_json(indent=2) + "\n")
    return dataset


def class_table(class_features: ClassFeatures, vocabulary: Vocabulary) -> str:
    """Return a table class → features, in the names of a domain.

    Examples
    --------
    >>> from seewhy.data.importers.vocabulary import FeatureWords
    >>> said = ClassFeatures(("Fur",), {"Big Cat": {"Fur": "True"}}, "a.csv")
    >>> fur = FeatureWords("fur", "Fur", {"True": "yes"}, is_boolean=True)
    >>> print(class_table(said, Vocabulary({"Big Cat": "big_cat"}, {"Fur": fur}, {}, {})))
    class,fur
    big_cat,yes
    <BLANKLINE>
    """
    columns = _feature_names(vocabulary, class_features.features)
    rows = []
    for words, name in vocabulary.classes.items():
        if words in class_features.values:
            values = named_features(class_features.values[words], vocabulary.features)
            rows.append([name, *(values.get(column, "") for column in columns)])
    return csv_text(["class", *columns], rows)


class _Writer:
    """Writes pictures and rows, and counts what it writes."""

    def __init__(self, read: ReadSource, folder: Path) -> None:
        self._read = read
        self._folder = folder
        self._columns = _feature_names(read.vocabulary, read.vocabulary.features)
        self._attributes = _feature_names(read.vocabulary, read.vocabulary.attributes, things=True)
        self._optional = [
            column
            for column, has_it in (
                ("split", any(picture.split for picture in read.pictures)),
                ("group", any(picture.group for picture in read.pictures)),
                ("reasons", any(picture.reasons for picture in read.pictures)),
            )
            if has_it
        ]
        self.has_boxes = any(picture.boxes for picture in read.pictures)
        self._placing = Placing(read.files, folder, link=not read.request.copy)
        self._classes: Counter[str] = Counter()
        self._features: dict[str, Counter[str]] = {name: Counter() for name in self._columns}
        self._splits: Counter[str] = Counter()
        self._groups: set[str] = set()
        self._kinds: Counter[str] = Counter()
        self._written = 0

    def write(self, scenes: Path, things: Path | None, on_progress: Progress | None) -> None:
        """Write every picture with its rows to two tables."""
        pictures = self._read.pictures
        images = image_names([picture.file for picture in pictures])
        with ExitStack() as stack:
            rows = _opened(stack, scenes, ["image", "class", *self._columns, *self._optional])
            boxes = (
                None
                if things is None
                else _opened(stack, things, [*THING_COLUMNS, *self._attributes])
            )
            for number, (picture, image) in enumerate(zip(pictures, images, strict=True), start=1):
                header = self._place(picture, image)
                if header is not None:
                    rows.writerow(self._scene(picture, image))
                    self._written += 1
                    if boxes is not None:
                        boxes.writerows(self._things(picture, image, header))
                if on_progress is not None:
                    on_progress(number, len(pictures))
        left_out = self._read.notes.count(UNUSABLE)
        if left_out > len(pictures) / 2:
            notes = self._read.notes.all()
            first = next(note for note in notes if note.text == UNUSABLE).places[0]
            raise DatasetError(
                f"{self._read.request.source}: {left_out:,} of {len(pictures):,} pictures cannot "
                f"be used, the first of them {first}; copy them again from where they come from"
            )

    def _place(self, picture: AnnotatedPicture, image: str) -> PictureHeader | None:
        try:
            return self._placing.place(picture.file, image)
        except PictureError as problem:
            self._read.notes.add(UNUSABLE, f"{picture.file} {problem}")
        except DamagedFileError as problem:
            self._read.notes.add(UNUSABLE, str(problem))
        return None

    def _scene(self, picture: AnnotatedPicture, image: str) -> list[str]:
        vocabulary = self._read.vocabulary
        label = vocabulary.classes[picture.class_name] if picture.class_name else ""
        values = named_features(picture.features, vocabulary.features)
        self._classes[label] += 1
        for name, value in values.items():
            self._features[name][value] += 1
        self._splits[picture.split] += 1
        self._groups.add(picture.group)
        optional = {
            "split": picture.split,
            "group": picture.group,
            "reasons": " ".join(
                vocabulary.features[name].name
                for name in picture.reasons
                if name in vocabulary.features
            ),
        }
        return [
            image,
            label,
            *(values.get(name, "") for name in self._columns),
            *(optional[column] for column in self._optional),
        ]

    def _things(
        self, picture: AnnotatedPicture, image: str, header: PictureHeader
    ) -> Iterable[list[str]]:
        boxes = boxes_in_pixels(picture, header, self._read.notes)
        for number, box in enumerate(boxes, start=1):
            kind, attributes = named_box(box, self._read.vocabulary)
            self._kinds[kind] += 1
            yield [
                image,
                str(number),
                *map(_pixels, _corners(box)),
                kind,
                *(attributes.get(name, "") for name in self._attributes),
            ]

    def account(self) -> ImportedDataset:
        """What was written."""
        names = self._read.vocabulary.class_words
        return ImportedDataset(
            folder=self._folder,
            format=self._read.format,
            pictures=self._written,
            linked=self._placing.links,
            classes={name: self._classes[name] for name in (*names, "") if self._classes[name]},
            features={
                name: _in_order(self._read, name, counts) for name, counts in self._features.items()
            },
            splits={key: self._splits[key] for key in ("train", "test") if self._splits[key]},
            groups=len(self._groups - {""}),
            kinds=dict(self._kinds.most_common()),
            notes=self._read.notes.all(),
        )


def _in_order(read: ReadSource, feature: str, counts: Mapping[str, int]) -> dict[str, int]:
    features = read.vocabulary.features.values()
    words = next(words for words in features if words.name == feature)
    return {value: counts[value] for value in words.value_words if counts[value]}


def check_out_folder(folder: Path, request: ImportRequest) -> None:
    """Refuse to write over anything but an unfinished import of the same."""
    if not folder.exists():
        return
    if not folder.is_dir():
        raise DatasetError(f"{folder}: is a file; name a new folder with --out")
    if (folder / TABLE).exists():
        raise DatasetError(
            f"{folder}: holds a dataset already; name a new folder with --out, or delete this one"
        )
    record = read_record(folder)
    if record is not None:
        if record.settings != request.settings():
            raise DatasetError(
                f"{folder}: holds an unfinished import of another source or with other options "
                f"({record.settings.get('source', '?')}); name a new folder, or delete this one"
            )
        return
    if any(folder.iterdir()):
        raise DatasetError(f"{folder}: holds other files; name a new folder with --out")


def _check_space(read: ReadSource, folder: Path) -> None:
    """Refuse what does not fit on the disk, before the first picture is written."""
    there = folder
    while not there.exists():
        there = there.parent
    first = read.files.on_disk(read.pictures[0].file)
    if first is not None and not read.request.copy and first.stat().st_dev == there.stat().st_dev:
        return  # links take no room
    needed = sum(read.files.bytes_of(picture.file) for picture in read.pictures)
    free = shutil.disk_usage(there).free
    if needed + _SPARE_BYTES > free:
        raise DatasetError(
            f"{folder}: the pictures need {needed / 2**30:.1f} GiB, the disk has "
            f"{free / 2**30:.1f} GiB free; make room or choose another disk"
        )


def _feature_names(
    vocabulary: Vocabulary, features: Iterable[str], *, things: bool = False
) -> list[str]:
    words = vocabulary.attributes if things else vocabulary.features
    return list(dict.fromkeys(words[name].name for name in features if name in words))


def _opened(stack: ExitStack, path: Path, columns: Sequence[str]) -> Any:
    stream: TextIO = stack.enter_context(path.open("w", newline="", encoding="utf-8"))
    rows = csv.writer(stream, lineterminator="\n")
    rows.writerow(columns)
    return rows


def _corners(box: Box) -> tuple[float, float, float, float]:
    return (box.left, box.top, box.right, box.bottom)


def _pixels(value: float) -> str:
    return f"{value:.2f}".rstrip("0").rstrip(".")
