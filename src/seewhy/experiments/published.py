"""Tables that were published without the trials' files, taken up as finished trials."""

from __future__ import annotations

import csv
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

from seewhy.errors import ExperimentError
from seewhy.experiments.experiment import Row, Trial
from seewhy.experiments.origin import COLUMNS
from seewhy.experiments.row_check import incomplete, is_time
from seewhy.experiments.rows import (
    ROWS,
    TIMINGS,
    TRIALS,
    is_timing,
    read_trial,
    trial_file,
    write_trial,
)

__all__ = ["take_up"]


def take_up(folder: Path, *, fault: Callable[[Row], str] | None = None) -> None:
    """Write the trials whose rows the tables of an experiment have, where they are not kept.

    What is committed, or handed on, of an experiment are its tables: whoever has these goes on
    from them, on a machine of another kind too.

    Parameters
    ----------
    folder : Path
        The folder of an experiment.
    fault : callable, optional
        Says what is wrong with a row, nothing where it is sound.

    Raises
    ------
    ExperimentError
        If a table is damaged, the two do not belong together, or a trial that is kept has other
        rows than they.

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
    table, timings = folder / ROWS, folder / TIMINGS
    if not (table.exists() or timings.exists()):
        return
    found: dict[Trial, list[Row]] = {}
    for row in _rows(table, timings, fault):
        found.setdefault(Trial(row["seed"], row["size"]), []).append(row)
    systems = list(dict.fromkeys(row["system"] for rows in found.values() for row in rows))
    for trial, rows in found.items():
        if wrong := incomplete([row["system"] for row in rows], systems):
            raise _unfit(table, f"the trial {trial.name} {wrong}")
        kept = read_trial(folder, trial)
        if kept is not None and [_known(row) for row in kept] != [_known(row) for row in rows]:
            raise ExperimentError(
                f"{table}: has other rows than {trial_file(folder, trial)}; delete {TRIALS} to go "
                f"on from the tables, or {ROWS} and {TIMINGS} to write them anew"
            )
    # Everything is read before anything is written: nothing of a damaged table is kept.
    for trial, rows in found.items():
        if not trial_file(folder, trial).exists():
            made = {key: str(rows[0][key]) for key in COLUMNS if rows[0].get(key) is not None}
            own = [{key: row[key] for key in row if key not in COLUMNS} for row in rows]
            write_trial(folder, trial, own, made=made)


def _known(row: Row) -> Row:
    """What a row says: a table has a cell for what other rows say, too."""
    return {key: value for key, value in row.items() if value is not None}


def _rows(table: Path, timings: Path, fault: Callable[[Row], str] | None) -> Iterator[Row]:
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
        if not all(is_time(row[key]) for key in row if is_timing(key)):
            raise _unfit(timings, f"line {number} has a time that is no number of seconds")
        if fault and (wrong := fault(row)):
            raise _unfit(table, f"line {number}: {wrong}")
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
