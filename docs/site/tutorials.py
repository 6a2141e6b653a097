"""A tutorial as it stands on its page: write its files, run its commands, compare what is printed.

On a page, a fence with a title is a file, one of ``sh`` holds commands, and one of ``text`` behind
it is what they print (with the title ``for instance``: what they may print). Pictures of the
page that the commands make are put beside it.

    python docs/site/tutorials.py docs/start/your_own_rules.md --folder runs/tutorials/rules
"""

from __future__ import annotations

import argparse
import os
import re
import shlex
import subprocess
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

__all__ = ["Commands", "Tutorial", "WrittenFile", "read_tutorial", "run_tutorial"]

_FENCE = re.compile(r"^```(\w+)(?: title=\"([^\"]+)\")?\n(.*?)^```$", re.MULTILINE | re.DOTALL)
_PICTURE = re.compile(r"!\[[^\]]*\]\(([^)]+)\)")
_INSTANCE = "for instance"
_SVG = re.compile(r"<svg.*?</svg>", re.DOTALL)


@dataclass(frozen=True)
class WrittenFile:
    """A file that the page shows."""

    path: str
    text: str


@dataclass(frozen=True)
class Commands:
    """Commands, and what the page says that they print; None where it says nothing exact."""

    lines: tuple[str, ...]
    prints: str | None


@dataclass(frozen=True)
class Tutorial:
    """A page in the order of its fences, with the pictures that it shows."""

    page: Path
    parts: tuple[WrittenFile | Commands, ...]
    pictures: tuple[Path, ...]


def read_tutorial(page: Path) -> Tutorial:
    """Read what a page has one write and run."""
    text = page.read_text(encoding="utf-8")
    pictures = tuple((page.parent / link).resolve() for link in _PICTURE.findall(text))
    return Tutorial(page, tuple(_parts(text)), pictures)


def _parts(text: str) -> Iterator[WrittenFile | Commands]:
    fences = [match.groups() for match in _FENCE.finditer(text)]
    for (kind, title, body), (next_kind, next_title, next_body) in zip(
        fences, [*fences[1:], ("", None, "")], strict=True
    ):
        if kind == "sh":
            exact = next_kind == "text" and next_title != _INSTANCE
            yield Commands(_commands(body), next_body if exact else None)
        elif title is not None and title != _INSTANCE:
            yield WrittenFile(title, body)


def _commands(body: str) -> tuple[str, ...]:
    """One command a line; a line that ends with a backslash goes on."""
    return tuple(line for line in body.replace("\\\n", " ").splitlines() if line.strip())


def run_tutorial(tutorial: Tutorial, folder: Path, *, until: str | None = None) -> Iterator[str]:
    """Write and run everything in a folder; yield each difference to the page, in words.

    ``until`` names the beginning of the first command that is not run any more.
    """
    for part in tutorial.parts:
        if isinstance(part, WrittenFile):
            path = folder / part.path
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(part.text, encoding="utf-8")
            continue
        printed = ""
        for line in part.lines:
            if until is not None and line.startswith(until):
                return
            printed += _run(line, folder)
        if part.prints is not None and printed.split() != part.prints.split():
            yield f"{tutorial.page}: {part.lines[-1]}\nsays\n{part.prints}\nand printed\n{printed}"


def _run(line: str, folder: Path) -> str:
    """What a command prints, errors included."""
    words = shlex.split(line)
    programs = {"seewhy": ["-m", "seewhy.cli.main"], "python": []}
    if words[0] not in programs:
        sys.exit(f"'{line}' is neither seewhy nor python")
    return subprocess.run(
        [sys.executable, *programs[words[0]], *words[1:]],
        cwd=folder,
        env={**os.environ, "COLUMNS": "100"},
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        check=False,
    ).stdout


def keep_pictures(tutorial: Tutorial, folder: Path) -> Iterator[Path]:
    """Put the pictures that were made where the page shows them; of an HTML page, its first."""
    for picture in tutorial.pictures:
        made, page = folder / picture.name, folder / f"{picture.stem}.html"
        if made.is_file():
            content = made.read_bytes()
        elif page.is_file() and (drawn := _SVG.search(page.read_text(encoding="utf-8"))):
            content = drawn.group().encode()
        else:
            continue
        picture.parent.mkdir(parents=True, exist_ok=True)
        picture.write_bytes(content)
        yield picture


def main() -> None:
    """Run the pages that are named, and say what is otherwise."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("pages", nargs="+", type=Path)
    parser.add_argument("--folder", type=Path, default=Path("runs/tutorials"))
    asked = parser.parse_args()
    differences = 0
    for page in asked.pages:
        tutorial = read_tutorial(page)
        folder = (asked.folder / page.stem).resolve()
        folder.mkdir(parents=True, exist_ok=True)
        for difference in run_tutorial(tutorial, folder):
            differences += 1
            print(difference)
        for picture in keep_pictures(tutorial, folder):
            print(f"made: {picture}")
    sys.exit(1 if differences else 0)


if __name__ == "__main__":
    main()
