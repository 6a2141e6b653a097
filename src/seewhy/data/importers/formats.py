"""Which format a source is in, and what reads it."""

from __future__ import annotations

from collections.abc import Callable, Iterator

from seewhy.data.annotation_formats import SAID, Format, format_called
from seewhy.data.importers.annotation import AnnotatedPicture
from seewhy.data.importers.class_folders import read_class_folders
from seewhy.data.importers.coco import coco_files, read_coco
from seewhy.data.importers.cvat import cvat_files, read_cvat
from seewhy.data.importers.label_studio import label_studio_files, read_label_studio
from seewhy.data.importers.picture_files import is_picture_name
from seewhy.data.importers.picture_table import has_pictures, read_picture_table, table_files
from seewhy.data.importers.source import Source
from seewhy.data.importers.voc import is_voc, read_voc
from seewhy.data.importers.yolo import read_yolo, yolo_files
from seewhy.errors import DatasetError

Reader = Callable[[Source], Iterator[AnnotatedPicture]]


def reader_of(format: Format) -> Reader:
    """Return the function that reads a format."""
    readers: dict[Format, Reader] = {
        "folder": read_class_folders,
        "coco": read_coco,
        "voc": read_voc,
        "yolo": read_yolo,
        "labelstudio": read_label_studio,
        "cvat": read_cvat,
        "table": read_picture_table,
    }
    return readers[format]


def found_formats(source: Source) -> dict[Format, str]:
    """Return format → a file by which a source is in it; class folders only where nothing else is.

    Examples
    --------
    >>> import pathlib, tempfile
    >>> from seewhy.data.importers.annotation import Notes
    >>> from seewhy.data.importers.folder_files import FolderFiles
    >>> home = pathlib.Path(tempfile.mkdtemp())
    >>> (home / "cat").mkdir()
    >>> (home / "cat" / "1.jpg").touch()
    >>> files = FolderFiles(home)
    >>> found_formats(Source(files, files, Notes()))
    {'folder': 'cat/1.jpg'}
    """
    found: dict[Format, str] = {}
    for kind, files in (
        ("coco", coco_files(source)),
        ("labelstudio", label_studio_files(source)),
        ("cvat", cvat_files(source)),
        ("yolo", yolo_files(source)),
    ):
        if files:
            found[format_called(kind)] = files[0]
    if is_voc(source):
        found["voc"] = source.named(".xml")[0]
    if not found:
        is_named = source.only is not None
        tables = [
            name
            for name in table_files(source)
            if (is_named or not name.endswith(".json")) and has_pictures(source, name)
        ]
        if tables:
            found["table"] = tables[0]
    if not found and source.only is None:
        picture = next((name for name in source.pictures.names if is_picture_name(name)), None)
        if picture is not None:
            found["folder"] = picture
    return found


def format_of(source: Source) -> Format:
    """Return the one format that a source is in.

    Raises
    ------
    DatasetError
        If it is in none, or in several.
    """
    found = found_formats(source)
    if len(found) == 1:
        return next(iter(found))
    if not found:
        raise DatasetError(
            f"{source.said}: holds no pictures and no export that is read "
            f"({', '.join(SAID.values())}); name the folder, archive or file that does"
        )
    shown = ", ".join(f"{SAID[kind]} ({file})" for kind, file in found.items())
    raise DatasetError(
        f"{source.said}: holds annotations of several formats: {shown}; say which counts with "
        f"--format {' or --format '.join(found)}"
    )


def check_mixture(source: Source, wanted: Format) -> None:
    """Refuse a source that is in another format, and note formats that it is in as well.

    Raises
    ------
    DatasetError
        If it is not in the format that is wanted, but in another.
    """
    if wanted == "folder" and source.only is not None:
        raise DatasetError(
            f"{source.said}: is a file, class folders are a folder or a zip archive of them"
        )
    if wanted in ("folder", "table"):
        return  # whatever else there is: pictures in folders, and tables, lie beside exports
    found = found_formats(source)
    if wanted not in found and found.keys() - {"folder"}:
        other, file = next((kind, name) for kind, name in found.items() if kind != "folder")
        raise DatasetError(
            f"{source.said}: nothing in it is {SAID[wanted]}, but {file} is {SAID[other]}; give "
            f"the format {other}"
        )
    for kind, file in found.items():
        if kind != wanted:
            source.notes.add(
                f"annotations of other formats beside those of {SAID[wanted]}, not read",
                f"{file} ({SAID[kind]})",
            )
