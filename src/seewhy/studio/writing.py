"""A project's files, written whole from its record: the command line reads what the pages show."""

from __future__ import annotations

import csv
import hashlib
import io
from collections.abc import Iterable, Mapping
from pathlib import Path

from seewhy.data.scene_rows import IMAGE
from seewhy.domain.domain import Domain
from seewhy.domain.tables import CLASS
from seewhy.files.whole_files import write_whole
from seewhy.studio.labels import Labels
from seewhy.studio.record import Entry, Record

__all__ = ["FILES", "digest_of_text", "folder_texts", "scenes_table", "write_text"]

FILES = "files"
"""Entries of this kind have ``files``, name → text of a domain's file, and ``why``."""


def scenes_table(labels: Labels, domain: Domain) -> str:
    """The text of scenes.csv: a row for each picture of which something is annotated."""
    columns = (IMAGE, "split", CLASS, *domain.features, "group", "reasons")
    stream = io.StringIO()
    table = csv.writer(stream, lineterminator="\n")
    table.writerow(columns)
    for picture in sorted({*labels.of, *labels.rows}):
        said = labels.values(picture)
        row = labels.rows.get(picture, {})
        reasons = [name for name in labels.reasons.get(picture, ()) if name in said]
        if not said and not row:
            continue
        cells = {
            IMAGE: picture,
            **said,
            "split": row.get("split", ""),
            "group": row.get("group", ""),
            "reasons": " ".join(reasons) if CLASS in said else "",
        }
        table.writerow([cells.get(column, "") for column in columns])
    return stream.getvalue()


def folder_texts(entries: Iterable[Entry]) -> dict[str, str]:
    """Name → text of a domain's files, as the record has them last."""
    texts: dict[str, str] = {}
    for entry in entries:
        if entry.kind == FILES:
            texts |= entry.body["files"]
    return texts


def write_text(file: Path, text: str, *, record: Record, name: str) -> bool:
    """Write a file in one step, unless it has this text already; whether it was written."""
    if read_text(file) == text:
        changed = False
    else:
        write_whole(file, text)
        changed = True
    digest = digest_of_text(text)
    if record.written(name) != digest:
        record.note_written(name, digest)
    return changed


def changed_outside(file: Path, texts: Mapping[str, str], *, record: Record, name: str) -> bool:
    """Whether somebody else changed a file since the studio wrote it.

    Parameters
    ----------
    file : Path
    texts : mapping of str to str
        Name → text that the record gives.
    record : Record
    name : str
        Of the file, as the record knows it.
    """
    found = read_text(file)
    return (
        found is not None
        and found != texts.get(name)
        and digest_of_text(found) != record.written(name)
    )


def read_text(file: Path) -> str | None:
    """The text of a file; None where there is none that can be read."""
    try:
        return file.read_bytes().decode("utf-8-sig")
    except (OSError, UnicodeDecodeError):
        return None


def digest_of_text(text: str) -> str:
    """The digest by which the record knows what it wrote."""
    return hashlib.sha256(text.encode()).hexdigest()
