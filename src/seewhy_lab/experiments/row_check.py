"""Whether the rows of trials hold what pages and tests are made from."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

from seewhy_lab.experiments.experiment import Measure, Row

__all__ = ["fault", "is_time"]


def fault(row: Row, measures: Sequence[Measure]) -> str:
    """Say what is wrong with a row of an experiment with some measures; nothing: "".

    Every row has the first measure.

    Examples
    --------
    >>> measures = [Measure("accuracy", "classified rightly")]
    >>> fault({"trained": 9, "tested": 5, "accuracy": 0.5}, measures)
    ''
    >>> fault({"trained": 9, "tested": 5, "accuracy": 50}, measures)
    'accuracy is 50, not a share between 0 and 1'
    """
    for key in ("trained", "tested"):
        if type(row.get(key)) is not int or row[key] < 1:
            return f"{key} is {_said(row.get(key))}, not a number of pictures or scenes"
    for number, measure in enumerate(measures):
        value: Any = row.get(measure.key)
        if value is None and number:
            continue  # not every system is asked for all
        if type(value) not in (int, float) or not 0.0 <= value <= 1.0:
            return f"{measure.key} is {_said(value)}, not a share between 0 and 1"
    return ""


def is_time(value: Any) -> bool:
    """Whether a value is a time in seconds, or None for one that was not taken."""
    return value is None or (type(value) in (int, float) and 0.0 <= value < math.inf)


def _said(value: Any) -> str:
    return "missing" if value is None else f"{value}"
