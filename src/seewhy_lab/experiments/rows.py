"""The results on disk: one file a finished trial, and one table of all."""

from __future__ import annotations

import csv
import hashlib
import io
import json
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import asdict
from pathlib import Path
from typing import Any

from seewhy.errors import ExperimentError
from seewhy.files.locks import locked
from seewhy.files.whole_files import write_whole
from seewhy_lab.experiments.experiment import ALL, Row, Trial, say_size
from seewhy_lab.experiments.origin import COLUMNS, here
from seewhy_lab.experiments.row_check import is_time

__all__ = [
    "ROWS",
    "TIMINGS",
    "TRIALS",
    "finish",
    "is_timing",
    "kept_trials",
    "read_trial",
    "trial_file",
    "write_table",
    "write_tables",
    "write_trial",
]

ROWS, TIMINGS = "rows.csv", "timings.csv"
"""The names of the tables."""

TRIALS = "trials"
"""The folder of the files of the trials."""


def is_timing(column: str) -> bool:
    """Whether a column is a time, which no two runs agree about.

    Examples
    --------
    >>> is_timing("seconds_training"), is_timing("seed")
    (True, False)
    """
    return column.startswith("seconds")


def trial_file(out: Path, trial: Trial) -> Path:
    """Where a trial's rows lie."""
    return out / TRIALS / f"{trial.name}.json"


def kept_trials(out: Path) -> list[Trial]:
    """The trials that have a file, size by size, all pictures last.

    Examples
    --------
    >>> import tempfile
    >>> folder = Path(tempfile.mkdtemp())
    >>> for size, seed in ((0, 1), (20, 0), (9, 3)):
    ...     write_trial(folder, Trial(seed, size), [])
    >>> [trial.name for trial in kept_trials(folder)]
    ['9-3', '20-0', 'all-1']
    """
    found = []
    for file in (out / TRIALS).glob("*.json"):
        size, _, seed = file.stem.partition("-")
        if seed.isdecimal() and (size.isdecimal() or size == say_size(ALL)):
            trial = Trial(int(seed), ALL if size == say_size(ALL) else int(size))
            if file == trial_file(out, trial):
                found.append(trial)
    return sorted(found, key=lambda trial: (trial.size == ALL, trial.size, trial.seed))


def write_tables(out: Path) -> None:
    """Write the rows of all trials that have a file as tables, the timings in one of their own."""
    rows = [row for trial in kept_trials(out) for row in read_trial(out, trial) or ()]
    write_table(out / ROWS, rows, timings=False)
    write_table(out / TIMINGS, rows, timings=True)


def write_trial(
    out: Path, trial: Trial, rows: Sequence[Row], *, made: Mapping[str, str] | None = None
) -> None:
    """Write the rows of a finished trial and where they were made, whole or not at all.

    They were made here, unless ``made`` says where, by
    :data:`seewhy_lab.experiments.origin.COLUMNS`.
    """
    origin = asdict(here()) if made is None else made
    content = {"trial": trial.name, "made": origin, "rows": rows, "digest": _digest(rows)}
    write_whole(trial_file(out, trial), json.dumps(content, indent=1))


def finish(out: Path, trial: Trial, make: Callable[[], Sequence[Row]]) -> None:
    """Make a trial's rows and write them, unless somebody else does or did."""
    file = trial_file(out, trial)
    if file.exists():
        return
    with locked(file) as ours:
        if ours and not file.exists():
            here()  # what is checked out when the trial ends need not be what runs
            write_trial(out, trial, make())


def read_trial(out: Path, trial: Trial) -> list[Row] | None:
    """Return the rows of a trial; None where it is not finished.

    Rows whose file says so have the columns that tell where they were made
    (:data:`seewhy_lab.experiments.origin.COLUMNS`).

    Raises
    ------
    ExperimentError
        If the file is damaged.
    """
    file = trial_file(out, trial)
    try:
        text = file.read_text(encoding="utf-8")
    except FileNotFoundError:
        return None
    except UnicodeDecodeError:
        raise _damaged(file) from None
    try:
        found: Any = json.loads(text)
        rows, made = found["rows"], found.get("made", {})
        # Trials of earlier versions have no digest.
        sound = (
            found["trial"] == trial.name
            and found.get("digest", _digest(rows)) == _digest(rows)
            and all(_is_row(row, trial) for row in rows)
        )
        made = {key: str(made[key]) for key in COLUMNS if key in made}
    except (ValueError, KeyError, TypeError, RecursionError):
        raise _damaged(file) from None
    if not sound or not rows:
        raise _damaged(file)
    return [{**row, **made} for row in rows]


def _is_row(row: Row, trial: Trial) -> bool:
    """Whether a row is one of a trial, with numbers for times."""
    return (
        (row["seed"], row["size"]) == (trial.seed, trial.size)
        and isinstance(row["system"], str)
        and all(is_time(row[key]) for key in row if is_timing(key))
    )


def _digest(rows: Sequence[Row]) -> str:
    return hashlib.sha256(json.dumps(rows).encode()).hexdigest()[:16]


def _damaged(file: Path) -> ExperimentError:
    return ExperimentError(
        f"{file}: is not as it was written; delete it, and the same command makes it again"
    )


def write_table(path: Path, rows: Iterable[Row], *, timings: bool) -> None:
    """Write rows as CSV: what the trials found, or with ``timings`` how long they took.

    The table without timings is the same whenever the trials are; where they ran goes with the
    timings.
    """
    rows = list(rows)
    names = dict.fromkeys(name for row in rows for name in row)
    if timings:
        columns = [name for name in ("seed", "size", "system", *COLUMNS) if name in names]
        columns += [name for name in names if is_timing(name)]
    else:
        columns = [name for name in names if not is_timing(name) and name not in COLUMNS]
    text = io.StringIO()
    writer = csv.DictWriter(text, columns, lineterminator="\n", extrasaction="ignore")
    writer.writeheader()
    writer.writerows(rows)
    write_whole(path, text.getvalue())
