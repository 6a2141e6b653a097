"""What the site has beside the pages of this folder: the commands, and files of the repository.

A page may link to a file of the repository (``../results/…``), so that the link works where the
page is read there. The site takes such a file along, under ``repository/``, and links to that.
"""

from __future__ import annotations

import posixpath
import re
import subprocess
import sys
from collections.abc import Iterable
from html import unescape
from pathlib import Path
from typing import Any

from mkdocs.structure.files import File, Files

TAKEN = "repository"
"""The folder of the site for files that lie outside of docs/."""
COMPARISON = "results/comparison/report.md"
SECURITY = "SECURITY.md"
_ABOVE_COMMANDS = """\
# Commands

    seewhy --help

Every command says the same with `--help`. With `--json` it prints its result for a program. Wrong
input ends with one sentence and exit code 2.
"""
_LINK = re.compile(r"(?<=\]\()([^)#\s]*\.\./[^)#\s]+)")


def on_files(files: Files, *, config: Any) -> Files:
    """Add the page of the commands and what pages link to outside of docs/."""
    root = Path(config.config_file_path).parent
    linked = {COMPARISON, SECURITY}
    for file in files.documentation_pages():
        linked.update(path for _, path in _outside(file.src_uri, file.content_string))
    for path in sorted(linked):
        if (root / path).is_file():
            files.append(File.generated(config, f"{TAKEN}/{path}", abs_src_path=str(root / path)))
    files.append(File.generated(config, "commands.md", content=_commands(root)))
    return files


def on_page_markdown(markdown: str, *, page: Any, files: Files, **_: Any) -> str:
    """Let links that lead out of docs/ lead to what was taken along; mkdocs refuses the others."""
    folder = posixpath.dirname(page.file.src_uri)
    for link, path in _outside(page.file.src_uri, markdown):
        target = f"{TAKEN}/{path}"
        if files.get_file_from_path(target) is not None:
            markdown = markdown.replace(
                f"]({link}", f"]({posixpath.relpath(target, folder or '.')}"
            )
    return markdown


def _outside(page: str, markdown: str) -> Iterable[tuple[str, str]]:
    """The links of a page that lead out of docs/, each with its path in the repository."""
    for link in sorted(set(_LINK.findall(markdown)), key=len, reverse=True):
        path = posixpath.normpath(posixpath.join("docs", posixpath.dirname(page), link))
        if not path.startswith(("docs/", "..")):
            yield link, path


def _commands(root: Path) -> str:
    """Every command with its arguments and options, as Typer tells them."""
    told = subprocess.run(
        [sys.executable, "-m", "typer", "seewhy.cli.main", "utils", "docs", "--name", "seewhy"],
        cwd=root,
        check=True,
        capture_output=True,
        text=True,
    ).stdout
    # What stands above the first command lists them all with their sentences cut short.
    _, heading, commands = unescape(told).partition("\n## ")
    return f"{_ABOVE_COMMANDS}{heading}{commands}"
