"""The record of a studio's project: what was done, by whom and when; nothing in it is changed."""

from __future__ import annotations

import json
import sqlite3
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from datetime import UTC, datetime
from pathlib import Path
from threading import RLock
from typing import Any

from seewhy.errors import SeeWhyError

__all__ = ["UNDO", "Entry", "Record"]

UNDO = "undo"
"""The kind of an entry that takes another back, one of this kind included."""

_SCHEMA = """
CREATE TABLE IF NOT EXISTS entries (
    number INTEGER PRIMARY KEY AUTOINCREMENT,
    at TEXT NOT NULL,
    who TEXT NOT NULL,
    kind TEXT NOT NULL,
    body TEXT NOT NULL,
    takes_back INTEGER REFERENCES entries (number)
);
CREATE TABLE IF NOT EXISTS written (file TEXT PRIMARY KEY, digest TEXT NOT NULL);
CREATE TRIGGER IF NOT EXISTS nothing_is_changed BEFORE UPDATE ON entries
    BEGIN SELECT RAISE(ABORT, 'the record is only added to'); END;
CREATE TRIGGER IF NOT EXISTS nothing_is_removed BEFORE DELETE ON entries
    BEGIN SELECT RAISE(ABORT, 'the record is only added to'); END;
"""


@dataclass(frozen=True)
class Entry:
    """One thing that was done.

    Attributes
    ----------
    number : int
        From 1, in the order in which things were done.
    at : str
        When, as ISO 8601 in UTC.
    who : str
    kind : str
        Such as ``label``; :mod:`seewhy.studio.labels` and the pages say what their kinds hold.
    body : mapping
        What was done, as JSON has it.
    takes_back : int or None
        The number of the entry that this one takes back.
    """

    number: int
    at: str
    who: str
    kind: str
    body: Mapping[str, Any] = field(repr=False)
    takes_back: int | None = None


class Record:
    """An append-only record in one SQLite file, which threads and processes may share.

    An entry is on the disk when :meth:`add` returns: a killed process loses at most the one that
    it was about to add.

    Parameters
    ----------
    file : Path
        Made where it is missing.

    Raises
    ------
    SeeWhyError
        If the file is no record.

    Examples
    --------
    >>> import tempfile
    >>> record = Record(Path(tempfile.mkdtemp()) / "studio.sqlite")
    >>> red = record.add("label", {"values": {"a.png": {"colour": "red"}}}, who="Ada")
    >>> undo = record.take_back(red.number, who="Ada")
    >>> [entry.kind for entry in record.holding()]
    []
    >>> _ = record.take_back(undo.number, who="Ada")
    >>> [entry.kind for entry in record.holding()]
    ['label']
    """

    def __init__(self, file: Path) -> None:
        self.file = file
        self._lock = RLock()
        self._entries: list[Entry] = []
        try:
            self._connection = sqlite3.connect(
                file, check_same_thread=False, isolation_level=None, timeout=30
            )
            self._connection.execute("PRAGMA journal_mode = WAL")
            self._connection.execute("PRAGMA synchronous = FULL")
            self._connection.executescript(_SCHEMA)
        except sqlite3.Error as problem:
            raise SeeWhyError(
                f"{file}: cannot be used as the studio's record ({problem}); move it away to begin "
                "a new one"
            ) from None

    def add(
        self, kind: str, body: Mapping[str, Any], *, who: str, takes_back: int | None = None
    ) -> Entry:
        """Add an entry; it is on the disk when this returns."""
        at = datetime.now(UTC).isoformat(timespec="milliseconds")
        content = json.dumps(body, ensure_ascii=False, sort_keys=True)
        with self._lock:
            number = self._connection.execute(
                "INSERT INTO entries (at, who, kind, body, takes_back) VALUES (?, ?, ?, ?, ?)",
                (at, who, kind, content, takes_back),
            ).lastrowid
            assert number is not None
            return Entry(number, at, who, kind, json.loads(content), takes_back)

    def take_back(self, number: int, *, who: str) -> Entry:
        """Take an entry back; taking that back again makes the entry hold as before.

        Raises
        ------
        SeeWhyError
            If there is no such entry, or it is taken back already.
        """
        with self._lock:
            if number not in {entry.number for entry in self._holding()}:
                raise SeeWhyError(
                    f"entry {number} does not hold: it is taken back already, or there is none; "
                    "look at the history"
                )
            return self.add(UNDO, {}, who=who, takes_back=number)

    def all(self) -> Sequence[Entry]:
        """Every entry, whether it holds or not, in the order of the record."""
        with self._lock:
            after = self._entries[-1].number if self._entries else 0
            rows = self._connection.execute(
                "SELECT number, at, who, kind, body, takes_back FROM entries WHERE number > ? "
                "ORDER BY number",
                (after,),
            )
            self._entries += [
                Entry(number, at, who, kind, json.loads(body), takes_back)
                for number, at, who, kind, body, takes_back in rows
            ]
            return tuple(self._entries)

    def holding(self, *kinds: str, but: int | None = None) -> Sequence[Entry]:
        """Entries that nothing takes back, those of some kinds or all but the undoings.

        ``but`` is the number of one that is looked at as if it were taken back.
        """
        return tuple(
            entry
            for entry in self._holding(but)
            if (entry.kind in kinds if kinds else entry.kind != UNDO)
        )

    def _holding(self, but: int | None = None) -> list[Entry]:
        taken_back = set() if but is None else {but}
        found: list[Entry] = []
        # What takes an entry back stands behind it.
        for entry in reversed(self.all()):
            if entry.number in taken_back:
                continue
            found.append(entry)
            if entry.takes_back is not None:
                taken_back.add(entry.takes_back)
        return found[::-1]

    def written(self, file: str) -> str:
        """The digest of a file as the studio wrote it last; empty where it never did."""
        with self._lock:
            row = self._connection.execute(
                "SELECT digest FROM written WHERE file = ?", (file,)
            ).fetchone()
        return str(row[0]) if row else ""

    def note_written(self, file: str, digest: str) -> None:
        """Keep the digest of a file that was written."""
        with self._lock:
            self._connection.execute("INSERT OR REPLACE INTO written VALUES (?, ?)", (file, digest))

    def close(self) -> None:
        """Close the file."""
        with self._lock:
            self._connection.close()
