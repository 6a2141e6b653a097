"""Long work where there is no terminal: it is told in lines, and in a file for another process."""

from __future__ import annotations

import re
from pathlib import Path
from threading import Event
from time import monotonic, sleep

import pytest
from rich.progress import Progress

from seewhy.cli.plain_progress import SECONDS_NAMED, telling_plainly
from seewhy.cli.screen import progress
from seewhy.files.progress_file import PROGRESS_FILE, read_progress


def test_without_a_terminal_long_work_is_told_in_lines() -> None:
    told: list[str] = []
    enough = Event()

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


@pytest.mark.parametrize(
    ("named", "lines"), [("0.05", True), ("3600", False), ("soon", False), ("-1", False)]
)
def test_the_environment_says_how_often(
    monkeypatch: pytest.MonkeyPatch, named: str, lines: bool
) -> None:
    monkeypatch.setenv(SECONDS_NAMED, named)
    told = Event()
    with Progress(disable=True) as bars:
        bars.update(bars.add_task("looking at pictures", total=900), completed=120)
        with telling_plainly(bars, lambda _: told.set()):
            assert told.wait(20.0 if lines else 1.5) is lines


def test_another_process_reads_of_it_in_the_file_that_is_named(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    file, told = tmp_path / "progress.json", list[str]()
    monkeypatch.setenv(PROGRESS_FILE, str(file))
    with Progress(disable=True) as bars:
        task = bars.add_task("looking at pictures", total=900)
        with telling_plainly(bars, told.append, seconds=0.05):
            bars.update(task, completed=120)
            end = monotonic() + 20
            while (found := read_progress(file)) is None:
                assert monotonic() < end
                sleep(0.01)
    assert [(stage.what, stage.total) for stage in found.stages] == [("looking at pictures", 900)]
    assert told == []


def test_short_work_says_nothing_without_a_terminal(capsys: pytest.CaptureFixture[str]) -> None:
    with progress() as bars:
        bars.update(bars.add_task("looking", total=2), completed=1)
    assert capsys.readouterr() == ("", "")
