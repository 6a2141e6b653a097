"""The signature: which sorts and predicates a domain's knowledge may speak of."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import StrEnum
from functools import cached_property


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
    picture at hand. ``of_things`` says that the members are things that may be found in a picture
    or not, so that being one of them is itself something to believe; how many there may be is
    said by the domain, and until then they are None, too.
    """

    name: str
    members: tuple[str, ...] | None
    location: Location
    of_things: bool = False


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

    @property
    def sort_of_things(self) -> Sort | None:
        """The sort of the things that are found in pictures, if there is one."""
        return next((sort for sort in self.sorts.values() if sort.of_things), None)

    def is_given(self, name: str) -> bool:
        """Whether a name is that of a sort whose members are the same in every picture."""
        return name in self.sorts and not self.sorts[name].of_things

    @property
    def given_sorts(self) -> frozenset[str]:
        """The sorts whose members are the same in every picture."""
        return frozenset(filter(self.is_given, self.sorts))

    def argument_sorts(self, name: str) -> tuple[str, ...]:
        """Return the sorts of the arguments of a predicate, or of a sort used as one."""
        return (name,) if name in self.sorts else self.predicates[name].sorts

    @cached_property
    def fluents(self) -> frozenset[str]:
        """The predicates that are fluents."""
        return frozenset(
            name for name, predicate in self.predicates.items() if predicate.kind.is_fluent
        )

    def members(self, sort: str) -> tuple[str, ...]:
        """Return the members of ``sort``; empty for the sort of the scene."""
        return self.sorts[sort].members or ()
