"""The pictures that somebody means by folders, patterns, files and tables."""

from __future__ import annotations

import glob
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from seewhy.data.dataset import TABLE
from seewhy.data.importers.annotation import Notes
from seewhy.data.importers.folder_files import LINKS_OUT, FolderFiles
from seewhy.data.importers.picture_files import is_picture_name
from seewhy.data.picture_path import require_own_table
from seewhy.data.scene import TablePlace
from seewhy.data.scene_rows import IMAGE, OPTIONAL, columns_of, scenes_of_rows
from seewhy.data.table import read_table
from seewhy.domain.domain import Domain
from seewhy.domain.tables import CLASS
from seewhy.errors import DatasetError

__all__ = ["PictureListing", "list_pictures"]

_TABLES = (".csv", ".tsv")
_NO_PICTURES = {
    "a table; save it as CSV": (".xlsx", ".xlsm", ".xls", ".ods", ".json", ".jsonl", ".parquet"),
    "an archive; unpack it and name the folder": (".zip", ".tar", ".tgz", ".gz", ".7z", ".rar"),
}
"""What files are that nobody means as a picture, and the remedy, by how their names end."""


@dataclass(frozen=True)
class PictureListing:
    """Pictures to be classified.

    Attributes
    ----------
    pictures : tuple of Path
        Each once, in the order in which they were named; those of a folder sorted.
    with_class : int
        Rows of tables that were left out because they have a class.
    tables : tuple of Path
        The tables that were read.
    links_out : tuple of str
        Links of folders that lead out of them and were left out.
    """

    pictures: tuple[Path, ...]
    with_class: int = 0
    tables: tuple[Path, ...] = ()
    links_out: tuple[str, ...] = ()


def list_pictures(
    named: Sequence[Path | str],
    domain: Domain,
    *,
    with_class: bool = False,
    outside: bool = False,
) -> PictureListing:
    """Return the pictures that are meant.

    Parameters
    ----------
    named : sequence of Path or str
        Folders (the pictures in them and below, by their endings), patterns such as
        ``photos/**/*.jpg``, picture files of any name, and tables (``.csv``, ``.tsv``) with a
        column ``image``. A folder with a ``scenes.csv`` is a dataset: that table is read.
    domain : Domain
        Whose classes the tables may name; columns that it does not know are not looked at.
    with_class : bool, default False
        Whether rows of tables that have a class are meant, too.
    outside : bool, default False
        Whether tables may name pictures that lie outside of their folder, and links of folders
        lead there.

    Raises
    ------
    DatasetError
        If there is no such file, or no picture is meant; if a table cannot be used.

    Examples
    --------
    >>> import tempfile
    >>> from seewhy.domain.domain import load_domain
    >>> folder = Path(tempfile.mkdtemp())
    >>> for name in ("b.jpg", "a.png", "notes.txt"):
    ...     (folder / name).touch()
    >>> listing = list_pictures([folder, folder / "*.jpg"], load_domain("structure_stability"))
    >>> [picture.name for picture in listing.pictures]
    ['a.png', 'b.jpg']
    """
    pictures: dict[Path, None] = {}
    left_out = 0
    tables: list[Path] = []
    notes = Notes()
    for name in named:
        for place in _places(Path(name)):
            table = _table_of(place)
            if table is not None and table != place:
                require_own_table(table, outside=outside)
            if table is None:
                pictures.update(dict.fromkeys(_of_place(place, notes, outside=outside)))
                continue
            meant, labelled = _of_table(table, domain, with_class=with_class, outside=outside)
            pictures.update(dict.fromkeys(meant))
            left_out += labelled
            tables.append(table)
    if not pictures:
        raise DatasetError(_nothing(named, left_out))
    return PictureListing(tuple(pictures), left_out, tuple(tables), notes.places(LINKS_OUT))


def _places(named: Path) -> list[Path]:
    """The file or folder of this name, or else those that fit it as a pattern."""
    if named.exists():
        return [named]
    text = str(named)
    if not glob.has_magic(text):
        raise DatasetError(
            f"{named}: there is no such picture, folder or table; check the spelling of the path"
        )
    found = [Path(place) for place in sorted(glob.glob(text, recursive=True))]  # noqa: PTH207
    # A pattern such as photos/* also finds what is no picture, which nobody meant.
    fitting = [place for place in found if place.is_dir() or is_picture_name(place.name)]
    if not fitting:
        what = "fits the pattern" if not found else "that fits the pattern is a picture"
        raise DatasetError(
            f"{named}: nothing {what}; try it with ls, and put it in quotes if the shell changes it"
        )
    return fitting


def _table_of(place: Path) -> Path | None:
    if place.is_dir():
        return place / TABLE if (place / TABLE).is_file() else None
    return place if place.suffix.casefold() in _TABLES else None


def _of_place(place: Path, notes: Notes, *, outside: bool) -> Iterator[Path]:
    if place.is_dir():
        files = FolderFiles(place, notes, outside=outside)
        yield from (place / name for name in files.names if is_picture_name(name))
        return
    for what, endings in _NO_PICTURES.items():
        if place.suffix.casefold() in endings:
            raise DatasetError(f"{place}: is no picture, it is {what}")
    yield place


def _of_table(
    file: Path, domain: Domain, *, with_class: bool, outside: bool
) -> tuple[list[Path], int]:
    """The pictures of a table, and how many of its rows have a class and are not meant."""
    table = read_table(file, known=columns_of(domain), optional=OPTIONAL)
    # What else a table says of its pictures need not fit the domain: it is not looked at.
    kept = [n for n, name in enumerate(table.columns) if name in (IMAGE, CLASS)]
    scenes = scenes_of_rows(
        [table.columns[n] for n in kept],
        ((row.line, [(*row.cells, *[""] * n)[n] for n in kept]) for row in table.rows),
        domain,
        folder=file.parent,
        place=TablePlace(str(file)),
        header=table.line,
        outside=outside,
    )
    meant: list[Path] = []
    left_out = 0
    for scene in scenes:
        if scene.label is None or with_class:
            meant.append(scene.picture)
        else:
            left_out += 1
    return meant, left_out


def _nothing(named: Sequence[Path | str], left_out: int) -> str:
    said = ", ".join(map(str, named))
    if left_out:
        return (
            f"{said}: every row has a class, so that there is nothing to classify; --all (in "
            "Python: with_class=True) classifies these pictures, too"
        )
    return (
        f"{said}: holds no picture (.jpg, .png and others); name the folder that holds the "
        "pictures, or their files"
    )
