"""A planning problem without variables: operators with conditions and effects, as in STRIPS."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass

import clingo

__all__ = ["GroundProblem", "Literals", "Operator", "is_consistent"]

Literals = frozenset[int]
"""Literals that hold together; a fluent is its number, counted from 1, and -3 is 3 denied."""


@dataclass(frozen=True)
class Operator:
    """One way to do an action.

    Attributes
    ----------
    action : clingo.Symbol
    condition : literals that must hold before
    effects : pairs of a condition, besides, and the literal that holds afterwards
    """

    action: clingo.Symbol
    condition: Literals
    effects: tuple[tuple[Literals, int], ...]


@dataclass(frozen=True)
class GroundProblem:
    """Everything about a goal that may change, and how.

    Attributes
    ----------
    fluents : those that may change; fluent 1 is the first
    start : the fluents that hold at first
    operators : the ways to do actions
    derivations : the defined fluents with their conditions, those first on which others depend
    goals : one of these sets of literals must hold
    groups : sets of fluents of which exactly one holds
    open : the fluents that are unknown at first
    exclusive : sets of fluents, open ones among them, of which at most one holds
    untold : the defined fluents that may change and that no way to the goal asks about
    """

    fluents: tuple[clingo.Symbol, ...]
    start: frozenset[int]
    operators: tuple[Operator, ...]
    derivations: tuple[tuple[tuple[int, Literals], ...], ...]
    goals: tuple[Literals, ...]
    groups: tuple[frozenset[int], ...]
    open: frozenset[int] = frozenset()
    exclusive: tuple[frozenset[int], ...] = ()
    untold: frozenset[clingo.Symbol] = frozenset()


def is_consistent(literals: Collection[int]) -> bool:
    """Whether no literal is among them together with its denial.

    Examples
    --------
    >>> is_consistent({1, -2}), is_consistent({1, -1})
    (True, False)
    """
    return not any(-literal in literals for literal in literals)
