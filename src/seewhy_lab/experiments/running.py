"""Run the trials of an experiment that are missing, in any number of processes and machines."""

from __future__ import annotations

import ctypes
import shutil
from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from pathlib import Path

from joblib import cpu_count

from seewhy.data.dataset import TABLE
from seewhy.data.picture_source import load_source
from seewhy.domain.domain import Domain, load_domain
from seewhy.domain.folder import FILES
from seewhy.domain.reading_rule import ReadingRule, reading_rule
from seewhy.errors import ExperimentError
from seewhy_lab.experiments.catalogue import COMPARES_READINGS, experiment
from seewhy_lab.experiments.drawing import POOL, load_pictures, pool_of, require_enough
from seewhy_lab.experiments.experiment import Plan, Row, Setting, Trial
from seewhy_lab.experiments.jobs import run_all
from seewhy_lab.experiments.published import take_up
from seewhy_lab.experiments.row_check import fault
from seewhy_lab.experiments.rows import finish, kept_trials, read_trial
from seewhy_lab.experiments.settings import check_settings, digest, require_settings

__all__ = ["Run", "finished_rows", "prepare", "run_missing", "setting_of", "side_by_side"]

SEEDS = 2**32
"""The seeds that there are: scikit-learn's are as many."""

_TRIM_THRESHOLD, _MMAP_THRESHOLD = -1, -3  # glibc's numbers for what mallopt sets
_KEPT = 2**30  # bytes


@dataclass(frozen=True)
class Run:
    """An experiment as it is asked for: what is passed to the processes that run its trials.

    Attributes
    ----------
    experiment : str
        Its name.
    domain : str
        A bundled domain's name or a domain folder.
    pictures, out : Path
        Where the pictures are, and where the results go.
    tested, drawn : int
        See :class:`~seewhy_lab.experiments.experiment.Setting`.
    trials : tuple of Trial
        Seed by seed.
    reading : {"argmax", "consistent", "with_class"}, optional
        How SeeWhy reads features, where that is not as the domain says.
    """

    experiment: str
    domain: str
    pictures: Path
    out: Path
    tested: int
    drawn: int
    trials: tuple[Trial, ...]
    reading: ReadingRule | None = None

    @property
    def folder(self) -> Path:
        """Where the results of the experiment lie; beside it, what experiments share."""
        name = self.experiment if self.reading is None else f"{self.experiment}-{self.reading}"
        return self.out / name


def prepare(
    name: str,
    domain: str,
    out: Path,
    *,
    data: Path | None = None,
    trials: int | None = None,
    sizes: Sequence[int] | None = None,
    first_seed: int = 0,
    quick: bool = False,
    tested: int | None = None,
    drawn: int = 0,
    reading: str | None = None,
    workers: int = -1,
    on_picture: Callable[[int], None] | None = None,
) -> Run:
    """Make or find the pictures, check what is asked for, and return it as data.

    Parameters
    ----------
    name, domain : str
    out : Path
        The folder for results; a folder with results of the same settings is gone on with.
    data : Path, optional
        Annotated pictures; without it the domain's source draws some.
    trials : int, optional
        How many seeds; what the experiment says where left out, as for ``sizes``.
    sizes : sequence of int, optional
    first_seed : int, default 0
    quick : bool, default False
        The smaller version of the experiment.
    tested : int, optional
        Pictures that a trial tests on; what the experiment says where left out.
    drawn : int, default 0
        Pictures of the domain's source that networks are trained on before.
    reading : {"argmax", "consistent", "with_class"}, optional
        How SeeWhy reads features; as the domain says where left out. Results of another way go
        into a folder of their own, ``vqa-with_class`` say; what networks saw is shared.
    workers : int, default -1
        Processes that draw pictures.
    on_picture : callable, optional
        Called with the number of pictures drawn so far.

    Raises
    ------
    ExperimentError
        If something asked for cannot be done.
    """
    design = experiment(name)
    loaded = load_domain(domain)
    plan: Plan = design.plan(loaded.name, quick=quick)
    rule = _other_rule(name, loaded, reading)
    count = plan.trials if trials is None else trials
    chosen = tuple(dict.fromkeys(plan.sizes if sizes is None else sizes))
    _make_folder(out)
    if drawn:
        load_source(loaded)  # or the folder would be kept for trials that cannot be run
    if first_seed + count > SEEDS:
        raise ExperimentError(
            f"--seed: the last of {count} seeds would be {first_seed + count - 1:,}; seeds go up "
            f"to {SEEDS - 1:,}"
        )
    tests = plan.tested if tested is None else tested
    settings = {
        "domain": loaded.name,
        "knowledge": digest(*(loaded.folder / name for name in FILES)),
        "tested": tests,
        "drawn": drawn,
    }
    require_settings(out, settings)  # or pictures would be drawn for trials that cannot be run
    new = data is None and not (out / POOL).exists()
    pictures = pool_of(
        loaded, data, out, count=plan.pictures, workers=workers, on_picture=on_picture
    )
    run = Run(
        experiment=name,
        domain=domain,
        pictures=pictures,
        out=out,
        tested=tests,
        drawn=drawn,
        trials=tuple(
            Trial(seed, size) for seed in range(first_seed, first_seed + count) for size in chosen
        ),
        reading=rule,
    )
    try:
        require_settings(out, {"pictures": digest(pictures / TABLE)})
    except ExperimentError:
        if new:  # or the right command would find the wrong pictures
            shutil.rmtree(pictures)
        raise
    setting = setting_of(run)
    for trial in run.trials:
        require_enough(setting, trial)
    check_settings(out, {**settings, "pictures": digest(pictures / TABLE)})
    take_up(run.folder, fault=lambda row: fault(row, design.measures))
    _check_systems(run)
    return run


def _other_rule(name: str, domain: Domain, reading: str | None) -> ReadingRule | None:
    """The rule that is asked for; None where features are read by it anyway."""
    rule = None if reading is None else reading_rule(reading)
    if rule is not None and name == COMPARES_READINGS:
        raise ExperimentError(
            "--reading goes with the other experiments; reading compares all ways to read"
        )
    # Trials are of networks that grow, which read each feature alone where nothing else is said.
    return None if rule == (domain.reading or "argmax") else rule


def _make_folder(out: Path) -> None:
    try:
        out.mkdir(parents=True, exist_ok=True)
    except (FileExistsError, NotADirectoryError):
        raise ExperimentError(
            f"{out}: is a file, or lies in one; choose a folder for the results with --out"
        ) from None


def _check_systems(run: Run) -> None:
    """Refuse trials of an earlier version, which compared other systems."""
    systems = set(experiment(run.experiment).systems)
    for trial in kept_trials(run.folder):
        rows = read_trial(run.folder, trial)
        if rows is not None and {row["system"] for row in rows} != systems:
            found = ", ".join(dict.fromkeys(str(row["system"]) for row in rows))
            raise ExperimentError(
                f"{run.folder}: holds trials of an earlier version, which compared others "
                f"({found}); choose another folder with --out, or delete this one"
            )


def run_missing(run: Run, *, jobs: int = -1, on_trial: Callable[[int], None] | None = None) -> None:
    """Run the trials that no file is there for.

    Parameters
    ----------
    run : Run
    jobs : int, default -1
        Processes; -1: one a core. Machines of a Ray cluster, where one is named, must all see the
        folder of the results; see :func:`seewhy_lab.experiments.jobs.run_all`.
    on_trial : callable, optional
        Called with the number of finished trials, those of earlier calls included.
    """
    missing = [trial for trial in run.trials if read_trial(run.folder, trial) is None]
    done = len(run.trials) - len(missing)
    if on_trial is not None:
        on_trial(done)
    portable = _anywhere(run)
    ordered = side_by_side(missing, cpu_count() if jobs < 1 else jobs)
    for more in run_all(_run_one, [(portable, trial) for trial in ordered], jobs=jobs):
        if on_trial is not None:
            on_trial(done + more)


def side_by_side(trials: Sequence[Trial], count: int) -> list[Trial]:
    """Order trials so that those run at the same time are of different seeds.

    Of one seed they may need the same networks, which one would train while the others wait. Every
    so many seeds are finished before the next are begun, so that what is finished has every size.

    Examples
    --------
    >>> trials = [Trial(seed, size) for seed in range(3) for size in (20, 30)]
    >>> [trial.name for trial in side_by_side(trials, 2)]
    ['20-0', '20-1', '30-0', '30-1', '20-2', '30-2']
    """
    seeds = {seed: n for n, seed in enumerate(dict.fromkeys(trial.seed for trial in trials))}
    sizes = {size: n for n, size in enumerate(dict.fromkeys(trial.size for trial in trials))}
    return sorted(trials, key=lambda trial: (seeds[trial.seed] // count, sizes[trial.size]))


def _anywhere(run: Run) -> Run:
    """The same run for processes that work in other folders, as those of a Ray cluster do."""
    folder = Path(run.domain)
    return replace(
        run,
        domain=str(folder.absolute()) if folder.is_dir() else run.domain,
        pictures=run.pictures.absolute(),
        out=run.out.absolute(),
    )


def finished_rows(run: Run) -> list[Row]:
    """The rows of all trials of a run that are finished, size by size."""
    asked = set(run.trials)
    return [
        row
        for trial in kept_trials(run.folder)
        if trial in asked
        for row in read_trial(run.folder, trial) or ()
    ]


def setting_of(run: Run) -> Setting:
    """Return what all trials of a run share."""
    scenes = load_pictures(run.domain, run.pictures, run.out)
    domain = scenes.domain
    if run.reading is not None:
        domain = replace(domain, reading=run.reading)
    return Setting(domain, scenes, run.tested, run.drawn, run.out)


def _run_one(run: Run, trial: Trial) -> None:
    """Run one trial and write its rows, unless somebody else does or did."""
    import torch

    def rows() -> list[Row]:
        # Networks this small gain nothing from a second thread; trials run beside each other.
        torch.set_num_threads(1)
        _keep_memory()
        return experiment(run.experiment).trial(setting_of(run), trial)

    finish(run.folder, trial, rows)


def _keep_memory() -> None:
    """Let freed memory stay with this process, where the C library can be told so (glibc).

    Every step of training takes and frees the same megabytes; fetching them from the system anew
    costs a tenth of the time.
    """
    with suppress(OSError, AttributeError):
        library = ctypes.CDLL(None)
        for parameter in (_TRIM_THRESHOLD, _MMAP_THRESHOLD):
            library.mallopt(parameter, _KEPT)
