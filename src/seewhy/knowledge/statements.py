"""Cut a knowledge file into statements, each with its place and the sentence above it."""

from __future__ import annotations

import re
import sys
from collections.abc import Iterator
from dataclasses import dataclass

from seewhy.errors import KnowledgeError
from seewhy.knowledge.signature import Location

LARGEST = 2**31 - 1
"""The largest number that there is, as clingo counts; the least is its opposite."""

_BLANK_LINE = re.compile(r"[^\S\n]*(?:\n|$)")
_NUMBER = re.compile(r"0[xX][0-9a-fA-F]+|0[oO][0-7]+|0[bB][01]+|[0-9]+")
_DIRECTIVE = re.compile(r"#[A-Za-z_]\w*")
_FUNCTIONS = ("#count", "#sum", "#min", "#max", "#true", "#false", "#inf", "#sup")
"""What may begin with # inside of a statement; all else is clingo's own, and reads files."""


class NumberError(KnowledgeError):
    """A number is larger than numbers can be."""


@dataclass(frozen=True)
class Statement:
    """The text of one statement without its final full stop; comments are blanked out.

    ``sentence`` joins the ``%%`` lines directly above the statement. ``begins`` and ``stops`` are
    the places of the first of these lines, or else of the statement, and of its full stop in the
    source, whose line ends count as one character; ``said`` is where the last line ends.
    """

    text: str
    sentence: str
    location: Location
    begins: int
    said: int
    stops: int

    @property
    def line(self) -> str:
        """The statement on one line, as errors quote it."""
        return one_line(self.text) + "."

    def place(self, line: int, column: int) -> Location:
        """Return the place of a line and column of clingo, whose columns count bytes.

        What clingo finds missing behind the statement is placed at its full stop.
        """
        lines = self.text.split("\n")
        number = line - self.location.line
        if number >= len(lines):
            number, column = len(lines) - 1, sys.maxsize
        before = self.location.column - 1 if number == 0 else 0
        inside = lines[number].encode()[: column - 1 - before]
        return Location(
            file=self.location.file,
            line=self.location.line + number,
            column=before + len(inside.decode(errors="ignore")) + 1,
        )


def one_line(text: str) -> str:
    """Return a text without line breaks, as an error shows it."""
    return " ".join(text.split())


def statements(source: str, *, file: str) -> Iterator[Statement]:
    """Yield the statements of a knowledge file in order.

    Raises
    ------
    KnowledgeError
        Where a string, a block comment or the last statement does not end, and where a character
        stands outside strings and comments that no name can have.

    Examples
    --------
    >>> [s.text for s in statements("#sort num = 1..5. % five\\n p(1).", file="k.al")]
    ['#sort num = 1..5', 'p(1)']
    """
    scan = _Scan(source, file)
    while (statement := scan.next_statement()) is not None:
        yield statement


class _Scan:
    """A cursor over the source; one pass, character by character."""

    def __init__(self, source: str, file: str) -> None:
        self.source = source.removeprefix("\ufeff").replace("\r\n", "\n").replace("\r", "\n")
        self.file = file
        self.at = 0
        self.line = 1
        self.column = 1

    def here(self) -> Location:
        return Location(file=self.file, line=self.line, column=self.column)

    def take(self, count: int = 1) -> str:
        taken = self.source[self.at : self.at + count]
        for character in taken:
            if character == "\n":
                self.line += 1
                self.column = 1
            else:
                self.column += 1
        self.at += count
        return taken

    def looking_at(self, text: str) -> bool:
        return self.source.startswith(text, self.at)

    def next_statement(self) -> Statement | None:
        sentences: list[str] = []
        text: list[str] = []
        start: Location | None = None
        began = said = self.at
        while self.at < len(self.source):
            here = self.here()
            if start is None and not sentences:
                began = self.at
            if self.looking_at("%*"):
                text.append(_blank(self.block_comment(here)))
            elif self.looking_at("%"):
                comment = self.rest_of_line()
                if start is None and comment.startswith("%%"):
                    sentences.append(comment.lstrip("%").strip())
                    said = self.at
                text.append(_blank(comment))
            elif self.looking_at('"'):
                start = start or here
                text.append(self.quoted(here))
            elif self.looking_at(".."):
                text.append(self.take(2))
            elif self.looking_at("."):
                if start is None:
                    raise KnowledgeError(
                        f"{here}: found a full stop with no statement before it; remove it"
                    )
                self.take()
                return Statement(
                    text="".join(text).lstrip(),
                    sentence=" ".join(sentences),
                    location=start,
                    begins=began,
                    said=said,
                    stops=self.at - 1,
                )
            elif number := self.number():
                _refuse_large(number, here)
                start = start or here
                text.append(self.take(len(number)))
            else:
                if start is not None:
                    self.refuse_directive(here)
                character = self.take()
                if character.isspace():
                    if (
                        start is None
                        and character == "\n"
                        and _BLANK_LINE.match(self.source, self.at)
                    ):
                        # A blank line parts a heading comment from the statement below it.
                        sentences.clear()
                    text.append(character if character in "\t\n" else " ")
                    continue
                _refuse_character(character, here)
                start = start or here
                text.append(character)
        if start is not None:
            raise KnowledgeError(
                f"{start}: the statement that begins here does not end; add a full stop after it"
            )
        return None

    def number(self) -> str | None:
        """The number that stands here; what goes on a name is none."""
        before = self.source[self.at - 1] if self.at else " "
        found = _NUMBER.match(self.source, self.at)
        if found is None or before.isalnum() or before in "_'":
            return None
        return found.group()

    def refuse_directive(self, here: Location) -> None:
        """Refuse what clingo would take for orders to itself."""
        if found := _DIRECTIVE.match(self.source, self.at):
            word = found.group()
            if word not in _FUNCTIONS:
                raise KnowledgeError(
                    f"{here}: '{word}' cannot stand inside of a statement; remove it, or end the "
                    "statement before it with a full stop"
                )
        elif self.looking_at("@"):
            raise KnowledgeError(f"{here}: found '@'; knowledge runs no functions, remove it")

    def rest_of_line(self) -> str:
        end = self.source.find("\n", self.at)
        return self.take((len(self.source) if end < 0 else end) - self.at)

    def block_comment(self, start: Location) -> str:
        end = self.source.find("*%", self.at + 2)
        if end < 0:
            raise KnowledgeError(f"{start}: the comment that begins here has no end; close it: *%")
        return self.take(end + 2 - self.at)

    def quoted(self, start: Location) -> str:
        at = self.at + 1
        while at < len(self.source) and self.source[at] not in '"\n':
            at += 2 if self.source[at] == "\\" else 1
        if at >= len(self.source) or self.source[at] == "\n":
            raise KnowledgeError(
                f'{start}: the text that begins here has no end; close it with a "'
            )
        if "\0" in self.source[self.at : at]:
            raise KnowledgeError(f"{start}: the text that begins here holds U+0000; remove it")
        return self.take(at + 1 - self.at)


def _refuse_large(number: str, here: Location) -> None:
    """Refuse a number that clingo would read as another one."""
    # Longer ones need not be read, which takes long for thousands of digits.
    plain = number.isdecimal()
    if (len(number) > 40 and number.strip("0")) or int(number, 10 if plain else 0) > LARGEST:
        shown = number if len(number) <= 40 else f"{number[:20]}…"
        raise NumberError(
            f"{here}: the number {shown} is too large; numbers go from -{LARGEST} to {LARGEST}"
        )


def _refuse_character(character: str, here: Location) -> None:
    """Refuse what clingo's lexer has no word for."""
    if not (character.isascii() and character.isprintable()):
        shown = f"'{character}'" if character.isprintable() else f"U+{ord(character):04X}"
        raise KnowledgeError(
            f"{here}: found the character {shown}; write names with the letters a to z, digits "
            'and _, and any other text between " and "'
        )


def _blank(text: str) -> str:
    return "".join(c if c == "\n" else " " for c in text)
