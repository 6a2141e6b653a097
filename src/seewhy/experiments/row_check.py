"""Whether the rows of trials hold what pages and tests are made from."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from typing import Any

from seewhy.experiments.experiment import Measure, Row

__all__ = ["fault", "incomplete", "is_time"]


def fault(row: Row, measures: Sequence[Measure]) -> str:
    """Say what is wrong with a row of an experiment with some measures; nothing: "".

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
    for measure in measures:
        value: Any = row.get(measure.key)
        if type(value) not in (int, float) or not 0.0 <= value <= 1.0:
            return f"{measure.key} is {_said(value)}, not a share between 0 and 1"
    return ""


def incomplete(found: Sequence[str], systems: Iterable[str]) -> str:
    """Say what is wrong with the systems that a trial has rows of; nothing: "".

    Examples
    --------
    >>> incomplete(["a", "b"], ["a", "b"]), incomplete(["a", "a"], ["a", "b"])
    ('', "has several rows of 'a'")
    """
    for system in found:
        if found.count(system) > 1:
            return f"has several rows of '{system}'"
    missing = [system for system in systems if system not in found]
    return f"has no row of '{missing[0]}'" if missing else ""


def is_time(value: Any) -> bool:
    """Whether a value is a time in seconds, or None for one that was not taken."""
    return value is None or (type(value) in (int, float) and 0.0 <= value < math.inf)


def _said(value: Any) -> str:
    return "missing" if value is None else f"{value}"
