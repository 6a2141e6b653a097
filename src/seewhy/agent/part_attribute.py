"""Attributes of an agent that one of its parts holds: one line each, where they can be set."""

from __future__ import annotations

from dataclasses import replace
from operator import attrgetter
from typing import Any

__all__ = ["part_attribute"]


def part_attribute(path: str) -> Any:
    """Return a property that is an attribute of a part, as in "settings.seed".

    Parts are frozen dataclasses, so that two objects can have one in common: where the attribute is
    set, another part takes the place.

    Examples
    --------
    >>> from dataclasses import dataclass
    >>> @dataclass(frozen=True)
    ... class Engine:
    ...     power: float
    >>> class Car:
    ...     power: float = part_attribute("engine.power")
    ...     def __init__(self, engine):
    ...         self.engine = engine
    >>> engine = Engine(50.0)
    >>> car = Car(engine)
    >>> car.power = 60.0
    >>> car.engine, engine
    (Engine(power=60.0), Engine(power=50.0))
    """
    part, name = path.split(".")

    def put(whole: Any, value: Any) -> None:
        setattr(whole, part, replace(getattr(whole, part), **{name: value}))

    return property(attrgetter(path), put)
