"""Attributes of a whole that one of its parts holds, so that the whole need not repeat them."""

from __future__ import annotations

from dataclasses import replace
from typing import Any, Generic, Never, TypeVar, cast

__all__ = ["Follows", "Held"]

Value = TypeVar("Value")


class _OfPart(Generic[Value]):
    """An attribute of an object that is one of the part in the attribute called ``part``."""

    def __init__(self, part: str) -> None:
        self.part = part

    def __set_name__(self, owner: type, name: str) -> None:
        self.name = name

    def __get__(self, whole: Any, owner: type | None = None) -> Value:
        found = self if whole is None else getattr(getattr(whole, self.part), self.name)
        return cast(Value, found)


class Held(_OfPart[Value]):
    """An attribute that a part of the object has; where it is set, another part takes the place.

    Parts are frozen dataclasses, so that two objects can have one in common.

    Examples
    --------
    >>> from dataclasses import dataclass
    >>> @dataclass(frozen=True)
    ... class Engine:
    ...     power: float
    >>> class Car:
    ...     power = Held[float]("engine")
    ...     def __init__(self, engine):
    ...         self.engine = engine
    >>> engine = Engine(50.0)
    >>> car = Car(engine)
    >>> car.power = 60.0
    >>> car.engine, engine
    (Engine(power=60.0), Engine(power=50.0))
    """

    def __set__(self, whole: Any, value: Value) -> None:
        setattr(whole, self.part, replace(getattr(whole, self.part), **{self.name: value}))


class Follows(_OfPart[Value]):
    """An attribute that a part of the object has and that follows from others: it cannot be set."""

    def __set__(self, whole: Any, value: Never) -> None:
        raise AttributeError(f"'{self.name}' follows from other attributes and cannot be set")
