"""What commands print: results on standard output, progress and complaints on standard error.

Names of files, classes, values and groups may come from a stranger. What they hold that a terminal
would obey (escape sequences, reversals of the reading direction) is shown and not passed on: by the
one console that everything is printed with, and by what is written beside it.
"""

from __future__ import annotations

import json
import re
import sys
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from typing import Any

from rich.console import Console, ConsoleOptions, RenderableType
from rich.progress import (
    BarColumn,
    MofNCompleteColumn,
    Progress,
    TextColumn,
    TimeElapsedColumn,
    TimeRemainingColumn,
)
from rich.segment import Segment
from rich.table import Table
from rich.text import Text

from seewhy.cli.plain_progress import telling_plainly
from seewhy.text.percentage import percent

_OBEYED = re.compile("[\x00-\x08\x0b-\x1f\x7f-\x9f\u2028\u2029\u202a-\u202e\u2066-\u2069]")
"""Control characters but tabs and line ends, and what embeds or overrides a reading direction."""


def harmless(text: str) -> str:
    """Return text in which what a terminal would obey is written out.

    Examples
    --------
    >>> print(harmless("a\x1b[2Jb\u202egnp"))
    a\\x1b[2Jb\\u202egnp
    """
    return _OBEYED.sub(lambda found: found[0].encode("unicode_escape").decode(), text)


class _Screen(Console):
    """A console that passes nothing on of what a text says to a terminal."""

    def render_str(self, text: str, **options: Any) -> Text:
        return super().render_str(harmless(text), **options)

    def render(
        self, renderable: RenderableType, options: ConsoleOptions | None = None
    ) -> Iterable[Segment]:
        for segment in super().render(renderable, options):
            if segment.control or _OBEYED.search(segment.text) is None:
                yield segment
            else:
                yield Segment(harmless(segment.text), segment.style)


def output() -> Console:
    """The console for results."""
    return _Screen(highlight=False, emoji=False, soft_wrap=not sys.stdout.isatty())


def notes() -> Console:
    """The console for progress and remarks."""
    return _Screen(stderr=True, highlight=False, emoji=False, soft_wrap=not sys.stderr.isatty())


def say(text: str = "") -> None:
    """Print a line of a result as it is, without markup."""
    output().print(text, markup=False)


def remark(text: str) -> None:
    """Print a line about what is going on."""
    notes().print(_one_line(text), markup=False, style="dim")


def warn(text: str) -> None:
    """Print a line that nobody should overlook: results do not mean what they seem to."""
    notes().print(_one_line(text), markup=False, style="bold yellow")


def complain(text: str) -> None:
    """Print the one sentence that says what is wrong."""
    notes().print(f"seewhy: {_one_line(text)}", markup=False, style="red")


def _one_line(text: str) -> str:
    """A name with a line end in it must not look like a remark of its own."""
    return " ".join(text.splitlines())


def print_json(value: Any, *, lines: bool = True) -> None:
    """Print a result for a program, over several lines or, for one that reads by lines, on one.

    The values are exact: what a terminal would obey is written as JSON escapes it.
    """
    text = json.dumps(value, indent=2 if lines else None, ensure_ascii=False)
    sys.stdout.write(_OBEYED.sub(lambda found: f"\\u{ord(found[0]):04x}", text) + "\n")
    sys.stdout.flush()


def share_of_cases(of: float | None) -> str:
    """Return a share as a percentage; where there is nothing that it could be of, that.

    Examples
    --------
    >>> share_of_cases(0.5), share_of_cases(None)
    ('50.0 %', 'no case')
    """
    return "no case" if of is None else percent(of)


def add_row(to: Table, *cells: str) -> None:
    """Add a row whose cells are shown as they are, without markup."""
    to.add_row(*(Text(harmless(cell)) for cell in cells))


def table(*columns: str, title: str | None = None) -> Table:
    """An empty table of plain looks; numbers belong in columns named with a leading '>'."""
    plain = Table(
        title=None if title is None else Text(harmless(title), style="table.title"),
        title_justify="left",
        box=None,
        pad_edge=False,
        header_style="bold",
    )
    for column in columns:
        plain.add_column(
            Text(harmless(column.lstrip(">"))),
            justify="right" if column.startswith(">") else "left",
        )
    return plain


@contextmanager
def progress() -> Iterator[Progress]:
    """A bar for long work, on standard error; where that is no terminal, a line now and then."""
    console = notes()
    with Progress(
        TextColumn("{task.description}"),
        BarColumn(),
        MofNCompleteColumn(),
        TimeElapsedColumn(),
        TimeRemainingColumn(),
        console=console,
        disable=not console.is_terminal,
        transient=True,
    ) as bars:
        if console.is_terminal:
            yield bars
        else:
            with telling_plainly(bars, remark):
                yield bars
