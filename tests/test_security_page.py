"""SECURITY.md names the tests of what it promises; they exist, and so do the commands."""

from __future__ import annotations

import re
from pathlib import Path

ROOT = Path(__file__).parents[1]
TEXT = (ROOT / "SECURITY.md").read_text(encoding="utf-8")


def test_the_tests_that_it_names_exist() -> None:
    named = re.findall(r"`(tests/[\w/.]+\.py)(?:::(\w+))?`", TEXT)
    assert len(named) > 10
    for file, test in named:
        assert (ROOT / file).is_file(), file
        if test:
            assert f"def {test}(" in (ROOT / file).read_text(encoding="utf-8"), (file, test)


def test_every_row_names_a_test() -> None:
    sections = re.split(r"^## ", TEXT, flags=re.MULTILINE)
    for title in ("Pictures", "Tables and archives", "Domains", "Models", "Reasoning"):
        (section,) = (found for found in sections if found.startswith(f"{title}\n"))
        rows = [line for line in section.splitlines() if line.startswith("| ")][1:]
        assert rows, title
        for row in rows:
            assert "`tests/" in row, row


def test_the_command_of_the_long_run() -> None:
    (command,) = re.findall(r"^    python (\S+) --minutes 60$", TEXT, flags=re.MULTILINE)
    assert (ROOT / command).is_file()
