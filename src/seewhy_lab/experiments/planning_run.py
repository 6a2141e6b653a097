"""Run the trials of the planning experiment that are missing, and what they learn from."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import asdict, dataclass, replace
from pathlib import Path

from seewhy.errors import ExperimentError
from seewhy.files.whole_files import write_whole
from seewhy.knowledge.history import history_text, read_history_file
from seewhy.knowledge.learned_file import LEARNED, learned_text, read_learned
from seewhy_lab.experiments.catalogue import PLANNING
from seewhy_lab.experiments.experiment import ALL, Row, Trial
from seewhy_lab.experiments.jobs import run_all
from seewhy_lab.experiments.planning import (
    FIRST_RECORDED,
    RECORDED,
    fault,
    learned_from,
    recorded_run,
    robot_before,
    trial,
)
from seewhy_lab.experiments.published import take_up
from seewhy_lab.experiments.rows import finish, read_trial, write_tables
from seewhy_lab.experiments.settings import check_settings, digest

__all__ = ["FULL", "QUICK", "PlanningRun", "run_planning"]

FULL, QUICK = (100, RECORDED), (6, 12)
"""How many trials, and earlier runs to learn from."""

_RUNS = "runs"


@dataclass(frozen=True)
class PlanningRun:
    """The experiment as it is asked for.

    Attributes
    ----------
    out : Path
        The folder for the results of experiments; those of this one lie in ``planning``.
    trials, first_seed : int
    records : int
        How many earlier runs are learned from.
    before : int or None
        Steps that people may walk about before the robot begins; None: as planning.toml says.
    answer_sets : bool
        Whether both robots plan by answer sets alone.
    """

    out: Path
    trials: int = 100
    first_seed: int = 0
    records: int = RECORDED
    before: int | None = None
    answer_sets: bool = False

    @property
    def folder(self) -> Path:
        """Where the results lie."""
        return self.out / PLANNING

    @property
    def seeds(self) -> range:
        """The seeds of the trials."""
        return range(self.first_seed, self.first_seed + self.trials)


def run_planning(
    run: PlanningRun, *, jobs: int = -1, on_trial: Callable[[int], None] | None = None
) -> list[Row]:
    """Record runs, learn from them, run the trials that are missing; return all rows.

    What is finished is kept: the same call goes on from there.

    Raises
    ------
    ExperimentError
        If the folder holds trials with other settings.
    """
    if run.seeds[-1] >= FIRST_RECORDED:
        raise ExperimentError(
            f"--seed: the last of {run.trials} seeds would be {run.seeds[-1]:,}; from "
            f"{FIRST_RECORDED:,} on they are those of the runs that are learned from"
        )
    _check_settings(run)
    portable = replace(run, out=run.out.absolute())  # other machines work in other folders
    take_up(run.folder, fault=fault)
    _learn(portable, jobs=jobs)
    for done in run_all(_try, [(portable, seed) for seed in run.seeds], jobs=jobs):
        if on_trial is not None:
            on_trial(done)
    rows = [row for seed in run.seeds for row in read_trial(run.folder, Trial(seed, ALL)) or ()]
    write_tables(run.folder)
    return rows


def _record_file(run: PlanningRun, number: int) -> Path:
    return run.folder / _RUNS / f"{number:04}.al"


def _record(run: PlanningRun, number: int) -> None:
    file = _record_file(run, number)
    if not file.is_file():
        history = recorded_run(number, before=run.before)
        write_whole(file, history_text(history, title=f"run {number}"))


def _learn(run: PlanningRun, *, jobs: int) -> None:
    file = run.folder / LEARNED
    source = f"the record of {run.records} runs"
    if file.is_file():
        _require_whole(file, heading=learned_text((), source=source).splitlines()[0])
        return
    for _ in run_all(_record, [(run, number) for number in range(run.records)], jobs=jobs):
        pass
    signature = robot_before().knowledge.signature
    record = [read_history_file(_record_file(run, n), signature) for n in range(run.records)]
    found = learned_from(record)
    write_whole(file, learned_text(found.axioms, source=source))


def _require_whole(file: Path, *, heading: str) -> None:
    # A robot with an empty file would plan as if there had been nothing to learn.
    try:
        sound = file.read_text(encoding="utf-8").startswith(f"{heading}\n")
    except UnicodeDecodeError:
        sound = False
    if not sound:
        raise ExperimentError(
            f"{file}: is not as it was written; delete it, and the same command learns it again"
        )


def _try(run: PlanningRun, seed: int) -> None:
    def rows() -> list[Row]:
        axioms, _ = read_learned(run.folder / LEARNED, robot_before().knowledge.signature)
        return trial(seed=seed, learned=axioms, before=run.before, answer_sets=run.answer_sets)

    finish(run.folder, Trial(seed, ALL), rows)


def _check_settings(run: PlanningRun) -> None:
    folder = robot_before().folder
    check_settings(
        run.folder,
        {
            **{key: asdict(run)[key] for key in ("records", "before", "answer_sets")},
            # Earlier rows timed what a plan supposes, too, and other work of the machine.
            "planning_time": "processor time of plan()",
            "knowledge": digest(folder / "knowledge.al", folder / "planning.toml"),
        },
    )
