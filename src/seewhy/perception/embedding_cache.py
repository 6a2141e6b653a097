"""Embeddings on disk by what they were made of: what is trained again costs seconds."""

from __future__ import annotations

import hashlib
import logging
import sqlite3
from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np
import numpy.typing as npt

__all__ = ["EmbeddingCache", "key_of"]

LARGEST = 4 << 30
"""Bytes on disk, above which what was not used for longest is forgotten."""

_FILE = "embeddings.sqlite"
_AT_ONCE = 500  # keys of one question to the database
_COLUMNS = "key BLOB PRIMARY KEY, shape TEXT, content BLOB, bytes INTEGER, used INTEGER"

_logger = logging.getLogger(__name__)

Array = npt.NDArray[np.float16]


def key_of(picture: npt.NDArray[np.uint8], *made_with: object) -> bytes:
    """The key of what is made of a picture: of its pixels, and of all else that matters.

    Examples
    --------
    >>> dark, light = np.zeros((8, 8, 3), np.uint8), np.ones((8, 8, 3), np.uint8)
    >>> key_of(dark, "backbone") == key_of(dark.copy(), "backbone") != key_of(light, "backbone")
    True
    """
    digest = hashlib.blake2b(repr(made_with).encode(), digest_size=16)
    digest.update(np.ascontiguousarray(picture).data)
    return digest.digest()


class EmbeddingCache:
    """Half-precision arrays by key, in one SQLite file that several programs may use.

    It never stands in the way: what cannot be read, written or locked counts as absent, and a
    damaged file is begun anew. Both are logged.

    Parameters
    ----------
    folder : Path or None
        Made where it is missing. None keeps nothing.
    largest : int
        See :data:`LARGEST`.

    Examples
    --------
    >>> import tempfile
    >>> cache = EmbeddingCache(Path(tempfile.mkdtemp()))
    >>> cache.keep({b"a": np.ones((2, 3), dtype=np.float16)})
    >>> sorted(cache.find([b"a", b"b"])), cache.find([b"a"])[b"a"].shape
    ([b'a'], (2, 3))
    """

    def __init__(self, folder: Path | None, *, largest: int = LARGEST) -> None:
        self.folder = folder
        self.largest = largest

    def find(self, keys: Sequence[bytes]) -> dict[bytes, Array]:
        """The arrays of those keys that there are."""
        found: dict[bytes, Array] = {}
        connection = self._connection()
        if connection is None:
            return found
        try:
            with connection:
                for start in range(0, len(keys), _AT_ONCE):
                    some = keys[start : start + _AT_ONCE]
                    marks = ", ".join("?" * len(some))
                    rows = connection.execute(
                        f"SELECT key, shape, content FROM embeddings WHERE key IN ({marks})", some
                    )
                    for key, shape, content in rows:
                        sides = tuple(int(side) for side in shape.split(","))
                        found[key] = np.frombuffer(content, dtype=np.float16).reshape(sides)
                    connection.execute(
                        f"UPDATE embeddings SET used = unixepoch() WHERE key IN ({marks})", some
                    )
        except (sqlite3.Error, ValueError, TypeError, AttributeError) as problem:
            _logger.warning("%s: an embedding cannot be read (%s)", self.folder, problem)
            return found
        finally:
            connection.close()
        return found

    def keep(self, arrays: Mapping[bytes, Array]) -> None:
        """Keep arrays; what was not used for longest goes where there is no room."""
        connection = self._connection()
        if connection is None or not arrays:
            return
        rows = [
            (key, ",".join(map(str, array.shape)), array.tobytes(), array.nbytes)
            for key, array in arrays.items()
        ]
        try:
            with connection:
                connection.executemany(
                    "INSERT OR REPLACE INTO embeddings VALUES (?, ?, ?, ?, unixepoch())", rows
                )
                self._make_room(connection)
        except sqlite3.Error as problem:
            _logger.warning("%s: embeddings cannot be kept (%s)", self.folder, problem)
        finally:
            connection.close()

    def _make_room(self, connection: sqlite3.Connection) -> None:
        (total,) = connection.execute("SELECT sum(bytes) FROM embeddings").fetchone()
        if total <= self.largest:
            return
        # Room for more than this once, so that not every call has to make it.
        excess = total - self.largest * 4 // 5
        oldest = connection.execute("SELECT key, bytes FROM embeddings ORDER BY used, rowid")
        gone = []
        for key, size in oldest:
            if excess <= 0:
                break
            gone.append((key,))
            excess -= size
        connection.executemany("DELETE FROM embeddings WHERE key = ?", gone)

    def _connection(self) -> sqlite3.Connection | None:
        if self.folder is None:
            return None
        file = self.folder / _FILE
        try:
            self.folder.mkdir(parents=True, exist_ok=True)
            return _opened(file)
        except (sqlite3.OperationalError, OSError) as problem:
            _logger.warning("%s: embeddings are neither found nor kept (%s)", file, problem)
            return None
        except sqlite3.DatabaseError as problem:
            _logger.warning("%s: is damaged and begun anew (%s)", file, problem)
            for damaged in self.folder.glob(f"{_FILE}*"):
                damaged.unlink(missing_ok=True)
        try:
            return _opened(file)
        except (sqlite3.Error, OSError) as problem:
            _logger.warning("%s: embeddings are neither found nor kept (%s)", file, problem)
            return None


def _opened(file: Path) -> sqlite3.Connection:
    connection = sqlite3.connect(file, timeout=5.0)
    try:
        connection.execute("PRAGMA journal_mode = WAL")
        connection.execute("PRAGMA synchronous = OFF")
        connection.execute(f"CREATE TABLE IF NOT EXISTS embeddings ({_COLUMNS})")
    except sqlite3.Error:
        connection.close()
        raise
    return connection
