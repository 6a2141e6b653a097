"""Tables without the files of their trials: whoever has them goes on from them."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from conftest import Run
from seewhy.errors import ExperimentError
from seewhy_lab.experiments.catalogue import PLANNING, experiment
from seewhy_lab.experiments.experiment import Measure, Row, Trial
from seewhy_lab.experiments.planning import fault as planning_fault
from seewhy_lab.experiments.published import take_up
from seewhy_lab.experiments.row_check import fault
from seewhy_lab.experiments.rows import (
    ROWS,
    TIMINGS,
    TRIALS,
    read_trial,
    trial_file,
    write_table,
    write_trial,
)

RESULTS = Path(__file__).parents[1] / "results"
UNTRACKED = shutil.ignore_patterns("trials", "runs")
"""What a folder of results has where its trials were run, and a clone has not."""
TABLES = sorted(path.parent.relative_to(RESULTS) for path in RESULTS.glob("*/*/rows.csv"))


def published(folder: Path, rows: list[Row]) -> Path:
    write_table(folder / ROWS, rows, timings=False)
    write_table(folder / TIMINGS, rows, timings=True)
    return folder


def row(seed: int, system: str = "a", **more: object) -> Row:
    return {"seed": seed, "size": 9, "system": system, "accuracy": 0.5, "seconds": 1.5, **more}


@pytest.mark.parametrize("name", TABLES, ids=str)
def test_committed_tables_are_taken_up_to_the_byte(name: Path, tmp_path: Path) -> None:
    folder = tmp_path / name.name
    shutil.copytree(RESULTS / name, folder, ignore=UNTRACKED)
    experiment_name = name.name.partition("-")[0]
    if experiment_name == PLANNING:
        take_up(folder, fault=planning_fault)
    else:
        take_up(folder, fault=lambda row: fault(row, experiment(experiment_name).measures))
    found = [read_trial(folder, trial) for trial in trials_of(folder / ROWS)]
    rows = [row for trial in found for row in trial or ()]
    assert len(rows) == len((folder / ROWS).read_text().splitlines()) - 1
    published(folder, rows)
    for table in (ROWS, TIMINGS):
        assert (folder / table).read_bytes() == (RESULTS / name / table).read_bytes()


def trials_of(table: Path) -> list[Trial]:
    lines = [line.split(",")[:2] for line in table.read_text().splitlines()[1:]]
    return list(dict.fromkeys(Trial(int(seed), int(size)) for seed, size in lines))


# What cells hold: a text that reads as another kind, or an empty one, is none of ours.
CELLS = (
    st.none()
    | st.booleans()
    | st.integers(-(2**60), 2**60)
    | st.floats(allow_nan=False, allow_infinity=False)
    | st.sampled_from(["achieved", 'status(m1, "x")', "a, b", "two\nlines"])
)


@given(cells=st.lists(st.tuples(CELLS, CELLS), min_size=1, max_size=4))
def test_every_cell_comes_back(cells: list[tuple[object, object]]) -> None:
    import tempfile

    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        rows = [
            row(0, f"system {n}", first=a, second=b, machine="m, 2 cores", commit="commit 1ab")
            for n, (a, b) in enumerate(cells)
        ]
        take_up(published(folder, rows))
        assert read_trial(folder, Trial(0, 9)) == rows


def test_trials_and_tables_are_put_together(tmp_path: Path) -> None:
    write_trial(tmp_path, Trial(1, 9), [row(1)], made={})
    times = trial_file(tmp_path, Trial(1, 9)).stat().st_mtime_ns
    take_up(published(tmp_path, [row(0), row(1)]))
    assert [read_trial(tmp_path, Trial(seed, 9)) for seed in (0, 1)] == [[row(0)], [row(1)]]
    assert trial_file(tmp_path, Trial(1, 9)).stat().st_mtime_ns == times


@pytest.mark.parametrize("kept", [row(1, accuracy=0.6), row(1, seconds=2.5)])
def test_a_trial_that_has_other_rows_than_the_tables_is_named(tmp_path: Path, kept: Row) -> None:
    write_trial(tmp_path, Trial(1, 9), [kept], made={})
    published(tmp_path, [row(0), row(1)])
    with pytest.raises(ExperimentError) as error:
        take_up(tmp_path)
    assert str(error.value) == (
        f"{tmp_path}/rows.csv: rows.csv or timings.csv has other numbers than "
        f"{tmp_path}/trials/9-1.json; delete that file to go on from the tables, or take its lines "
        "out of both tables to keep it"
    )
    assert read_trial(tmp_path, Trial(0, 9)) is None


def test_there_may_be_nothing(tmp_path: Path) -> None:
    take_up(tmp_path / "not there")
    published(tmp_path, [])
    take_up(tmp_path)
    assert not (tmp_path / TRIALS).exists()


@pytest.mark.parametrize(
    ("table", "change", "why"),
    [
        (ROWS, lambda text: text.replace("\n1,9,", "\n2,9,"),
         "timings.csv: has no line of 'a' in the trial 9-2"),
        (TIMINGS, lambda text: text.rsplit("\n", 2)[0] + "\n",
         "timings.csv: has no line of 'a' in the trial 9-1"),
        (ROWS, lambda text: text.rsplit("\n", 2)[0] + "\n",
         "rows.csv: has no line of 'a' in the trial 9-1"),
        (ROWS, lambda text: text.replace("\n1,9,", "\n0,9,"),
         "rows.csv: line 3 is of the same trial and system as another"),
        (ROWS, lambda text: text.replace("1,9,a,0.5", "1,9,a"),
         "rows.csv: line 3 has not as many columns as the first"),
        (ROWS, lambda text: text.replace("1,9,a,0.5", "1,9,a,0.5,0.6"),
         "rows.csv: line 3 has not as many columns as the first"),
        (TIMINGS, lambda text: text.replace("1.5", "soon", 1),
         "timings.csv: line 2 has a time that is no number of seconds"),
        (TIMINGS, lambda text: text.replace("1.5", "-1.5", 1),
         "timings.csv: line 2 has a time that is no number of seconds"),
        (TIMINGS, lambda text: text.replace("1.5", "inf", 1),
         "timings.csv: line 2 has a time that is no number of seconds"),
        (ROWS, lambda text: "\udcff" + text, "rows.csv: is no table"),
        (ROWS, lambda text: text + '3,9,"a', "rows.csv: is no table"),
    ],
)  # fmt: skip
def test_damaged_tables_are_refused(tmp_path: Path, table: str, change, why: str) -> None:  # type: ignore[no-untyped-def]
    folder = published(tmp_path, [row(0), row(1)])
    text = (folder / table).read_text()
    (folder / table).write_text(change(text), errors="surrogateescape")
    with pytest.raises(ExperimentError) as error:
        take_up(folder)
    assert str(error.value) == f"{folder}/{why}{REMEDY}"
    assert not (folder / TRIALS).exists()


REMEDY = (
    "; put rows.csv and timings.csv back as they were written, or delete both: trials that have no "
    "file are then run again"
)


def test_a_trial_has_a_row_of_every_system(tmp_path: Path) -> None:
    published(tmp_path, [row(0, "a"), row(0, "b"), row(1, "a")])
    with pytest.raises(ExperimentError) as error:
        take_up(tmp_path)
    assert str(error.value) == f"{tmp_path}/rows.csv: has no line of 'b' in the trial 9-1{REMEDY}"
    assert not (tmp_path / TRIALS).exists()


def test_tables_may_lag_behind_the_trials(tmp_path: Path) -> None:
    # Who was killed between the two, or wrote them beside another, left one without the other.
    for seed in (0, 1):
        write_trial(tmp_path, Trial(seed, 9), [row(seed)], made={})
    write_table(tmp_path / ROWS, [row(0), row(1)], timings=False)
    take_up(tmp_path)
    write_table(tmp_path / TIMINGS, [row(0)], timings=True)
    take_up(tmp_path)
    write_table(tmp_path / ROWS, [row(1)], timings=False)
    take_up(tmp_path)
    assert [read_trial(tmp_path, Trial(seed, 9)) for seed in (0, 1)] == [[row(0)], [row(1)]]


@pytest.mark.parametrize(
    ("change", "why"),
    [
        (("0.5", "abc"), "accuracy is abc, not a share between 0 and 1"),
        (("0.5", "70.7"), "accuracy is 70.7, not a share between 0 and 1"),
        (("0.5", "nan"), "accuracy is nan, not a share between 0 and 1"),
        (("0.5", "True"), "accuracy is True, not a share between 0 and 1"),
        (("accuracy", "precision"), "accuracy is missing, not a share between 0 and 1"),
        ((",7,", ",,"), "trained is missing, not a number of pictures or scenes"),
        ((",8\n", ",x\n"), "tested is x, not a number of pictures or scenes"),
    ],
)
def test_a_row_holds_what_is_told_of_it(tmp_path: Path, change: tuple[str, str], why: str) -> None:
    rows: list[Row] = [
        {"seed": 0, "size": 9, "system": "a", "accuracy": 0.5, "trained": 7, "tested": 8}
    ]
    folder = published(tmp_path, rows)
    measures = [Measure("accuracy", "classified rightly")]
    take_up(folder, fault=lambda row: fault(row, measures))
    shutil.rmtree(folder / TRIALS)
    text = (folder / ROWS).read_text()
    (folder / ROWS).write_text(text.replace(*change))
    with pytest.raises(ExperimentError) as error:
        take_up(folder, fault=lambda row: fault(row, measures))
    assert str(error.value) == f"{folder}/rows.csv: line 2: {why}{REMEDY}"
    assert not (folder / TRIALS).exists()


@pytest.mark.parametrize("seed", ["", "x", "-1", "1.5", "True"])
def test_a_row_needs_its_trial(tmp_path: Path, seed: str) -> None:
    folder = published(tmp_path, [row(0)])
    for table in (ROWS, TIMINGS):
        file = folder / table
        file.write_text(file.read_text().replace("\n0,9,", f"\n{seed},9,"))
    with pytest.raises(ExperimentError, match="line 2 does not say its seed, size, and system"):
        take_up(folder)


@pytest.mark.parametrize("table", [ROWS, TIMINGS])
def test_one_table_alone_is_refused(tmp_path: Path, table: str) -> None:
    published(tmp_path, [row(0)])
    (tmp_path / table).unlink()
    with pytest.raises(ExperimentError, match=f"{table}: has no line of 'a' in the trial 9-0"):
        take_up(tmp_path)


@pytest.mark.parametrize(
    ("change", "why"),
    [
        ((",before,3,", ",before,many,"), "plans is many, not a number"),
        (("achieved,True,", "achieved,x,"), "it does not say how the trial ended"),
    ],
)
def test_damaged_tables_of_planning_are_refused(
    run: Run, tmp_path: Path, change: tuple[str, str], why: str
) -> None:
    folder = tmp_path / "planning"
    shutil.copytree(RESULTS / "robot" / "planning", folder, ignore=UNTRACKED)
    text = (folder / ROWS).read_text(encoding="utf-8")
    (folder / ROWS).write_text(text.replace(*change, 1), encoding="utf-8")
    result = run("experiment", "planning", "--out", tmp_path, "--jobs", 1)
    assert (result.code, result.out) == (2, "")
    assert result.err == f"seewhy: {folder / ROWS}: line 2: {why}{REMEDY}\n"


def test_planning_goes_on_from_published_tables(run: Run, tmp_path: Path) -> None:
    # Nothing is learned or run again: a copy of what is committed is finished.
    folder = tmp_path / "planning"
    shutil.copytree(RESULTS / "robot" / "planning", folder, ignore=UNTRACKED)
    before = {name: (folder / name).read_bytes() for name in (ROWS, TIMINGS, "learned.al")}
    result = run("experiment", "planning", "--out", tmp_path, "--jobs", 1)
    assert (result.code, result.err) == (0, "")
    assert {name: (folder / name).read_bytes() for name in before} == before
    assert not (folder / "runs").exists()
