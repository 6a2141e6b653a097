"""The studio's record and the files that are written from it, whenever a process is killed."""

from __future__ import annotations

import os
import signal
import sqlite3
import subprocess
import sys
from pathlib import Path

import pytest

from seewhy.data.dataset import Dataset
from seewhy.domain.domain import load_domain
from seewhy.errors import SeeWhyError
from seewhy.studio.project import Project
from seewhy.studio.record import Record
from seewhy.studio.text_edits import edits_between
from studio_builder import FRUIT, pictures, with_domain


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    return with_domain(pictures(tmp_path / "fruit"), FRUIT)


def test_nothing_in_the_record_is_changed(tmp_path: Path) -> None:
    record = Record(tmp_path / "studio.sqlite")
    record.add("label", {"values": {}}, who="Ada")
    with sqlite3.connect(tmp_path / "studio.sqlite") as connection:
        for order in ("UPDATE entries SET who = 'Eve'", "DELETE FROM entries"):
            with pytest.raises(sqlite3.DatabaseError, match="only added to"):
                connection.execute(order)


def test_undoing_undone(tmp_path: Path) -> None:
    record = Record(tmp_path / "studio.sqlite")
    first = record.add("a", {}, who="Ada")
    undo = record.take_back(first.number, who="Ada")
    again = record.take_back(undo.number, who="Ada")
    assert [entry.number for entry in record.holding()] == [first.number]
    record.take_back(again.number, who="Ada")
    assert record.holding() == ()
    with pytest.raises(SeeWhyError, match="does not hold"):
        record.take_back(first.number, who="Ada")
    with pytest.raises(SeeWhyError, match="does not hold"):
        record.take_back(99, who="Ada")


def test_two_records_of_one_file_see_each_other(tmp_path: Path) -> None:
    one, other = Record(tmp_path / "studio.sqlite"), Record(tmp_path / "studio.sqlite")
    one.add("a", {}, who="Ada")
    other.add("b", {}, who="Ben")
    assert [e.kind for e in one.holding()] == [e.kind for e in other.holding()] == ["a", "b"]


def test_what_is_no_record(tmp_path: Path) -> None:
    (tmp_path / "studio.sqlite").write_bytes(b"no database, and long enough to be read as such" * 9)
    with pytest.raises(SeeWhyError, match="move it away"):
        Record(tmp_path / "studio.sqlite")


def test_a_table_changed_by_another_program_is_taken_in(folder: Path) -> None:
    project = Project(folder)
    project.label({"a.png": {"colour": "red", "class": "good"}}, who="Ada")
    table = folder / "scenes.csv"
    table.write_text(
        table.read_text().replace("a.png,,good,red", "a.png,,spoilt,red")
        + "b.png,test,good,green,no,g1,\n"
    )
    again = Project(folder)
    labels = again.labels()
    assert labels.values("a.png") == {"colour": "red", "class": "spoilt"}
    assert labels.of["a.png"]["class"].how == "table"
    assert labels.of["a.png"]["colour"].who == "Ada"
    assert labels.rows["b.png"] == {"split": "test", "group": "g1"}
    again.label({"a.png": {"round": "yes"}}, who="Ada")
    assert "b.png,test,good,green,no,g1," in table.read_text()


def test_a_file_of_the_domain_is_revised_taken_back_and_changed_outside(folder: Path) -> None:
    project = Project(folder)
    knowledge = folder / "fruit" / "knowledge.al"
    first = knowledge.read_text()
    edits = edits_between("knowledge.al", first, first + "% one\n")
    entry = project.revise(edits, why="a test", who="Ada")
    assert knowledge.read_text() == first + "% one\n"
    project.take_back(entry.number, who="Ada")
    assert knowledge.read_text() == first
    knowledge.write_text(first + "% by hand\n")
    assert Project(folder).domain() is not None
    assert knowledge.read_text() == first + "% by hand\n"


def test_a_revision_is_taken_back_from_under_what_another_program_wrote(folder: Path) -> None:
    project = Project(folder)
    knowledge = folder / "fruit" / "knowledge.al"
    first = knowledge.read_text()
    edits = edits_between("knowledge.al", first, first + "% one\n")
    entry = project.revise(edits, why="a test", who="Ada")
    knowledge.write_text("% by hand\n" + knowledge.read_text())
    project.refresh()
    project.take_back(entry.number, who="Ada")
    assert knowledge.read_text() == "% by hand\n" + first


def test_a_broken_domain_keeps_the_labels(folder: Path) -> None:
    project = Project(folder)
    project.label({"a.png": {"colour": "red"}}, who="Ada")
    knowledge = folder / "fruit" / "knowledge.al"
    good = knowledge.read_text()
    knowledge.write_text("#sort broken\n")
    again = Project(folder)
    assert again.labels().value("a.png", "colour") == "red"
    knowledge.write_text(good)
    assert Project(folder).labels().value("a.png", "colour") == "red"


LABELS_UNTIL_KILLED = """
import sys
from pathlib import Path
from seewhy.studio.project import Project
project = Project(Path(sys.argv[1]))
for number in range(int(sys.argv[2]), 10_000):
    project.label({"a.png": {"colour": ("red", "green")[number % 2]}}, who=str(number))
    print(number, flush=True)
"""


def test_a_killed_studio_loses_at_most_the_label_in_flight(folder: Path) -> None:
    said = -1
    for kill in range(4):
        process = subprocess.Popen(
            [sys.executable, "-c", LABELS_UNTIL_KILLED, str(folder), str(said + 1)],
            stdout=subprocess.PIPE,
            text=True,
        )
        assert process.stdout is not None
        for _ in range(3 + 2 * kill):
            said = int(process.stdout.readline())
        os.kill(process.pid, signal.SIGKILL)
        rest = process.stdout.read().split()
        said = max([said, *map(int, rest[-1:])])
        process.wait()
        project = Project(folder)
        kept = [int(entry.who) for entry in project.record.holding("label")]
        # Everything that was told to be kept is there, and at most one more.
        assert kept[: said + 1] == list(range(said + 1))
        assert len(kept) - (said + 1) in (0, 1)
        said = kept[-1]
        dataset = Dataset.load(folder, load_domain(folder / "fruit"))
        expected = ("red", "green")[said % 2]
        assert dataset.domain.named(dataset.scenes[0].vector)["colour"] == expected
        project.record.close()
