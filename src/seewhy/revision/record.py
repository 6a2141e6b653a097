"""The record of revisions: which were taken, what they wrote, and which were taken back."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Literal, Protocol

from pydantic import Field, TypeAdapter, ValidationError

from seewhy.domain.folder import REVISIONS
from seewhy.errors import RevisionError
from seewhy.files.json_file import Strict
from seewhy.files.whole_files import write_whole
from seewhy.revision.edit import Edit, FileName
from seewhy.revision.proposal import Cause

__all__ = [
    "Counted",
    "Line",
    "Record",
    "RecordFile",
    "Revision",
    "Taken",
    "TakenBack",
    "revisions_of",
]

LARGEST = 16 << 20
"""Bytes that a record may have: some ten thousand revisions."""

_Text = Annotated[str, Field(max_length=100_000)]
_Short = Annotated[str, Field(max_length=10_000)]
_Number = Annotated[int, Field(ge=1, le=1_000_000)]
_Time = Annotated[str, Field(pattern=r"^\d{4}-\d\d-\d\dT\d\d:\d\d:\d\d\+00:00$")]
_Digest = Annotated[str, Field(pattern=r"^[0-9a-f]{1,128}$")]


class EditLine(Strict):
    """The fields of :class:`seewhy.revision.edit.Edit`."""

    file: FileName
    at: Annotated[int, Field(ge=0, le=1 << 31)]
    before: _Text
    after: _Text


class SceneLine(Strict):
    """An annotated scene: its features, and its class."""

    features: tuple[str | None, ...]
    label: str


class Counted(Strict):
    """What an agent is told by a label: the scene that it remembers instead of another.

    ``picture`` is the digest of the picture where it was not remembered before.
    """

    less: SceneLine | None = None
    more: SceneLine | None = None
    picture: _Digest | None = None


class Taken(Strict):
    """A revision that was taken."""

    what: Literal["taken"] = "taken"
    number: _Number
    at: _Time
    cause: Annotated[Cause, Field(strict=False)]
    sentence: _Short
    statement: _Short = ""
    about: _Short = ""
    picture: _Short = ""
    edits: Annotated[tuple[EditLine, ...], Field(max_length=1_000)]
    counted: Counted | None = None

    @property
    def changes(self) -> tuple[Edit, ...]:
        """What it wrote, in the order in which it was written."""
        return tuple(Edit(edit.file, edit.at, edit.before, edit.after) for edit in self.edits)


class TakenBack(Strict):
    """That a revision was taken back."""

    what: Literal["taken back"] = "taken back"
    number: _Number
    at: _Time


Line = Annotated[Taken | TakenBack, Field(discriminator="what")]
_LINE: TypeAdapter[Taken | TakenBack] = TypeAdapter(Line)


class Record(Protocol):
    """Where revisions are recorded: nothing is ever changed in it, lines are only added."""

    def lines(self) -> Sequence[Taken | TakenBack]:
        """Return all lines, the oldest first."""
        ...

    def append(self, line: Taken | TakenBack) -> None:
        """Add a line, so that it is on the disk when this returns."""
        ...


@dataclass(frozen=True)
class Revision:
    """A revision, and when it was taken back, if it was."""

    taken: Taken
    taken_back: str | None = None

    @property
    def number(self) -> int:
        """Its number; the first is 1."""
        return self.taken.number


def revisions_of(lines: Sequence[Taken | TakenBack]) -> tuple[Revision, ...]:
    """Return the revisions of a record in the order of their numbers.

    Examples
    --------
    >>> now = "2026-01-01T00:00:00+00:00"
    >>> taken = Taken(number=1, at=now, cause=Cause.MISSING, sentence="what leans falls", edits=())
    >>> [revision.taken_back for revision in revisions_of([taken, TakenBack(number=1, at=now)])]
    ['2026-01-01T00:00:00+00:00']
    """
    back = {line.number: line.at for line in lines if isinstance(line, TakenBack)}
    return tuple(Revision(line, back.get(line.number)) for line in lines if isinstance(line, Taken))


@dataclass(frozen=True)
class RecordFile:
    """A record as a file, a JSON object a line.

    Examples
    --------
    >>> import tempfile
    >>> record = RecordFile(Path(tempfile.mkdtemp()) / "revisions.jsonl")
    >>> record.append(TakenBack(number=1, at="2026-01-01T00:00:00+00:00"))
    >>> record.lines()
    (TakenBack(what='taken back', number=1, at='2026-01-01T00:00:00+00:00'),)
    """

    path: Path

    @staticmethod
    def beside(folder: Path) -> RecordFile:
        """The record that lies beside knowledge.al in a folder."""
        return RecordFile(folder / REVISIONS)

    def lines(self) -> tuple[Taken | TakenBack, ...]:
        """Return all lines, the oldest first; without a file there is none.

        Raises
        ------
        RevisionError
            If the file is too large, or a line is not as it is written.
        """
        found = []
        for number, text in enumerate(filter(None, self._text().split("\n")), start=1):
            try:
                found.append(_LINE.validate_json(text))
            except ValidationError as problem:
                first = problem.errors(include_url=False, include_input=False)[0]
                where = ".".join(map(str, first["loc"][1:])) or "its text"
                raise RevisionError(
                    f"{self.path}:{number}: is damaged ({where[:80]}: {first['msg']}); put the "
                    "file of before back, or take it away: the knowledge stays as it is, and what "
                    "was revised is taken back no more"
                ) from None
        numbers = [line.number for line in found if isinstance(line, Taken)]
        if numbers != list(range(1, len(numbers) + 1)):
            raise RevisionError(
                f"{self.path}: is damaged (its revisions are not numbered one after the other); "
                "put the file of before back, or take it away"
            )
        return tuple(found)

    def append(self, line: Taken | TakenBack) -> None:
        """Add a line; the file is written whole."""
        write_whole(self.path, self.text_with(line))

    def text_with(self, line: Taken | TakenBack) -> str:
        """Return the text of the file with one more line."""
        return f"{self._text()}{line.model_dump_json()}\n"

    def _text(self) -> str:
        try:
            with self.path.open("rb") as stream:
                content = stream.read(LARGEST + 1)
        except FileNotFoundError:
            return ""
        if len(content) > LARGEST:
            raise RevisionError(
                f"{self.path} has more than {LARGEST >> 20} MiB, which no record has; take it away"
            )
        try:
            return content.decode("utf-8")
        except UnicodeDecodeError:
            raise RevisionError(
                f"{self.path}: is damaged (no UTF-8); put the file of before back, or take it away"
            ) from None
