"""The finished rows of a table that is not, kept beside it as JSON lines."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

from seewhy.classification.rows import Cell

__all__ = ["UnfinishedTable"]


class UnfinishedTable:
    """Rows of a table that were finished, in a file beside it, until all are.

    The file begins with a line that says of what the rows are. A killed program may leave the
    last row cut short: it counts as not finished.

    Parameters
    ----------
    table : Path
        The table; the rows are kept in a file of the same name with ``.part`` behind.
    about : mapping
        What settles the rows, as values that JSON can hold.
    width : int
        Cells a row.

    Attributes
    ----------
    file : Path
    done : int
        Rows that are finished.
    differs : tuple of str
        Where there were rows of something else, which were dropped: the keys of ``about`` in
        which that differed; empty where there were none.

    Examples
    --------
    >>> import tempfile
    >>> table = Path(tempfile.mkdtemp()) / "table.csv"
    >>> with UnfinishedTable(table, {"model": "1"}, width=2) as rows:
    ...     rows.add([["a.png", 0.5], ["b.png", None]])
    >>> with UnfinishedTable(table, {"model": "1"}, width=2) as rows:
    ...     rows.done, list(rows)
    (2, [['a.png', 0.5], ['b.png', None]])
    >>> with UnfinishedTable(table, {"model": "2"}, width=2) as rows:
    ...     rows.done, rows.differs
    (0, ('model',))
    """

    def __init__(self, table: Path, about: Mapping[str, Any], *, width: int) -> None:
        self.file = table.with_name(f"{table.name}.part")
        self._width = width
        self.done = 0
        self.differs: tuple[str, ...] = ()
        self.file.parent.mkdir(parents=True, exist_ok=True)
        header = f"{json.dumps(dict(about))}\n".encode()
        end = self._find_end(json.loads(header))
        self._stream = self.file.open("ab")
        self._stream.truncate(end)
        if end == 0:
            self._stream.write(header)
            self._stream.flush()

    def _find_end(self, about: dict[str, Any]) -> int:
        """Where the finished rows end: 0 where there are none of this kind."""
        if not self.file.is_file():
            return 0
        with self.file.open("rb") as lines:
            first = next(lines, b"")
            found = _parsed(first)
            if found != about:
                # Of a header that was cut short there is nothing to say.
                if isinstance(found, dict):
                    self.differs = tuple(
                        key for key in about if found.get(key, object()) != about[key]
                    )
                return 0
            end = len(first)
            for line in lines:
                row = _parsed(line)
                if not isinstance(row, list) or len(row) != self._width:
                    break
                end += len(line)
                self.done += 1
        return end

    def add(self, rows: Sequence[Sequence[Cell]]) -> None:
        """Keep more finished rows."""
        self._stream.write(b"".join(f"{json.dumps(row)}\n".encode() for row in rows))
        self._stream.flush()
        self.done += len(rows)

    def __iter__(self) -> Iterator[list[Cell]]:
        """Yield the finished rows from the file; they are never all in the memory."""
        with self.file.open("rb") as lines:
            next(lines)
            for line in lines:
                yield json.loads(line)

    def remove(self) -> None:
        """Remove the file: the table is finished."""
        self._stream.close()
        self.file.unlink()

    def __enter__(self) -> UnfinishedTable:
        return self

    def __exit__(self, *_: object) -> None:
        self._stream.close()


def _parsed(line: bytes) -> Any:
    """The value of a whole line of JSON; None where it is none."""
    try:
        return json.loads(line) if line.endswith(b"\n") else None
    except (ValueError, RecursionError):
        return None
