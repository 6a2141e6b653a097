"""JSON of any size, an item at a time, and checked against a schema."""

from __future__ import annotations

import codecs
import json
from collections.abc import Iterator
from typing import IO, Any, TypeVar

from pydantic import BaseModel, ValidationError

from seewhy.data.importers.source_files import DamagedFileError, SourceFiles

Schema = TypeVar("Schema", bound=BaseModel)

LARGEST_ITEM = 256 * 2**20
"""Characters of the largest single item, such as one annotation."""

_CHUNK = 2**20
_NEAR_THE_END = 16


def json_items(files: SourceFiles, name: str) -> Iterator[tuple[str, int, Any]]:
    """Yield the items of a JSON file one after the other; only one is in memory at a time.

    Yields
    ------
    key, position, item
        Of a list: "", and every element with its position. Of an object whose values are lists:
        the key, and every element with its position; other values as one item at position -1.

    Raises
    ------
    DamagedFileError
        If it is no JSON; the text names line and column.

    Examples
    --------
    >>> import pathlib, tempfile
    >>> from seewhy.data.importers.folder_files import FolderFiles
    >>> home = pathlib.Path(tempfile.mkdtemp())
    >>> _ = (home / "a.json").write_text('{"images": [{"id": 1}, {"id": 2}], "year": 2026}')
    >>> list(json_items(FolderFiles(home), "a.json"))
    [('images', 0, {'id': 1}), ('images', 1, {'id': 2}), ('year', -1, 2026)]
    """
    with files.open(name) as stream:
        text = _Text(stream, files.said(name))
        first = text.next_character()
        if first == "[":
            yield from (("", position, item) for position, item in text.elements())
        elif first == "{":
            yield from text.members()
        else:
            raise text.damaged("expecting '{' or '['", text.at)
        if text.next_character():
            raise text.damaged("something stands behind the end", text.at)


def json_outline(files: SourceFiles, name: str, *, most: int = 20) -> dict[str, Any]:
    """Return key → first item of the first keys of a JSON file; a list has the key "".

    What is no JSON has no keys. Not more than ``most`` items are read, so that keys behind a
    long list are not found.
    """
    outline: dict[str, Any] = {}
    try:
        for (key, _, item), _ in zip(json_items(files, name), range(most), strict=False):
            outline.setdefault(key, item)
    except DamagedFileError:
        pass
    return outline


def checked(schema: type[Schema], value: object, place: str) -> Schema:
    """Return a value as the schema has it.

    Raises
    ------
    DamagedFileError
        If it does not fit; the text names the place in the file and what was found there.

    Examples
    --------
    >>> class Size(BaseModel):
    ...     width: int
    >>> checked(Size, {"width": "wide"}, "a.json: images[3]")
    Traceback (most recent call last):
    ...
    seewhy.data.importers.source_files.DamagedFileError: a.json: images[3].width: input should be \
a valid integer, unable to parse string as an integer, got 'wide'; correct it or export it again
    """
    try:
        return schema.model_validate(value)
    except ValidationError as problem:
        what = _first(problem)
        what = what.removeprefix(".") if place.endswith(" ") else what
        raise DamagedFileError(f"{place}{what}; correct it or export it again") from None


def _first(problem: ValidationError) -> str:
    error = problem.errors(include_url=False)[0]
    where = "".join(f"[{part}]" if isinstance(part, int) else f".{part}" for part in error["loc"])
    if error["type"] == "missing":
        return f"{where} is missing"
    message = error["msg"].removeprefix("Value error, ")
    got = error["input"]
    shown = repr(got) if isinstance(got, str | int | float | bool) else type(got).__name__
    shown = f"{shown[:60]}…" if len(shown) > 60 else shown
    return f"{where}: {message[:1].lower()}{message[1:]}, got {shown}"


class _Text:
    """A cursor over JSON text that is read in pieces."""

    def __init__(self, stream: IO[bytes], said: str) -> None:
        self._stream = stream
        self._said = said
        self._decode = codecs.getincrementaldecoder("utf-8-sig")()
        self._json = json.JSONDecoder()
        self._ended = False
        self._line = 1
        self._column = 1
        self.buffer = ""
        self.at = 0

    def _more(self, size: int = _CHUNK) -> None:
        """Read on; what was passed already is let go of."""
        passed = self.buffer[: self.at]
        lines = passed.count("\n")
        self._line += lines
        self._column = len(passed) - passed.rfind("\n") if lines else self._column + len(passed)
        try:
            chunk = self._stream.read(size)
            text = self._decode.decode(chunk, final=not chunk)
        except UnicodeDecodeError:
            raise DamagedFileError(
                f"{self._said}: is not UTF-8 text; save or export it as UTF-8"
            ) from None
        self._ended = not chunk
        self.buffer = self.buffer[self.at :] + text
        self.at = 0

    def damaged(self, problem: str, position: int) -> DamagedFileError:
        """The error about what stands at a position of the buffer."""
        before = self.buffer[:position]
        lines = before.count("\n")
        column = len(before) - before.rfind("\n") if lines else self._column + len(before)
        return DamagedFileError(
            f"{self._said}:{self._line + lines}:{column}: is no valid JSON "
            f"({problem[:1].lower()}{problem[1:]}); export it again"
        )

    def next_character(self) -> str:
        """The next character that is no blank, which stays; empty at the end."""
        while True:
            while self.at < len(self.buffer) and self.buffer[self.at] in " \t\r\n":
                self.at += 1
            if self.at < len(self.buffer):
                return self.buffer[self.at]
            if self._ended:
                return ""
            self._more()

    def value(self) -> Any:
        """The value that begins here."""
        self.next_character()
        size = _CHUNK
        while True:
            try:
                value, end = self._json.raw_decode(self.buffer, self.at)
                # A number may go on behind what was read so far.
                if end < len(self.buffer) or self._ended:
                    self.at = end
                    return value
            except json.JSONDecodeError as problem:
                may_go_on = problem.pos >= len(self.buffer) - _NEAR_THE_END
                if self._ended or not (may_go_on or problem.msg.startswith("Unterminated")):
                    raise self.damaged(problem.msg, problem.pos) from None
            except RecursionError:
                raise self.damaged("it is nested too deeply", self.at) from None
            except ValueError as problem:
                raise self.damaged(str(problem).split(";")[0], self.at) from None
            if len(self.buffer) - self.at > LARGEST_ITEM:
                raise self.damaged("an item is too large", self.at)
            self._more(size)
            size *= 2

    def elements(self) -> Iterator[tuple[int, Any]]:
        """The elements of the list that begins here."""
        self.at += 1
        if self.next_character() == "]":
            self.at += 1
            return
        position = 0
        while True:
            yield position, self.value()
            position += 1
            following = self.next_character()
            if following not in (",", "]"):
                raise self.damaged("expecting ',' or ']'", self.at)
            self.at += 1
            if following == "]":
                return

    def members(self) -> Iterator[tuple[str, int, Any]]:
        """The items of the object that begins here."""
        self.at += 1
        if self.next_character() == "}":
            self.at += 1
            return
        while True:
            key = self.value() if self.next_character() == '"' else None
            if not isinstance(key, str):
                raise self.damaged("expecting a name between double quotes", self.at)
            if self.next_character() != ":":
                raise self.damaged("expecting ':'", self.at)
            self.at += 1
            if self.next_character() == "[":
                for position, item in self.elements():
                    yield key, position, item
            else:
                yield key, -1, self.value()
            following = self.next_character()
            if following not in (",", "}"):
                raise self.damaged("expecting ',' or '}'", self.at)
            self.at += 1
            if following == "}":
                return
