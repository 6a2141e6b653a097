"""The ways to read the features of a picture, by name."""

from __future__ import annotations

from typing import Literal, get_args

from seewhy.errors import DomainError
from seewhy.text.nearest import did_you_mean

ReadingRule = Literal["argmax", "consistent", "with_class"]
"""How a picture's features are read; see :mod:`seewhy.agent.consistent_reading`."""

READINGS: tuple[ReadingRule, ...] = get_args(ReadingRule)


def reading_rule(name: str) -> ReadingRule:
    """Return the way of reading of a name.

    Raises
    ------
    DomainError
        If there is none.

    Examples
    --------
    >>> reading_rule("consistent")
    'consistent'
    """
    for rule in READINGS:
        if name == rule:
            return rule
    raise DomainError(f"'{name}' is no way to read features; {did_you_mean(name, READINGS)}")
