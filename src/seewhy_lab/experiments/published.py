"""Tables that were published without the trials' files, taken up as finished trials."""

from __future__ import annotations

import csv
from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple

from seewhy.errors import ExperimentError
from seewhy_lab.experiments.experiment import Row, Trial
from seewhy_lab.experiments.origin import COLUMNS
from seewhy_lab.experiments.row_check import is_time
from seewhy_lab.experiments.rows import (
    ROWS,
    TIMINGS,
    is_timing,
    read_trial,
    trial_file,
    write_trial,
)

__all__ = ["take_up"]

_Key = tuple[Trial, str]
"""A trial and a system."""


class _Line(NamedTuple):
    """A line of a table, by its number."""

    number: int
    row: Row


def take_up(folder: Path, *, fault: Callable[[Row], str] | None = None) -> None:
    """Write the trials that only the tables of an experiment have.

    What is committed, or handed on, of an experiment are its tables: whoever has these goes on
    from them, on a machine of another kind too. Of a trial that has a file the tables may lack some
    or all: they are written after it, one after the other.

    Parameters
    ----------
    folder : Path
        The folder of an experiment.
    fault : callable, optional
        Says what is wrong with a row, nothing where it is sound.

    Raises
    ------
    ExperimentError
        If a table is damaged, the two do not belong together, or a trial that has a file is another
        there.

    Examples
    --------
    >>> import tempfile
    >>> from seewhy_lab.experiments.rows import read_trial, write_table
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
    results, times = _lines(table), _lines(timings)
    systems = list(dict.fromkeys(system for _, system in (*results, *times)))
    taken: dict[Trial, list[Row]] = {}
    for trial in dict.fromkeys(trial for trial, _ in (*results, *times)):
        kept = read_trial(folder, trial)
        if kept is None:
            taken[trial] = list(_rows(folder, trial, systems, results, times, fault))
        elif any(
            _differs(lines.get((trial, str(row["system"]))), row)
            for row in kept
            for lines in (results, times)
        ):
            raise ExperimentError(
                f"{table}: {ROWS} or {TIMINGS} has other numbers than "
                f"{trial_file(folder, trial)}; delete that file to go on from the tables, or take "
                "its lines out of both tables to keep it"
            )
    # Everything is read before anything is written: nothing of a damaged table is kept.
    for trial, rows in taken.items():
        made = {key: str(rows[0][key]) for key in COLUMNS if rows[0].get(key) is not None}
        measured = [{key: row[key] for key in row if key not in COLUMNS} for row in rows]
        write_trial(folder, trial, measured, made=made)


def _differs(line: _Line | None, row: Row) -> bool:
    """Whether a line of a table, if there is one, says otherwise than a row of a trial's file."""
    return line is not None and any(
        value != row.get(key) for key, value in line.row.items() if value is not None
    )


def _rows(
    folder: Path,
    trial: Trial,
    systems: Sequence[str],
    results: Mapping[_Key, _Line],
    times: Mapping[_Key, _Line],
    fault: Callable[[Row], str] | None,
) -> Iterator[Row]:
    """The rows of a trial that only the tables have, each put together of its two lines."""
    table, timings = folder / ROWS, folder / TIMINGS
    for system in systems:
        for file, lines in ((table, results), (timings, times)):
            if (trial, system) not in lines:
                raise _unfit(file, f"has no line of '{system}' in the trial {trial.name}")
        result, time = results[trial, system], times[trial, system]
        if not all(is_time(time.row[key]) for key in time.row if is_timing(key)):
            raise _unfit(timings, f"line {time.number} has a time that is no number of seconds")
        row = result.row | time.row
        if fault and (wrong := fault(row)):
            raise _unfit(table, f"line {result.number}: {wrong}")
        yield row


def _lines(table: Path) -> dict[_Key, _Line]:
    """The lines of a table; none where it is missing."""
    try:
        with table.open(encoding="utf-8", newline="") as stream:
            lines: list[dict[Any, Any]] = list(csv.DictReader(stream, strict=True))
    except FileNotFoundError:
        return {}
    except (UnicodeDecodeError, csv.Error):
        raise _unfit(table, "is no table") from None
    found: dict[_Key, _Line] = {}
    for number, line in enumerate(lines, start=2):
        if None in line or None in line.values():
            raise _unfit(table, f"line {number} has not as many columns as the first")
        row = {key: _value(text) for key, text in line.items()} | {"system": line.get("system")}
        if not (_is_count(row.get("seed")) and _is_count(row.get("size")) and row["system"]):
            raise _unfit(table, f"line {number} does not say its seed, size, and system")
        key = Trial(row["seed"], row["size"]), str(row["system"])
        if key in found:
            raise _unfit(table, f"line {number} is of the same trial and system as another")
        found[key] = _Line(number, row)
    return found


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
        f"{table}: {what}; put {ROWS} and {TIMINGS} back as they were written, or delete both: "
        "trials that have no file are then run again"
    )
