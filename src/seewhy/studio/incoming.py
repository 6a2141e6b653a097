"""Pictures that come to a project: sent by a browser, from a folder, or from an export."""

from __future__ import annotations

import io
import re
import shutil
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import IO

from seewhy.data.dataset import TABLE, Dataset
from seewhy.data.importers import ImportRequest, import_pictures
from seewhy.data.importers.annotation import Notes
from seewhy.data.importers.folder_files import FolderFiles
from seewhy.data.importers.names import predicate_name
from seewhy.data.importers.picture_files import is_picture_name, read_header
from seewhy.data.importers.placing import Placing, image_names, safe_part
from seewhy.data.importers.reading import detect_format
from seewhy.data.importers.source_files import DamagedFileError
from seewhy.errors import DatasetError, PictureError, SeeWhyError
from seewhy.files.whole_files import whole_file
from seewhy.new_domain.from_source import new_domain_from
from seewhy.studio.labels import LABEL, ROWS
from seewhy.studio.project import Project

__all__ = [
    "LARGEST",
    "Arrived",
    "Sent",
    "domain_place",
    "from_folder",
    "from_source",
    "safe_name",
    "sent_picture",
]

LARGEST = 100_000_000
"""Bytes of one picture that a browser sends."""

_IMAGES = "images"
_INCOMING = ".incoming"
_DEEPEST = 8
_UNREAD = (".heic", ".heif", ".avif")
"""Photographs of telephones that are no pictures for SeeWhy."""

_CHUNK = 1 << 20


@dataclass(frozen=True)
class Arrived:
    """What became of pictures.

    Attributes
    ----------
    kept : int
        How many are in the project now that were not before.
    refused : tuple of str
        A sentence for each that is none.
    """

    kept: int = 0
    refused: tuple[str, ...] = ()


def safe_name(sent: str) -> str:
    """Return the path below the folder of pictures for the name that a browser sent.

    Nothing of it leads out, is hidden, or is no name on another system.

    Examples
    --------
    >>> [safe_name(name) for name in ("red/1.png", "../../etc/pass wd.png", "C:/a/.b.png")]
    ['red/1.png', 'etc/pass wd.png', 'C_/a/b.png']
    """
    parts = (part.strip(". ") for part in re.split(r"[/\\]+", sent))
    return "/".join([safe_part(part) for part in parts if part][-_DEEPEST:])


@dataclass(frozen=True)
class Sent:
    """A picture that a browser sent: its name in the project, and whether it is new."""

    name: str
    is_new: bool


def sent_picture(project: Project, name: str, content: IO[bytes]) -> Sent:
    """Keep a picture that a browser sent.

    Parameters
    ----------
    project : Project
    name : str
        As it was sent; see :func:`safe_name`.
    content : binary stream

    Raises
    ------
    PictureError
        If it is no picture of a format that is read, or too large.
    """
    safe = safe_name(name)
    if not is_picture_name(safe):
        raise PictureError(f"{safe or 'a file'} is no picture by its name; send .jpg, .png or such")
    held = io.BytesIO()
    while chunk := content.read(_CHUNK):
        held.write(chunk)
        if held.tell() > LARGEST:
            raise PictureError(f"{safe} has more than {LARGEST:,} bytes; send a smaller picture")
    held.seek(0)
    try:
        read_header(held)
    except (PictureError, DamagedFileError) as problem:
        raise PictureError(f"{safe}: {problem}") from None
    target = project.folder / _IMAGES / safe
    number = 1
    while target.exists():
        if target.is_file() and target.read_bytes() == held.getvalue():
            return Sent(target.relative_to(project.folder).as_posix(), False)
        number += 1
        target = target.with_name(f"{Path(safe).stem}-{number}{target.suffix}")
    with whole_file(target, durable=False) as temporary:
        temporary.write_bytes(held.getvalue())
    return Sent(target.relative_to(project.folder).as_posix(), True)


def from_folder(project: Project, folder: Path) -> Arrived:
    """Take in the pictures of a folder of this machine, linked where that can be.

    Raises
    ------
    DatasetError
        If there is no such folder, or no picture in it.
    """
    if folder.is_file():
        raise DatasetError(
            f"{folder}: is a file; name the folder that holds the pictures, or import an archive "
            "of labelled pictures below"
        )
    if not folder.is_dir():
        raise DatasetError(f"{folder}: there is no such folder; check the spelling of the path")
    files = FolderFiles(folder, Notes())
    names = [name for name in files.names if is_picture_name(name)]
    unread = [name for name in files.names if name.lower().endswith(_UNREAD)]
    if not names:
        remedy = f"; {_save_as_jpeg(unread)}" if unread else ""
        raise DatasetError(f"{folder}: holds no picture (.jpg, .png and others){remedy}")
    placing = Placing(files, project.folder, link=True)
    before = set(project.pictures())
    refused = [_save_as_jpeg(unread)] if unread else []
    for name, image in zip(names, image_names(names), strict=True):
        try:
            placing.place(name, image)
        except (PictureError, DamagedFileError) as problem:
            refused.append(f"{name}: {problem}")
    project.refresh()
    return Arrived(len(set(project.pictures()) - before), tuple(refused))


def _save_as_jpeg(names: Sequence[str]) -> str:
    one = len(names) == 1
    files = "1 file is" if one else f"{len(names):,} files are"
    return f"{files} HEIC or AVIF, which is not read; save {'it' if one else 'them'} as JPEG first"


def domain_place(project: Project) -> Path:
    """Where the project's domain is to be written: a new folder in it, named like the project."""
    name = predicate_name(project.name)
    place = project.folder / name
    return place if not place.exists() else project.folder / f"{name}_domain"


def from_source(project: Project, request: ImportRequest, *, subject: str, who: str) -> Arrived:
    """Take in labelled pictures: class folders, an export of a labelling tool, a dataset.

    Where the project has no domain yet, one is drafted from the labels.

    Raises
    ------
    DatasetError, DomainError
        If the source cannot be used, or says what the project's domain does not know.
    """
    incoming = project.folder / _INCOMING
    shutil.rmtree(incoming, ignore_errors=True)
    try:
        wanted = request if request.format else _with_format(request)
        import_pictures(wanted, incoming)
        if project.domain_folder is None:
            before = set(project.pictures())
            _move(project, incoming, everything=True)
            new_domain_from(
                ImportRequest(project.folder, "table"),
                domain_place(project),
                command_of=lambda request, *_: f"seewhy studio {request.source}",
                subject=subject,
            )
            project.refresh()
            return Arrived(len(set(project.pictures()) - before))
        return _join(project, incoming, who=who)
    finally:
        shutil.rmtree(incoming, ignore_errors=True)


def _with_format(request: ImportRequest) -> ImportRequest:
    return replace(request, format=detect_format(request))


def _join(project: Project, incoming: Path, *, who: str) -> Arrived:
    """Add what was imported to a project that has a domain."""
    dataset = Dataset.load(incoming, project.domain())
    values: dict[str, dict[str, str | None]] = {}
    rows: dict[str, dict[str, str]] = {}
    for scene in dataset.scenes:
        name = dataset.name_of(scene)
        said = {"class": scene.label, **dataset.domain.named(scene.vector)}
        values[name] = {key: value for key, value in said.items() if value is not None}
        placed = {"split": scene.split, "group": scene.group}
        rows[name] = {key: text for key, text in placed.items() if text}
    _move(project, incoming, everything=False)
    project.refresh()
    project.note(LABEL, {"values": values, "how": "table"}, who=who)
    if any(rows.values()):
        project.note(ROWS, {"rows": {name: row for name, row in rows.items() if row}}, who=who)
    return Arrived(len(values))


def _move(project: Project, incoming: Path, *, everything: bool) -> None:
    """Move pictures, and with ``everything`` the tables, into the project."""
    names = _files_below(incoming)
    pictures = [name for name in names if name.startswith(f"{_IMAGES}/")]
    taken = [name for name in pictures if (project.folder / name).exists()]
    if taken or (everything and (project.folder / TABLE).exists()):
        raise SeeWhyError(
            f"the project has '{taken[0] if taken else TABLE}' already; import into a new folder "
            "('seewhy studio NEW'), or rename it there"
        )
    for name in pictures if not everything else names:
        target = project.folder / name
        target.parent.mkdir(parents=True, exist_ok=True)
        (incoming / name).replace(target)


def _files_below(folder: Path) -> Sequence[str]:
    found: Iterable[Path] = folder.rglob("*")
    return sorted(path.relative_to(folder).as_posix() for path in found if path.is_file())
