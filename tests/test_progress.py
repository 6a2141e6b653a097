"""Long work where there is no terminal: it is told in lines, and in a file for another process."""

from __future__ import annotations

import re
from pathlib import Path
from threading import Event

import pytest
from rich.progress import Progress

from seewhy.cli.plain_progress import telling_plainly
from seewhy.cli.screen import progress
from seewhy.files.progress_file import PROGRESS_FILE, read_progress


def test_without_a_terminal_long_work_is_told_in_lines_and_in_the_file(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    file, told, enough = tmp_path / "progress.json", [], Event()
    monkeypatch.setenv(PROGRESS_FILE, str(file))

    def tell(line: str) -> None:
        told.append(line)
        enough.set()

    with Progress(disable=True) as bars:
        bars.add_task("not begun", total=None)
        task = bars.add_task("looking at pictures", total=900)
        with telling_plainly(bars, tell, seconds=0.05):
            bars.update(task, completed=120)
            assert enough.wait(20)
    assert re.fullmatch(
        r"looking at pictures: \d+ of 900(, \d:\d\d:\d\d left)? \(since \d:\d\d:\d\d\)", told[-1]
    )
    found = read_progress(file)
    assert found is not None
    assert [(stage.what, stage.total) for stage in found.stages] == [("looking at pictures", 900)]


def test_short_work_says_nothing_without_a_terminal(capsys: pytest.CaptureFixture[str]) -> None:
    with progress() as bars:
        bars.update(bars.add_task("looking", total=2), completed=1)
    assert capsys.readouterr() == ("", "")
