"""What commands print: results on standard output, progress and complaints on standard error."""

from __future__ import annotations

import json
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from rich.console import Console
from rich.progress import (
    BarColumn,
    MofNCompleteColumn,
    Progress,
    TextColumn,
    TimeElapsedColumn,
    TimeRemainingColumn,
)
from rich.table import Table
from rich.text import Text


def output() -> Console:
    """The console for results."""
    return Console(highlight=False, emoji=False, soft_wrap=not sys.stdout.isatty())


def notes() -> Console:
    """The console for progress and remarks."""
    return Console(stderr=True, highlight=False, emoji=False, soft_wrap=not sys.stderr.isatty())


def say(text: str = "") -> None:
    """Print a line of a result as it is, without markup."""
    output().print(text, markup=False)


def remark(text: str) -> None:
    """Print a line about what is going on."""
    notes().print(text, markup=False, style="dim")


def warn(text: str) -> None:
    """Print a line that nobody should overlook: results do not mean what they seem to."""
    notes().print(text, markup=False, style="bold yellow")


def complain(text: str) -> None:
    """Print the one sentence that says what is wrong."""
    notes().print(f"seewhy: {' '.join(text.splitlines())}", markup=False, style="red")


def print_json(value: Any, *, lines: bool = True) -> None:
    """Print a result for a program, over several lines or, for one that reads by lines, on one."""
    sys.stdout.write(json.dumps(value, indent=2 if lines else None, ensure_ascii=False) + "\n")
    sys.stdout.flush()


def percent(share: float) -> str:
    """Return a share as a percentage with one decimal.

    Examples
    --------
    >>> percent(0.9312)
    '93.1 %'
    """
    return f"{100 * share:.1f} %"


def add_row(to: Table, *cells: str) -> None:
    """Add a row whose cells are shown as they are, without markup."""
    to.add_row(*(Text(cell) for cell in cells))


def table(*columns: str, title: str | None = None) -> Table:
    """An empty table of plain looks; numbers belong in columns named with a leading '>'."""
    own = Table(title=title, title_justify="left", box=None, pad_edge=False, header_style="bold")
    for column in columns:
        own.add_column(column.lstrip(">"), justify="right" if column.startswith(">") else "left")
    return own


@contextmanager
def progress() -> Iterator[Progress]:
    """A bar for long work, on standard error; silent where that is no terminal."""
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
        yield bars
