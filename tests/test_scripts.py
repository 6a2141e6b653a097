"""Modules that are run as programs."""

from __future__ import annotations

import ast
from pathlib import Path

import pytest

SOURCE = Path(__file__).resolve().parents[1] / "src"
RUN = [file for file in sorted(SOURCE.rglob("*.py")) if "__main__" in file.read_text("utf-8")]


@pytest.mark.parametrize("file", RUN, ids=lambda file: file.stem)
def test_nothing_is_defined_behind_what_runs_a_module(file: Path) -> None:
    body = ast.parse(file.read_text("utf-8")).body
    starts = [
        place
        for place, statement in enumerate(body)
        if isinstance(statement, ast.If) and ast.unparse(statement.test).startswith("__name__ ==")
    ]
    assert starts in ([], [len(body) - 1])
