"""The official layout: Training/NNNNN and Testing/NNNNN with pictures and GT-NNNNN.csv."""

from __future__ import annotations

import csv
import io
import re
from collections.abc import Collection, Iterator, Sequence
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass, field
from pathlib import Path, PurePosixPath

from seewhy.errors import DatasetError
from seewhy_lab.belgiumts.container import Container, DamagedFileError, open_container

HALVES = {"train": "Training", "test": "Testing"}
"""The halves of the photographs: split → the name of its folder."""

PHOTOGRAPHS = {"train": 4575, "test": 2520}
"""How many distinct photographs the official halves hold."""

PICTURE_ENDINGS = (".ppm", ".png", ".jpg", ".jpeg")
_COLUMNS = ("Filename", "Width", "Height", "Roi.X1", "Roi.Y1", "Roi.X2", "Roi.Y2", "ClassId")
_CLASS_FOLDER = re.compile(r"\d{5}")
_POLE = re.compile(r"(\d{5})(?!\d)")


@dataclass(frozen=True)
class Region:
    """Where the sign is in a picture of ``width`` × ``height``, in pixels from the top left.

    In the official tables all of them count rows where they say X or Width, and columns where
    they say Y or Height; and where somebody has rescaled the pictures, they still speak of the
    original ones. :meth:`within` settles both by the size that a picture really has.
    """

    width: int
    height: int
    left: int
    top: int
    right: int
    bottom: int

    def within(self, width: int, height: int) -> tuple[int, int, int, int] | None:
        """Return left, top, right, bottom in a picture of this real size.

        None where the picture is neither the noted one nor the same rescaled, in either order
        of its sides.

        Examples
        --------
        >>> Region(100, 200, 10, 20, 90, 180).within(100, 50)  # sides swapped and halved
        (10, 5, 90, 45)
        >>> Region(100, 200, 10, 20, 90, 180).within(70, 70) is None
        True
        """
        swapped = Region(self.height, self.width, self.top, self.left, self.bottom, self.right)
        for region in (swapped, self):
            scale = max(width, height) / max(region.width, region.height)
            # One pixel of leeway: whoever rescaled the picture rounded its sides.
            if abs(region.width * scale - width) <= 1 and abs(region.height * scale - height) <= 1:
                return (
                    max(0, round(region.left * scale)),
                    max(0, round(region.top * scale)),
                    min(width, round(region.right * scale)),
                    min(height, round(region.bottom * scale)),
                )
        return None


@dataclass(frozen=True)
class Photograph:
    """One picture file of a half; ``region`` is None where no row of the table names it."""

    class_id: int
    name: str
    region: Region | None

    @property
    def stem(self) -> str:
        """The file's name without folders and ending."""
        return PurePosixPath(self.name).stem

    @property
    def group(self) -> str:
        """Class and pole, as in "00021/01153": such photographs show one physical sign.

        Empty where the file's name does not begin with the five digits of a pole.
        """
        pole = _POLE.match(self.stem)
        return f"{self.class_id:05d}/{pole[1]}" if pole else ""


@dataclass(frozen=True)
class LeftOut:
    """A file that is not used, and why."""

    file: str
    reason: str


@dataclass(frozen=True)
class Half:
    """The training or the testing half, as it was found.

    Attributes
    ----------
    split : str
        "train" or "test".
    container : Container
        What it was found in, still open.
    folder : str
        Its folder from there.
    photographs : tuple of Photograph
        By class, then by name.
    repeated_rows : int
        Rows of the tables that name a picture again.
    rows_without_file, files_without_row : tuple of str
    left_out : tuple of LeftOut
    """

    split: str
    container: Container
    folder: str
    photographs: tuple[Photograph, ...]
    repeated_rows: int
    rows_without_file: tuple[str, ...]
    files_without_row: tuple[str, ...]
    left_out: tuple[LeftOut, ...]


@dataclass
class _Found:
    """What one class folder adds to a half."""

    photographs: list[Photograph] = field(default_factory=list)
    repeated_rows: int = 0
    rows_without_file: list[str] = field(default_factory=list)
    files_without_row: list[str] = field(default_factory=list)
    left_out: list[LeftOut] = field(default_factory=list)


@contextmanager
def open_halves(paths: Sequence[Path], *, class_ids: Collection[int]) -> Iterator[list[Half]]:
    """Yield the halves found at the paths, training first; the containers stay open meanwhile.

    Each path is an archive, a folder that somebody extracted (Training itself, or one above it),
    or a folder that holds archives. ``class_ids`` are the classes that there may be.

    Raises
    ------
    DatasetError
        If a path holds neither half, a half is there twice, a class folder is unknown, or a
        table cannot be read; the text names the place and the remedy.
    """
    with ExitStack() as stack:
        found: dict[str, tuple[Container, str, list[str]]] = {}
        containers = {
            container_path.resolve(): container_path
            for path in paths
            for container_path in _containers(path)
        }
        for path in containers.values():
            container = stack.enter_context(open_container(path))
            for split, folders in _half_folders(container).items():
                for folder, names in folders.items():
                    if split in found:
                        first, where, _ = found[split]
                        raise DatasetError(
                            f"{container.path / folder}: the {HALVES[split]} half is also in "
                            f"{first.path / where}; give one of the two"
                        )
                    found[split] = (container, folder, names)
        if not found:
            raise DatasetError(_nothing_found(paths))
        yield [_read_half(split, *found[split], class_ids) for split in HALVES if split in found]


def _containers(path: Path) -> list[Path]:
    """The path itself, and the archives in it that are named after a half."""
    named = sorted(
        archive for archive in path.glob("*.zip") if _split_of(archive.stem) and archive.is_file()
    )
    return [path, *named]


def _split_of(name: str) -> str | None:
    """The half that a folder or an archive is named after.

    Examples
    --------
    >>> _split_of("BelgiumTSC_Training (1)"), _split_of("Testing"), _split_of("trainings")
    ('train', 'test', None)
    """
    words = re.findall("[a-z]+", name.casefold())
    named = [split for split, folder in HALVES.items() if folder.casefold() in words]
    return named[0] if len(named) == 1 else None


def _half_folders(container: Container) -> dict[str, dict[str, list[str]]]:
    """Split → folder of a half → the names of the pictures and tables in its class folders."""
    halves: dict[str, dict[str, list[str]]] = {}
    for name in container.names():
        path = PurePosixPath(name)
        if len(path.parts) < 2 or not (_is_picture(path) or path.suffix.lower() == ".csv"):
            continue
        half = path.parent.parent
        # A class folder may lie at the top: then the archive or folder itself is the half.
        split = _split_of(half.name or container.path.resolve().stem)
        if split is not None:
            halves.setdefault(split, {}).setdefault(str(half), []).append(name)
    # Other folders may be called Training as well; these have at least one class folder.
    return {
        split: {folder: names for folder, names in folders.items() if _has_class_folder(names)}
        for split, folders in halves.items()
    }


def _has_class_folder(names: list[str]) -> bool:
    return any(_CLASS_FOLDER.fullmatch(PurePosixPath(name).parent.name) for name in names)


def _is_picture(path: PurePosixPath) -> bool:
    return path.suffix.lower() in PICTURE_ENDINGS


def _nothing_found(paths: Sequence[Path]) -> str:
    places = ", ".join(str(path) for path in paths)
    return (
        f"{places}: holds no photographs of BelgiumTS; give BelgiumTSC_Training.zip, "
        "BelgiumTSC_Testing.zip, or a folder with Training/00000 … or Testing/00000 …"
    )


def _read_half(
    split: str, container: Container, folder: str, names: list[str], class_ids: Collection[int]
) -> Half:
    by_class: dict[str, list[str]] = {}
    for name in names:
        by_class.setdefault(PurePosixPath(name).parent.name, []).append(name)
    all_found = _Found()
    for class_folder, members in sorted(by_class.items()):
        place = container.path / folder / class_folder
        if not _CLASS_FOLDER.fullmatch(class_folder) or int(class_folder) not in class_ids:
            raise DatasetError(
                f"{place}: is the folder of no known class (they are named 00000 to "
                f"{max(class_ids):05d}); remove it, or add its class to classes.csv"
            )
        _read_class(container, class_folder, members, all_found)
    return Half(
        split=split,
        container=container,
        folder=folder,
        photographs=tuple(all_found.photographs),
        repeated_rows=all_found.repeated_rows,
        rows_without_file=tuple(all_found.rows_without_file),
        files_without_row=tuple(all_found.files_without_row),
        left_out=tuple(all_found.left_out),
    )


def _read_class(container: Container, folder: str, names: list[str], into: _Found) -> None:
    class_id = int(folder)
    home = PurePosixPath(names[0]).parent
    tables = [n for n in names if PurePosixPath(n).name.lower() == f"gt-{folder}.csv"]
    regions: dict[str, tuple[int, Region]] = {}
    for table in tables:
        for filename, row_class, region in _rows(container, table):
            # A table may still say .ppm where somebody has saved the pictures as PNG.
            stem = PurePosixPath(filename).stem
            if stem in regions:
                into.repeated_rows += 1
            else:
                regions[stem] = (row_class, region)
    seen: dict[str, str] = {}
    for name in names:
        if not _is_picture(PurePosixPath(name)):
            continue
        stem = PurePosixPath(name).stem
        row_class, own_region = regions.get(stem, (class_id, None))
        if stem in seen:
            into.left_out.append(LeftOut(name, f"has the same name as {seen[stem]}"))
        elif row_class != class_id:
            into.left_out.append(
                LeftOut(name, f"is of class {row_class:05d} by its row, but lies in {folder}")
            )
        else:
            into.photographs.append(Photograph(class_id, name, own_region))
            if own_region is None:
                into.files_without_row.append(name)
        seen.setdefault(stem, PurePosixPath(name).name)
    into.rows_without_file += [f"{home}/{stem}" for stem in regions if stem not in seen]


def _rows(container: Container, table: str) -> Iterator[tuple[str, int, Region]]:
    """Yield file name, class and region of every row of a GT-NNNNN.csv."""
    here = container.path / table
    try:
        text = container.read(table).decode("utf-8-sig")
    except UnicodeDecodeError:
        raise DatasetError(
            f"{here}: is not UTF-8 text; take it from the official archive"
        ) from None
    except DamagedFileError as problem:
        raise DatasetError(f"{here}: {problem}; download the archive again") from None
    reader = csv.DictReader(io.StringIO(text, newline=""), delimiter=";")
    columns = [name.strip() for name in reader.fieldnames or ()]
    if not columns:
        return
    reader.fieldnames = columns
    for column in _COLUMNS:
        if column not in columns:
            raise DatasetError(
                f"{here}:1: the column '{column}' is missing; the columns must be "
                f"{';'.join(_COLUMNS)}"
            )
    try:
        for row in reader:
            yield _row(row, f"{here}:{reader.line_num}")
    except csv.Error as problem:
        raise DatasetError(
            f"{here}:{reader.line_num}: is no table ({problem}); take it from the official archive"
        ) from None


def _row(row: dict[str, str | None], here: str) -> tuple[str, int, Region]:
    filename = (row["Filename"] or "").strip()
    numbers = {}
    for column in _COLUMNS[1:]:
        cell = (row[column] or "").strip()
        if not re.fullmatch(r"\d{1,9}", cell, re.ASCII):
            raise DatasetError(
                f"{here}: {column} must be a whole number from 0, got '{cell}'; take the table "
                "from the official archive"
            )
        numbers[column] = int(cell)
    if not filename:
        raise DatasetError(f"{here}: the cell 'Filename' is empty; name the picture's file")
    if not numbers["Width"] or not numbers["Height"]:
        raise DatasetError(
            f"{here}: Width and Height must be at least 1, got 0; take the table from the "
            "official archive"
        )
    class_id = numbers.pop("ClassId")
    return filename, class_id, Region(*numbers.values())
