"""The signature: which sorts and predicates a domain's knowledge may speak of."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import StrEnum


@dataclass(frozen=True, order=True)
class Location:
    """A place in a user's file; lines and columns count from 1.

    Examples
    --------
    >>> str(Location(file="knowledge.al", line=3, column=1))
    'knowledge.al:3:1'
    """

    file: str
    line: int
    column: int

    def __str__(self) -> str:
        return f"{self.file}:{self.line}:{self.column}"


class PredicateKind(StrEnum):
    """What a predicate stands for: something fixed, or something that changes or is done."""

    STATIC = "static"
    FLUENT_BASIC = "fluent basic"
    FLUENT_DEFINED = "fluent defined"
    ACTION = "action"
    EXOGENOUS_ACTION = "exogenous action"

    @property
    def is_fluent(self) -> bool:
        """Whether it may hold at one step and not at another."""
        return self in (PredicateKind.FLUENT_BASIC, PredicateKind.FLUENT_DEFINED)

    @property
    def is_action(self) -> bool:
        """Whether it is something that is done or happens."""
        return self in (PredicateKind.ACTION, PredicateKind.EXOGENOUS_ACTION)


@dataclass(frozen=True)
class Sort:
    """A named set of terms.

    ``members`` is None for the sort that stands for the scene itself: its only member is the
    picture at hand. So it is for one whose members are ``found``: they are the things that are
    found in the picture.
    """

    name: str
    members: tuple[str, ...] | None
    location: Location
    found: bool = False


@dataclass(frozen=True)
class Predicate:
    """A declared predicate with the sorts of its arguments."""

    name: str
    sorts: tuple[str, ...]
    kind: PredicateKind
    location: Location

    def __str__(self) -> str:
        return f"{self.name}({', '.join(self.sorts)})" if self.sorts else self.name


@dataclass(frozen=True)
class Signature:
    """The sorts and predicates of a domain (Riley and Sridharan 2019, section 3.2).

    Departure from the paper: statics that a picture's features determine are ordinary statics
    of the scene sort; there are no separate attribute functions.
    """

    sorts: Mapping[str, Sort] = field(default_factory=dict)
    predicates: Mapping[str, Predicate] = field(default_factory=dict)

    def kind(self, predicate: str) -> PredicateKind:
        """Return what a predicate stands for; a sort used as a predicate is something fixed."""
        declared = self.predicates.get(predicate)
        return PredicateKind.STATIC if declared is None else declared.kind

    def changes(self, predicate: str) -> bool:
        """Whether a predicate has to do with change: whether it is a fluent or an action."""
        return self.kind(predicate) is not PredicateKind.STATIC

    def members(self, sort: str) -> tuple[str, ...]:
        """Return the members of ``sort``; empty for the sort of the scene."""
        return self.sorts[sort].members or ()
