"""A project's files, written whole from its record: the command line reads what the pages show."""

from __future__ import annotations

import csv
import hashlib
import io
from collections.abc import Iterable, Mapping
from dataclasses import asdict
from pathlib import Path
from typing import Any, cast

from seewhy.data.scene_rows import IMAGE, NONE
from seewhy.domain.domain import Domain
from seewhy.domain.tables import CLASS, NO_THINGS
from seewhy.files.whole_files import write_whole
from seewhy.revision.edit import LEARNED, Edit, FileName, edited
from seewhy.studio.labels import Labels
from seewhy.studio.record import Entry, Record
from seewhy.studio.text_edits import edits_between

__all__ = [
    "FILES",
    "digest_of_text",
    "folder_texts",
    "learned_edits",
    "outside_body",
    "revision_body",
    "scenes_table",
    "write_text",
]

FILES = "files"
"""Entries of this kind say what a domain's files hold, and ``why``.

``files`` is name → text. A revision has ``edits`` instead, what was written in the place of what,
so that it can be taken back whatever was revised behind it.
"""


def scenes_table(labels: Labels, domain: Domain) -> str:
    """The text of scenes.csv: a row for each picture of which something is annotated."""
    drawn_in = labels.drawn if domain.things is not None else {}
    empty = {picture for picture, here in drawn_in.items() if here.none}
    none = (NO_THINGS,) if empty else ()
    columns = (IMAGE, "split", CLASS, *domain.features, *none, "group", "reasons")
    stream = io.StringIO()
    table = csv.writer(stream, lineterminator="\n")
    table.writerow(columns)
    drawn = {picture for picture, here in labels.drawn.items() if here.things}
    for picture in sorted({*labels.of, *labels.rows, *drawn, *empty}):
        said = labels.values(picture)
        row = labels.rows.get(picture, {})
        reasons = [name for name in labels.reasons.get(picture, ()) if name in said]
        if not said and not row and picture not in drawn | empty:
            continue
        cells = {
            IMAGE: picture,
            **said,
            **({NO_THINGS: NONE} if picture in empty else {}),
            "split": row.get("split", ""),
            "group": row.get("group", ""),
            "reasons": " ".join(reasons) if CLASS in said else "",
        }
        table.writerow([cells.get(column, "") for column in columns])
    return stream.getvalue()


def revision_body(edits: Iterable[Edit], *, why: str) -> dict[str, Any]:
    """The body of an entry that revises files by edits.

    Examples
    --------
    >>> body = revision_body([Edit("knowledge.al", 0, "a.", "b.")], why="a was wrong")
    >>> said = Entry(1, "", "Ada", FILES, {"files": {"knowledge.al": "a."}, "why": "outside"})
    >>> folder_texts([said, Entry(2, "", "Ada", FILES, body)])
    {'knowledge.al': 'b.'}
    """
    return {"edits": [asdict(edit) for edit in edits], "why": why}


def outside_body(said: Mapping[str, str], found: Mapping[str, str], *, why: str) -> dict[str, Any]:
    """The body of an entry that takes in what another program wrote.

    It has edits where the record has a text of the file, so that what was revised before can
    still be taken back.

    Parameters
    ----------
    said, found : mapping of str to str
        Name → text, as the record and as the files have it.
    why : str

    Examples
    --------
    >>> outside_body({}, {"knowledge.al": "a."}, why="edited")
    {'edits': [], 'why': 'edited', 'files': {'knowledge.al': 'a.'}}
    """
    edits: list[Edit] = []
    whole: dict[str, str] = {}
    for name, text in found.items():
        # All files of a domain are edited alike.
        file = cast("FileName", name)
        changes = edits_between(file, said[name], text) if name in said else ()
        if name in said and edited({file: said[name]}, changes)[file] == text:
            edits += changes
        else:
            whole[name] = text
    return {**revision_body(edits, why=why), "files": whole}


def folder_texts(entries: Iterable[Entry]) -> dict[str, str]:
    """Name → text of a domain's files, as the record has them last.

    Raises
    ------
    RevisionError
        If what an edit replaces does not stand in the file.
    """
    texts: dict[str, str] = {}
    for entry in entries:
        if entry.kind != FILES:
            continue
        texts |= entry.body.get("files", {})
        for edit in _edits_of(entry):
            if edit.file != LEARNED:
                texts[edit.file] = edit.applied(texts.get(edit.file, ""))
    return texts


def learned_edits(entries: Iterable[Entry]) -> tuple[Edit, ...]:
    """What revisions change of the axioms that a model learned, in their order."""
    return tuple(
        edit
        for entry in entries
        if entry.kind == FILES
        for edit in _edits_of(entry)
        if edit.file == LEARNED
    )


def _edits_of(entry: Entry) -> Iterable[Edit]:
    return (Edit(**edit) for edit in entry.body.get("edits", ()))


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
