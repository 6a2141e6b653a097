"""An edit of a text file: one passage in the place of another, all else as it stands."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Literal

from seewhy.errors import RevisionError

__all__ = [
    "KNOWLEDGE",
    "LEARNED",
    "TABLE",
    "Edit",
    "FileName",
    "edited",
    "newline_of",
    "raw_places",
]

FileName = Literal["knowledge.al", "learned.al", "scenes.csv"]
"""The files that a revision may change."""

KNOWLEDGE: FileName = "knowledge.al"
LEARNED: FileName = "learned.al"
TABLE: FileName = "scenes.csv"


@dataclass(frozen=True)
class Edit:
    """A passage of a file that becomes another.

    Attributes
    ----------
    file : str
    at : int
        Where the passage stood when the edit was made, counted in characters.
    before, after : str

    Examples
    --------
    >>> edit = Edit("knowledge.al", 5, "b.", "b, c.")
    >>> edit.applied("a if b. d."), edit.undone.applied("% new\\na if b, c. d.")
    ('a if b, c. d.', '% new\\na if b. d.')
    """

    file: FileName
    at: int
    before: str
    after: str

    @property
    def undone(self) -> Edit:
        """The edit that takes this one back."""
        return Edit(self.file, self.at, self.after, self.before)

    def stands_in(self, text: str) -> bool:
        """Whether what the edit wrote stands in a text."""
        return not self.after or self.after in text

    def applied(self, text: str) -> str:
        """Return a text with the edit made; where the passage has moved, the nearest is meant.

        Raises
        ------
        RevisionError
            If the passage does not stand in the text.
        """
        if not self.before:
            at = _between_blocks(self.at, text)
        elif text.startswith(self.before, self.at):
            at = self.at
        else:
            at = _nearest(self, text)
        return f"{text[:at]}{self.after}{text[at + len(self.before) :]}"


def edited(texts: Mapping[FileName, str], edits: Iterable[Edit]) -> dict[FileName, str]:
    """Return the texts of files with edits made, one after the other.

    Examples
    --------
    >>> edited({"knowledge.al": "a."}, [Edit("knowledge.al", 2, "", " b.")])
    {'knowledge.al': 'a. b.'}
    """
    found = dict(texts)
    for edit in edits:
        found[edit.file] = edit.applied(found.get(edit.file, ""))
    return found


def newline_of(text: str) -> str:
    r"""Return how the lines of a text end.

    Examples
    --------
    >>> newline_of("a\r\nb\r\n"), newline_of("")
    ('\r\n', '\n')
    """
    return "\r\n" if "\r\n" in text else "\r" if "\r" in text and "\n" not in text else "\n"


def raw_places(text: str) -> list[int]:
    r"""Return where each character of a text stands that is read without its mark and its CRs.

    Examples
    --------
    >>> raw_places("\ufeffa\r\nb")
    [1, 2, 4, 5]
    """
    places: list[int] = []
    at = int(text.startswith("\ufeff"))
    while at < len(text):
        places.append(at)
        at += 2 if text.startswith("\r\n", at) else 1
    return [*places, len(text)]


def _between_blocks(at: int, text: str) -> int:
    """Where something may be put in at a place or behind it: after an empty line, or at the end."""
    if at == 0 or text[:at].endswith(("\n\n", "\r\n\r\n")):
        return at
    following = text.find("\n\n", at)
    return len(text) if at >= len(text) or following < 0 else following + 2


def _nearest(edit: Edit, text: str) -> int:
    """Where the passage stands that is nearest to where it stood."""
    places = []
    at = text.find(edit.before)
    while at >= 0:
        places.append(at)
        at = text.find(edit.before, at + 1)
    if not places:
        shown = " ".join(edit.before.split())
        raise RevisionError(
            f"{edit.file} has changed: '{shown[:80]}' does not stand there any more"
        )
    return min(places, key=lambda place: abs(place - edit.at))
