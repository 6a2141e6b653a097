"""Tables that were published without the trials' files, taken up as finished trials."""

from __future__ import annotations

import csv
import shutil
import tempfile
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from seewhy.errors import ExperimentError
from seewhy.experiments.experiment import Row, Trial
from seewhy.experiments.origin import COLUMNS
from seewhy.experiments.rows import ROWS, TIMINGS, TRIALS, is_timing, write_trial

__all__ = ["take_up"]


def take_up(folder: Path) -> None:
    """Write the trials whose rows the tables of an experiment have, where no trial is kept.

    What is committed, or handed on, of an experiment are its tables: whoever has these goes on
    from them, on a machine of another kind too. A folder with files of trials is left as it is.

    Parameters
    ----------
    folder : Path
        The folder of an experiment.

    Raises
    ------
    ExperimentError
        If a table is damaged, or the two do not belong together.

    Examples
    --------
    >>> import tempfile
    >>> from seewhy.experiments.rows import read_trial, write_table
    >>> folder = Path(tempfile.mkdtemp())
    >>> rows = [{"seed": 0, "size": 9, "system": "a", "accuracy": 0.5, "seconds_test": 1.5}]
    >>> write_table(folder / ROWS, rows, timings=False)
    >>> write_table(folder / TIMINGS, rows, timings=True)
    >>> take_up(folder)
    >>> read_trial(folder, Trial(seed=0, size=9)) == rows
    True
    """
    trials, tables = folder / TRIALS, (folder / ROWS, folder / TIMINGS)
    if trials.exists() or not any(table.exists() for table in tables):
        return
    found: dict[Trial, list[Row]] = {}
    made: dict[Trial, dict[str, str]] = {}
    for row in _rows(*tables):
        trial = Trial(row["seed"], row["size"])
        made[trial] = {key: str(row.pop(key)) for key in COLUMNS if row.get(key) is not None}
        found.setdefault(trial, []).append({key: row[key] for key in row if key not in COLUMNS})
    if not found:
        return
    # Whole or not at all: with half of them, the others would be run again.
    begun = Path(tempfile.mkdtemp(prefix=".trials-", dir=folder))
    try:
        for trial, rows in found.items():
            write_trial(begun, trial, rows, made=made[trial])
        (begun / TRIALS).rename(trials)
    except OSError:
        if not trials.exists():  # else another process was faster
            raise
    finally:
        shutil.rmtree(begun)


def _rows(table: Path, timings: Path) -> Iterator[Row]:
    """The lines of both tables, put together."""
    results, times = _lines(table), _lines(timings)
    for number, result in enumerate(results, start=2):
        time = times[number - 2] if number - 2 < len(times) else {}
        row = {key: _value(text) for key, text in (result | time).items()}
        row["system"] = result.get("system")
        shared = ("seed", "size", "system")
        if [result.get(key) for key in shared] != [time.get(key) for key in shared]:
            raise _unfit(timings, f"line {number} is not of the row in line {number} of {ROWS}")
        if not (_is_count(row.get("seed")) and _is_count(row.get("size")) and row["system"]):
            raise _unfit(table, f"line {number} does not say its seed, size, and system")
        if not all(isinstance(row[key], int | float | None) for key in row if is_timing(key)):
            raise _unfit(timings, f"line {number} has a time that is no number")
        yield row
    if len(times) > len(results):
        raise _unfit(timings, f"has more lines than {ROWS}")


def _lines(table: Path) -> list[dict[str, str]]:
    try:
        with table.open(encoding="utf-8", newline="") as stream:
            lines: list[dict[Any, Any]] = list(csv.DictReader(stream, strict=True))
    except FileNotFoundError:
        raise _unfit(table, "is missing") from None
    except (UnicodeDecodeError, csv.Error):
        raise _unfit(table, "is no table") from None
    for number, line in enumerate(lines, start=2):
        if None in line or None in line.values():
            raise _unfit(table, f"line {number} has not as many columns as the first")
    return lines


def _value(text: str) -> Any:
    """What was written as a cell of a table."""
    known = {"": None, "True": True, "False": False}
    if text in known:
        return known[text]
    for number in (int, float):
        try:
            return number(text)
        except ValueError:
            continue
    return text


def _is_count(value: Any) -> bool:
    return type(value) is int and value >= 0


def _unfit(table: Path, what: str) -> ExperimentError:
    return ExperimentError(
        f"{table}: {what}; put {ROWS} and {TIMINGS} back as they were written, or delete both, "
        "and the same command runs their trials"
    )
