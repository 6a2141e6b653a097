"""Dataset: a folder with pictures and scenes.csv, annotated features and classes."""

from __future__ import annotations

import csv
import hashlib
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from seewhy.domain import Domain
from seewhy.domain_tables import RESERVED
from seewhy.errors import DatasetError
from seewhy.knowledge.scene import FeatureVector
from seewhy.nearest import did_you_mean

TABLE = "scenes.csv"
SPLITS = ("train", "test")


@dataclass(frozen=True)
class Scene:
    """One annotated picture.

    ``split`` is "train", "test" or empty; pictures of one ``group`` show one physical thing and
    are never split apart for validation. ``reasons`` are the features that somebody named as why
    it is of its class.
    """

    picture: Path
    vector: FeatureVector
    label: str
    split: str = ""
    group: str = ""
    reasons: tuple[str, ...] = ()


@dataclass(frozen=True)
class Dataset:
    """Annotated pictures of one domain.

    On disk a dataset is plain: pictures, and a table ``scenes.csv`` with the columns ``image``
    (a path from the folder), ``class``, one column per feature of the domain, and optionally
    ``split`` ("train" or "test"), ``group`` and ``reasons`` (the features that are why the picture
    is of its class, with blanks between). An empty cell is a value that nobody knows.

    Examples
    --------
    >>> import seewhy, tempfile
    >>> domain = seewhy.load_domain("structure_stability")
    >>> from seewhy.data.making import make_dataset
    >>> folder = tempfile.mkdtemp()
    >>> _ = make_dataset(domain, folder, count=6, seed=0)
    >>> len(Dataset.load(folder, domain))
    6
    """

    scenes: tuple[Scene, ...]
    domain: Domain
    folder: Path

    @staticmethod
    def load(folder: Path | str, domain: Domain) -> Dataset:
        """Read a dataset and check every row against the domain.

        Raises
        ------
        DatasetError
            If the folder, its table or a row is wrong; the text names the file and the line.
        """
        folder = Path(folder)
        table = folder / TABLE
        if not folder.is_dir():
            raise DatasetError(f"{folder}: there is no such folder; give one with a {TABLE}")
        if not table.is_file():
            raise DatasetError(
                f"{folder}: the folder has no {TABLE}; it lists the pictures with the columns "
                f"image, class, {', '.join(domain.features)}"
            )
        try:
            with table.open(newline="", encoding="utf-8-sig") as stream:
                scenes = tuple(_read_rows(stream, domain, table))
        except UnicodeDecodeError:
            raise DatasetError(f"{table}: is not UTF-8 text; save it as CSV in UTF-8") from None
        except csv.Error as problem:
            raise DatasetError(f"{table}: is no table ({problem}); save it as CSV") from None
        if not scenes:
            raise DatasetError(f"{table}: the table has no rows; add one per picture")
        return Dataset(scenes=scenes, domain=domain, folder=folder)

    def __len__(self) -> int:
        return len(self.scenes)

    @property
    def vectors(self) -> list[FeatureVector]:
        """The annotated feature vectors, one per scene."""
        return [scene.vector for scene in self.scenes]

    @property
    def labels(self) -> list[str]:
        """The annotated classes, one per scene."""
        return [scene.label for scene in self.scenes]

    @property
    def groups(self) -> list[str]:
        """The group of every scene; a scene without one is a group of its own."""
        return [scene.group or str(number) for number, scene in enumerate(self.scenes)]

    def of_split(self, split: str) -> Dataset:
        """Return the scenes of a split; all scenes where the table names no splits."""
        if not any(scene.split for scene in self.scenes):
            return self
        chosen = tuple(scene for scene in self.scenes if scene.split == split)
        if not chosen:
            raise DatasetError(
                f"{self.folder / TABLE}: no row has split = {split}; add some, or leave the "
                "column out"
            )
        return replace(self, scenes=chosen)

    def take(self, positions: Sequence[int]) -> Dataset:
        """Return the scenes at some positions; pictures that were read are not read again."""
        taken = replace(self, scenes=tuple(self.scenes[p] for p in positions))
        for size, pixels in self._pixels.items():
            taken._pixels[size] = pixels[list(positions)]
        return taken

    def with_pictures(self, pixels: NDArray[np.uint8]) -> Dataset:
        """Return the same scenes with their pictures as an earlier :meth:`pictures` gave them."""
        same = replace(self)
        same._pixels[pixels.shape[1]] = pixels
        return same

    def without_classes(self, classes: Sequence[str]) -> Dataset:
        """Return the scenes of all other classes.

        Raises
        ------
        DatasetError
            If there is no such class, or if nothing is left.
        """
        for name in classes:
            if name not in self.domain.classes:
                raise DatasetError(
                    f"'{name}' is no class of the domain '{self.domain.name}'; "
                    f"{did_you_mean(name, self.domain.classes)}"
                )
        chosen = tuple(scene for scene in self.scenes if scene.label not in classes)
        if not chosen:
            raise DatasetError(
                f"{self.folder / TABLE}: without the class{'es' * (len(set(classes)) > 1)} "
                f"{', '.join(dict.fromkeys(classes))} nothing is left; leave out fewer"
            )
        return replace(self, scenes=chosen) if classes else self

    def require_two_classes(self) -> None:
        """Raise a DatasetError if all scenes are of one class."""
        if len(set(self.labels)) < 2:
            raise DatasetError(
                f"{self.folder / TABLE}: all {len(self)} rows are of class '{self.labels[0]}'; "
                "training needs scenes of at least two classes"
            )

    def picture_digests(self) -> list[str]:
        """Return a short digest of every picture file, to tell later what was trained on."""
        return [
            hashlib.sha256(scene.picture.read_bytes()).hexdigest()[:16] for scene in self.scenes
        ]

    @cached_property
    def _pixels(self) -> dict[int, NDArray[np.uint8]]:
        return {}

    def pictures(
        self, size: int, *, on_progress: Callable[[int], None] | None = None
    ) -> NDArray[np.uint8]:
        """Return all pictures as uint8 of shape (scenes, size, size, 3); read once per size.

        Raises
        ------
        PictureError
            If a file is not a picture.
        """
        from seewhy.perception.picture import read_picture

        if size not in self._pixels:
            pixels = np.empty((len(self), size, size, 3), dtype=np.uint8)
            for number, scene in enumerate(self.scenes):
                pixels[number] = read_picture(
                    scene.picture, size=size, fit=self.domain.pictures.fit
                )
                if on_progress is not None:
                    on_progress(number + 1)
            self._pixels[size] = pixels
        return self._pixels[size]


def _read_rows(stream: Iterator[str], domain: Domain, table: Path) -> Iterator[Scene]:
    reader = csv.DictReader(stream)
    columns = [name.strip() for name in reader.fieldnames or ()]
    reader.fieldnames = columns
    _check_columns(columns, domain, table)
    for row in reader:
        here = f"{table}:{reader.line_num}"
        if None in row:
            raise DatasetError(
                f"{here}: the row has more cells than there are columns; remove some"
            )
        cells = {name: (cell or "").strip() for name, cell in row.items()}
        if not any(cells.values()):
            continue
        yield _read_row(cells, domain, table.parent, here)


def _check_columns(columns: Sequence[str], domain: Domain, table: Path) -> None:
    if not columns:
        raise DatasetError(
            f"{table}:1: the table is empty; its first line names the columns image, class, "
            f"{', '.join(domain.features)}"
        )
    known = [*RESERVED, *domain.features]
    if "" in columns:
        raise DatasetError(
            f"{table}:1: column {columns.index('') + 1} has no name; name it or remove it"
        )
    for column in columns:
        if columns.count(column) > 1:
            raise DatasetError(f"{table}:1: the column '{column}' stands twice; remove one")
        if column not in known:
            raise DatasetError(
                f"{table}:1: '{column}' is no feature of the domain '{domain.name}'; "
                f"{did_you_mean(column, known)}"
            )
    for needed in ("image", "class", *domain.features):
        if needed not in columns:
            raise DatasetError(
                f"{table}:1: the column '{needed}' is missing; the domain '{domain.name}' needs "
                f"image, class, {', '.join(domain.features)}"
            )


def _read_row(cells: dict[str, str], domain: Domain, folder: Path, here: str) -> Scene:
    if not cells["image"]:
        raise DatasetError(f"{here}: the cell 'image' is empty; name the picture's file")
    picture = folder / cells["image"]
    if not picture.is_file():
        raise DatasetError(
            f"{here}: there is no picture '{cells['image']}' in {folder}; correct the path or "
            "remove the row"
        )
    if cells["class"] not in domain.classes:
        raise DatasetError(
            f"{here}: '{cells['class']}' is no class of the domain '{domain.name}'; "
            f"{did_you_mean(cells['class'], domain.classes)}"
        )
    for key, feature in domain.features.items():
        if cells[key] and cells[key] not in feature.values:
            raise DatasetError(
                f"{here}: '{cells[key]}' is no value of '{key}'; "
                f"{did_you_mean(cells[key], feature.values)}"
            )
    split = cells.get("split", "")
    if split and split not in SPLITS:
        raise DatasetError(f"{here}: split must be 'train', 'test' or empty, got '{split}'")
    return Scene(
        picture=picture,
        vector=domain.vector({key: cells[key] or None for key in domain.features}),
        label=cells["class"],
        split=split,
        group=cells.get("group", ""),
        reasons=_read_reasons(cells, domain, here),
    )


def _read_reasons(cells: dict[str, str], domain: Domain, here: str) -> tuple[str, ...]:
    reasons = tuple(dict.fromkeys(cells.get("reasons", "").split()))
    for name in reasons:
        if name not in domain.features:
            raise DatasetError(
                f"{here}: the reason '{name}' is no feature of the domain '{domain.name}'; "
                f"{did_you_mean(name, domain.features)}"
            )
        if not cells[name]:
            raise DatasetError(
                f"{here}: '{name}' is a reason, but its cell is empty; fill it in, or take the "
                "reason away"
            )
    return reasons
