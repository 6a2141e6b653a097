"""What is true of pictures, and a flat folder of them that does not say it."""

from __future__ import annotations

import csv
import random
import shutil
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from seewhy.data.importers.picture_files import ENDINGS
from seewhy.domain.tables import CLASS
from seewhy.errors import SeeWhyError

__all__ = ["Truth", "flat_folder", "read_truth"]


@dataclass(frozen=True)
class Truth:
    """What a person knows who looks at the pictures.

    Attributes
    ----------
    values : mapping of str to mapping of str to str
        Name of a picture → feature or ``class`` → value.
    files : mapping of str to Path
        Name of a picture → where it lies.
    table : str
        The text of a table class → features, as the page Begin takes it; empty where the
        features do not follow from the class.
    """

    values: Mapping[str, Mapping[str, str]]
    files: Mapping[str, Path]
    table: str = ""

    @property
    def classes(self) -> tuple[str, ...]:
        """The classes that there are."""
        return tuple(sorted({values[CLASS] for values in self.values.values()}))

    @property
    def features(self) -> dict[str, tuple[str, ...]]:
        """Feature → its values."""
        names = {name: None for values in self.values.values() for name in values if name != CLASS}
        return {
            name: tuple(sorted({values[name] for values in self.values.values()})) for name in names
        }


def read_truth(folder: Path, *, table: Path | None = None) -> Truth:
    """Read class folders, with a table class → features; or a dataset, a folder with scenes.csv.

    Parameters
    ----------
    folder : Path
    table : Path or None
        Of class folders: a row a class, a column a feature.

    Raises
    ------
    SeeWhyError
        If two pictures have the same name, or a class has no row.
    """
    scenes = folder / "scenes.csv"
    if scenes.is_file():
        return _of_dataset(folder, scenes)
    rows: dict[str, dict[str, str]] = {}
    text = ""
    if table is not None:
        text = table.read_text(encoding="utf-8")
        rows = {row[CLASS]: row for row in csv.DictReader(text.splitlines())}
    values: dict[str, dict[str, str]] = {}
    files: dict[str, Path] = {}
    for file in sorted(folder.glob("*/*")):
        if file.suffix.lower() not in ENDINGS:
            continue
        label = file.parent.name
        if table is not None and label not in rows:
            raise SeeWhyError(f"{table} has no row for the class {label}; add one")
        if file.name in files:
            raise SeeWhyError(f"{file} and {files[file.name]} have the same name; rename one")
        files[file.name] = file
        values[file.name] = {**rows.get(label, {}), CLASS: label}
    return Truth(values, files, text)


def _of_dataset(folder: Path, scenes: Path) -> Truth:
    values: dict[str, dict[str, str]] = {}
    files: dict[str, Path] = {}
    with scenes.open(encoding="utf-8", newline="") as opened:
        for row in csv.DictReader(opened):
            file = folder / row.pop("image")
            for key in ("split", "group", "source"):
                row.pop(key, None)
            files[file.name] = file
            values[file.name] = {name: value for name, value in row.items() if value}
    return Truth(values, files)


def flat_folder(truth: Truth, folder: Path, *, names: Sequence[str] = (), seed: int = 0) -> Path:
    """Copy pictures into a new folder without anything that is known of them.

    Parameters
    ----------
    truth : Truth
    folder : Path
        New.
    names : sequence of str
        The pictures to copy; all where there are none.
    seed : int
        Of the order in which the files are written.
    """
    folder.mkdir(parents=True)
    order = list(names or truth.files)
    random.Random(seed).shuffle(order)
    for name in order:
        shutil.copyfile(truth.files[name], folder / name)
    return folder
