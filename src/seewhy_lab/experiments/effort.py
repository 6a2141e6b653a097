"""What it takes to reach an accuracy: training pictures, and time."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from seewhy_lab.experiments.conclusions import values_of
from seewhy_lab.experiments.experiment import Row
from seewhy_lab.experiments.origin import one_machine
from seewhy_lab.experiments.rows import is_timing

__all__ = ["Effort", "efforts", "reached", "training_parts"]

LEVELS = (0.7, 0.8, 0.85, 0.9, 0.95)


@dataclass(frozen=True)
class Effort:
    """What a system needs until the mean of a measure reaches a level; None: it never does.

    ``pictures`` and ``seconds`` (of one processor, in training) lie on the line between the sizes
    before and after; where the first size reaches the level already, they are that size's. Seconds
    are None, too, where no trial of one of these sizes was timed.
    """

    system: str
    level: float
    pictures: float | None
    seconds: float | None


def efforts(rows: Sequence[Row], systems: Sequence[str], measure: str) -> list[Effort]:
    """What every system needs for every level that some system reaches and some size does not.

    Pictures are those of all trials, seconds those of the trials of one kind of machine.
    """
    timed, _ = one_machine(rows)
    curves = {system: _curve(rows, timed, system, measure) for system in systems}
    found = []
    for level in LEVELS:
        means = [point[1] for curve in curves.values() for point in curve]
        if not means or max(means) < level or min(means) >= level:
            continue
        for system, curve in curves.items():
            there = next((n for n, point in enumerate(curve) if point[1] >= level), len(curve))
            sides = curve[max(0, there - 1) : there + 1]
            times = [(point[2], point[1]) for point in sides if point[2] is not None]
            pictures = reached([(point[0], point[1]) for point in sides], level)
            seconds = reached(times, level) if len(times) == len(sides) else None
            found.append(Effort(system, level, pictures, seconds))
    return found


def training_parts(rows: Sequence[Row]) -> list[str]:
    """Name what was timed of training, in the order of the rows.

    Examples
    --------
    >>> training_parts([{"seconds_networks": 9.0, "seconds_answers": 2.0, "seconds_test": 1.0}])
    ['networks', 'answers']
    """
    columns = dict.fromkeys(key for row in rows for key in row if _is_training(key))
    return [key.removeprefix("seconds_") for key in columns]


def _is_training(column: str) -> bool:
    return is_timing(column) and column != "seconds_test"


def _curve(
    rows: Sequence[Row], timed: Sequence[Row], system: str, measure: str
) -> list[tuple[float, float, float | None]]:
    """Pictures, mean of the measure, mean seconds of training; size by size."""
    curve: list[tuple[float, float, float | None]] = []
    timings = {key for row in timed for key in row if row["system"] == system and _is_training(key)}
    for size in dict.fromkeys(row["size"] for row in rows):
        values = values_of(rows, system, size, measure)
        at_size = [row for row in rows if row["system"] == system and row["size"] == size]
        if not values:
            continue
        spent = [
            sum(row[key] for key in timings)
            for row in timed
            if row["system"] == system
            and row["size"] == size
            # A part that was not timed did not take nothing.
            and timings
            and all(row.get(key) is not None for key in timings)
        ]
        curve.append(
            (
                float(np.mean([row["trained"] for row in at_size])),
                float(np.mean(list(values.values()))),
                float(np.mean(spent)) if spent else None,
            )
        )
    return sorted(curve)


def reached(curve: Sequence[tuple[float, float]], level: float) -> float | None:
    """Where a line through (cost, value) points first reaches a level.

    Examples
    --------
    >>> reached([(100, 0.6), (200, 0.8), (400, 0.9)], 0.85)
    300.0
    >>> reached([(100, 0.6)], 0.5), reached([(100, 0.6)], 0.7)
    (100, None)
    """
    before: tuple[float, float] | None = None
    for cost, value in curve:
        if value >= level:
            if before is None:
                return cost
            share = (level - before[1]) / (value - before[1])
            return round(before[0] + share * (cost - before[0]), 9)
        before = cost, value
    return None
