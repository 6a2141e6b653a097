"""`seewhy experiment planning`: small runs of the real thing."""

from __future__ import annotations

import csv
import json
from pathlib import Path

import pytest

from conftest import Run
from seewhy.planning.diagnosis.belief_state import State
from seewhy.planning.execution.execution import Decision, Outcome, Step
from seewhy.planning.execution.execution import Run as Execution
from seewhy.planning.execution.simulation import Simulation
from seewhy_lab.experiments import planning
from seewhy_lab.experiments.origin import here
from seewhy_lab.experiments.planning import MEASURES, SYSTEMS, summary

SMALL = ("--quick", "--trials", 1, "--seed", 3, "--jobs", 1)


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder for one pair of trials; what tests lose of it they make again."""
    return tmp_path_factory.mktemp("planning") / "out"


@pytest.fixture
def finished(run: Run, folder: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setattr("seewhy_lab.experiments.planning_run.QUICK", (1, 4))
    done = run("experiment", "planning", "--out", folder, *SMALL)
    assert (done.code, done.err) == (0, "")
    assert done.out.splitlines()[-1] == f"page: {folder / 'planning' / 'index.html'}"
    return folder


def test_both_arms_are_rows_and_a_page(finished: Path) -> None:
    folder = finished / "planning"
    with (folder / "rows.csv").open(encoding="utf-8", newline="") as stream:
        rows = list(csv.DictReader(stream))
    assert [row["system"] for row in rows] == ["before", "after"]
    assert rows[0]["goal"] == rows[1]["goal"]
    assert int(rows[0]["actions"]) > int(rows[1]["actions"])
    assert not any(name.startswith("seconds") for name in rows[0])
    learned = (folder / "learned.al").read_text(encoding="utf-8")
    assert "loc(P, L) if work_place(P, L), not -loc(P, L).\n" in learned
    page = (folder / "index.html").read_text(encoding="utf-8")
    for part in (
        "1 of 1 pairs of trials are finished, seeds 3 to 3.",
        "All trials (1 pairs)",
        "<pre>% Axioms that",
        f"<code>seewhy experiment planning --out {finished} --quick --trials 1 --seed 3 --jobs 1",
        f"({here().commit}). The trials: {here().commit} (1 trial).",
        "planning time is the processor's, of looking for plans alone,\nin the trials, made on",
    ):
        assert part in page
    assert "http" not in page.replace("http://www.w3.org/2000/svg", "")


def test_times_of_two_kinds_of_machines_are_not_put_together() -> None:
    rows = [
        {"seed": seed, "system": system, "machine": machine, **dict.fromkeys(MEASURES, value)}
        for seed, machine, value in ((0, "slow", 8.0), (1, "fast", 2.0), (2, "fast", 2.0))
        for system in SYSTEMS
    ]
    plans, *_, times, _ = summary(rows)
    assert (plans.trials, plans.before) == (3, 4.0)
    assert (times.trials, times.before) == (2, 2.0)
    *_, times, _ = summary(rows, machine="slow")
    assert (times.trials, times.before) == (1, 8.0)


def test_looking_in_vain_counts_for_the_trial_and_for_no_plan(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    robot = planning.robot_before()
    goal = planning.random_goal(robot, seed=0)
    nothing = State(frozenset())
    steps = [
        Step(0, (), nothing, (), Decision.PLAN, (), planning_seconds=1.0),
        Step(1, (), nothing, (), Decision.REPLAN, (), planning_seconds=2.0),
        Step(2, (), nothing, (), Decision.GIVE_UP, (), planning_seconds=5.0),
    ]
    given_up = Execution(goal, robot.history, steps, Outcome.IMPOSSIBLE)
    monkeypatch.setattr(planning, "_run", lambda *_, **__: Simulation(given_up))
    row, _ = planning.trial(seed=0, learned=())
    assert (row["plans"], row["seconds_planning"], row["seconds_per_plan"]) == (2, 8.0, 1.5)


def test_a_run_adds_only_what_is_missing(run: Run, finished: Path) -> None:
    folder = finished / "planning"
    lost, kept = folder / "runs" / "0000.al", folder / "runs" / "0001.al"
    record, times = lost.read_bytes(), kept.stat().st_mtime_ns
    learned, rows = (folder / "learned.al").read_bytes(), (folder / "rows.csv").read_bytes()
    lost.unlink()
    (folder / "learned.al").unlink()
    (folder / "trials" / "all-3.json").unlink()
    done = run("experiment", "planning", "--out", finished, *SMALL, "--json")
    assert (done.code, done.err) == (0, "")
    assert [ratio["measure"] for ratio in json.loads(done.out)["ratios"]] == list(MEASURES)
    # The same seeds make the same record and the same rows.
    assert (lost.read_bytes(), (folder / "rows.csv").read_bytes()) == (record, rows)
    assert (folder / "learned.al").read_bytes() == learned
    assert kept.stat().st_mtime_ns == times


@pytest.mark.parametrize("content", [b"", b"% nothing", b"\xff"])
def test_what_was_learned_may_be_damaged(run: Run, finished: Path, content: bytes) -> None:
    file = finished / "planning" / "learned.al"
    kept = file.read_bytes()
    try:
        file.write_bytes(content)
        done = run("experiment", "planning", "--out", finished, *SMALL)
    finally:
        file.write_bytes(kept)
    assert (done.code, done.out) == (2, "")
    assert done.err == (
        f"seewhy: {file}: is not as it was written; delete it, and the same command learns it "
        "again\n"
    )


@pytest.mark.parametrize(
    ("name", "options", "says"),
    [
        ("planning", ("--sizes", "100"), "--sizes goes with the other experiments; planning is of"),
        ("planning", ("--domain", "tabletop"), "--domain goes with the other experiments"),
        ("vqa", ("--answer-sets",), "--answer-sets goes with the experiment planning only"),
        ("vqa", ("--before", "0"), "--before goes with the experiment planning only"),
    ],
)
def test_options_of_other_experiments_are_refused(
    run: Run, tmp_path: Path, name: str, options: tuple[str, ...], says: str
) -> None:
    done = run("experiment", name, "--out", tmp_path / "out", *options)
    assert (done.code, done.out) == (2, "")
    assert done.err.startswith(f"seewhy: {says}")
    assert not (tmp_path / "out").exists()


def test_a_folder_of_other_settings_is_refused(run: Run, finished: Path, tmp_path: Path) -> None:
    done = run("experiment", "planning", "--out", finished, *SMALL, "--answer-sets")
    assert (done.code, "holds trials with other settings" in done.err) == (2, True)
    # Times of an earlier clock, which ran on while suppositions were worked out, are not mixed in.
    earlier = tmp_path / "out" / "planning" / "settings.json"
    earlier.parent.mkdir(parents=True)
    settings = json.loads((finished / "planning" / "settings.json").read_text(encoding="utf-8"))
    del settings["planning_time"]
    earlier.write_text(json.dumps(settings), encoding="utf-8")
    done = run("experiment", "planning", "--out", tmp_path / "out", *SMALL)
    assert (done.code, "holds trials with other settings (planning_time)" in done.err) == (2, True)
    file = tmp_path / "file"
    file.write_text("", encoding="utf-8")
    done = run("experiment", "planning", "--out", file, *SMALL)
    assert (done.code, "choose a folder for the results" in done.err) == (2, True)
