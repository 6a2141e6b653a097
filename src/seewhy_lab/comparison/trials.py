"""Trials: one file each, whole or not at all; those that are missing are run."""

from __future__ import annotations

import json
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from seewhy.errors import ExperimentError
from seewhy.files.locks import locked
from seewhy.files.whole_files import write_whole
from seewhy_lab.comparison.picture_sets import SETS, Pictures
from seewhy_lab.comparison.system import Drawings, System
from seewhy_lab.experiments.experiment import ALL, say_size
from seewhy_lab.experiments.origin import here, installed

__all__ = ["Result", "Trial", "kept_results", "planned", "read_result", "run_trial", "trial_file"]

TRIALS, DRAWINGS = "trials", "drawings"
"""The folders of the files, and of what is drawn to train on before."""


@dataclass(frozen=True)
class Trial:
    """One system, trained on some pictures of a set; the same for all systems.

    Attributes
    ----------
    pictures : str
        The name of the set.
    system : str
    count : int
        Labels; 0 for all.
    seed : int
        Of which labels are drawn, and of training.
    drawn : int, default 0
        Pictures of the domain's source that the system is trained on before.
    """

    pictures: str
    system: str
    count: int
    seed: int
    drawn: int = 0

    @property
    def name(self) -> str:
        """What it is called, which is also where its file lies.

        Examples
        --------
        >>> Trial("hands", "fine_tuned", 300, 1).name, Trial("signs", "before", ALL, 0).name
        ('hands/fine_tuned-300-1', 'signs/before-all-0')
        """
        before = f"-drawn{self.drawn}" if self.drawn else ""
        return f"{self.pictures}/{self.system}-{say_size(self.count)}-{self.seed}{before}"


@dataclass(frozen=True)
class Result:
    """What came of a trial.

    Attributes
    ----------
    trial : Trial
    accuracy, balanced_accuracy : float
        Shares of the pictures tested on, and the mean of the shares of their classes. A picture
        of which a system says that it does not know counts as wrong.
    unknown : float
        The share of those.
    trained_on, tested : int
        Pictures.
    seconds, processor_seconds : float
        Of training. Embeddings that an earlier trial made are found again, as is what a system
        learned from drawings.
    options : mapping
        How the system was trained.
    version, commit, machine : str
        What ran.
    """

    trial: Trial
    accuracy: float
    balanced_accuracy: float
    unknown: float
    trained_on: int
    tested: int
    seconds: float
    processor_seconds: float
    options: Mapping[str, Any]
    version: str
    commit: str
    machine: str


def planned(
    sets: Sequence[str],
    systems: Sequence[System],
    *,
    counts: Sequence[int] | None,
    seeds: int,
    drawn: int,
    on_processor: bool,
) -> list[Trial]:
    """Every trial that is asked for, seed by seed, so that soon there is one of each.

    Parameters
    ----------
    sets : sequence of str
    systems : sequence of System
    counts : sequence of int or None
        Instead of those of each set.
    seeds : int
        How many, from 0 on.
    drawn : int
        Drawings before.
    on_processor : bool
        Whether there is no graphics processor: systems that need one leave large counts out.
    """
    return [
        Trial(name, system.name, count, seed, drawn)
        for seed in range(seeds)
        for name in sets
        for count in (counts if counts is not None else SETS[name].counts)
        for system in systems
        if not (on_processor and is_too_many(system, count))
    ]


def is_too_many(system: System, count: int) -> bool:
    """Whether a system has no patience for so many labels without a graphics processor.

    Examples
    --------
    >>> from seewhy_lab.comparison.catalogue import SYSTEMS
    >>> [is_too_many(SYSTEMS["fine_tuned"], count) for count in (500, 501, ALL)]
    [False, True, True]
    """
    return system.most is not None and (count == ALL or count > system.most)


def trial_file(out: Path, trial: Trial) -> Path:
    """Where a trial's file lies."""
    return out / TRIALS / f"{trial.name}.json"


def run_trial(
    out: Path, trial: Trial, system: System, pictures: Callable[[], Pictures]
) -> Result | None:
    """Run a trial and write its file; None where there is one, or where somebody else runs it."""
    file = trial_file(out, trial)
    if file.exists():
        return None
    with locked(file) as ours:
        if not ours or file.exists():
            return None
        result = _result(trial, system, pictures(), _drawings(out, trial))
        write_whole(file, json.dumps(asdict(result), indent=1) + "\n")
        return result


def _drawings(out: Path, trial: Trial) -> Drawings | None:
    if not trial.drawn:
        return None
    folder = out / DRAWINGS / f"{trial.pictures}-{trial.drawn}"
    return Drawings(SETS[trial.pictures].domain, trial.drawn, folder)


def _result(trial: Trial, system: System, pictures: Pictures, drawings: Drawings | None) -> Result:
    train, test = pictures.drawn(trial.count, trial.seed), pictures.test
    origin = here()  # what is checked out when the trial ends need not be what runs
    began, processor_began = time.perf_counter(), time.process_time()
    fitted = system.fit(train, trial.seed, drawings)
    ended, processor_ended = time.perf_counter(), time.process_time()
    found = fitted.classify(test)
    right: dict[str, list[bool]] = {}
    for said, true in zip(found, test.classes, strict=True):
        right.setdefault(true, []).append(said == true)
    return Result(
        trial=trial,
        accuracy=sum(map(sum, right.values())) / len(test),
        balanced_accuracy=sum(sum(some) / len(some) for some in right.values()) / len(right),
        unknown=sum(said is None for said in found) / len(test),
        trained_on=len(train),
        tested=len(test),
        seconds=round(ended - began, 1),
        processor_seconds=round(processor_ended - processor_began, 1),
        options=fitted.options,
        version=installed("seewhy"),
        commit=origin.commit,
        machine=origin.machine,
    )


def read_result(file: Path) -> Result:
    """What a trial's file says.

    Raises
    ------
    ExperimentError
        It is damaged, or lies where another trial's file belongs.
    """
    try:
        found: dict[str, Any] = json.loads(file.read_text(encoding="utf-8"))
        result = Result(**{**found, "trial": Trial(**found["trial"])})
        shares = (result.accuracy, result.balanced_accuracy, result.unknown)
        sound = all(0.0 <= share <= 1.0 for share in shares)
        sound = sound and file == trial_file(file.parents[2], result.trial)
    except (ValueError, KeyError, TypeError, RecursionError):
        sound = False
    if not sound:
        raise ExperimentError(
            f"{file}: is not as it was written; delete it, and the same command makes it again"
        )
    return result


def kept_results(out: Path) -> Iterator[Result]:
    """The results of every trial that has a file, in no order.

    Raises
    ------
    ExperimentError
        A file is damaged.
    """
    for file in sorted((out / TRIALS).glob("*/*.json")):
        if not file.name.startswith("."):  # another process is writing that
            yield read_result(file)
