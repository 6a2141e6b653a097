"""What a rule asks of a scene: patterns of one to three things, counts, and that there is none."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from itertools import permutations

__all__ = [
    "MOST_THINGS",
    "Alike",
    "Alone",
    "Atom",
    "Condition",
    "Grouped",
    "HasValue",
    "Pattern",
    "Related",
    "There",
    "ThingRule",
    "Whole",
    "is_expressible",
]

MOST_THINGS = 3
"""So many things a pattern has at most: an axiom has an instance for each choice of them."""


@dataclass(frozen=True)
class HasValue:
    """A thing has a value of a feature; with ``holds`` False it has another one.

    What axioms conclude of a thing has the values yes and no.
    """

    thing: int
    feature: str
    value: str
    holds: bool = True

    @property
    def things(self) -> tuple[int, ...]:
        """The places, in the pattern, of the things that it speaks of."""
        return (self.thing,)

    def renamed(self, places: Mapping[int, int]) -> HasValue:
        """Return the same of the things at other places."""
        return HasValue(places[self.thing], self.feature, self.value, self.holds)


@dataclass(frozen=True)
class Alone:
    """No thing stands in a relation to a thing; with ``inverse``, it stands in it to none."""

    thing: int
    relation: str
    inverse: bool = False

    @property
    def things(self) -> tuple[int, ...]:
        """As of :class:`HasValue`."""
        return (self.thing,)

    def renamed(self, places: Mapping[int, int]) -> Alone:
        """As of :class:`HasValue`."""
        return Alone(places[self.thing], self.relation, self.inverse)


@dataclass(frozen=True)
class Related:
    """A thing stands in a relation to another."""

    thing: int
    other: int
    relation: str

    @property
    def things(self) -> tuple[int, ...]:
        """As of :class:`HasValue`."""
        return (self.thing, self.other)

    def renamed(self, places: Mapping[int, int]) -> Related:
        """As of :class:`HasValue`."""
        return Related(places[self.thing], places[self.other], self.relation)


@dataclass(frozen=True)
class Alike:
    """Two things have the same value of a feature; with ``holds`` False, two different ones."""

    thing: int
    other: int
    feature: str
    holds: bool = True

    @property
    def things(self) -> tuple[int, ...]:
        """As of :class:`HasValue`."""
        return (self.thing, self.other)

    def renamed(self, places: Mapping[int, int]) -> Alike:
        """As of :class:`HasValue`."""
        thing, other = sorted((places[self.thing], places[self.other]))
        return Alike(thing, other, self.feature, self.holds)


@dataclass(frozen=True)
class Grouped:
    """Axioms conclude something of so many things together, in whatever order."""

    things: tuple[int, ...]
    group: str

    def renamed(self, places: Mapping[int, int]) -> Grouped:
        """As of :class:`HasValue`."""
        return Grouped(tuple(sorted(places[thing] for thing in self.things)), self.group)


Atom = HasValue | Alone | Related | Alike | Grouped
"""What is asked of one thing of a pattern, or of several together."""


@lru_cache(maxsize=1 << 14)
def _at(atom: Atom, order: tuple[int, ...]) -> tuple[tuple[str, ...], Atom]:
    """An atom of the things at other places, and what it is sorted by."""
    renamed = atom.renamed(dict(enumerate(order)))
    return (str(renamed.things), type(renamed).__name__, repr(renamed)), renamed


@dataclass(frozen=True)
class Pattern:
    """Different things, and what is asked of them.

    Attributes
    ----------
    things : int
        How many; they are called by their places 0, 1, 2.
    atoms : tuple of Atom
        In an order of their own, so that equal patterns made by :meth:`of` are equal.

    Examples
    --------
    >>> red, ball = HasValue(0, "colour", "red"), HasValue(1, "shape", "ball")
    >>> other_way = [atom.renamed({0: 1, 1: 0}) for atom in (ball, red)]
    >>> Pattern.of(2, [red, ball]) == Pattern.of(2, other_way)
    True
    """

    things: int
    atoms: tuple[Atom, ...]

    @staticmethod
    def of(things: int, atoms: Sequence[Atom]) -> Pattern:
        """Return the pattern of some atoms, whatever the order of things and atoms."""
        forms = (
            dict(sorted(_at(atom, order) for atom in atoms))
            for order in permutations(range(things))
        )
        return Pattern(things, tuple(min(forms, key=list).values()))

    def without(self, atom: Atom) -> Pattern | None:
        """Return the pattern without an atom; None where a thing would have nothing to do in it.

        Examples
        --------
        >>> red = HasValue(0, "colour", "red")
        >>> Pattern.of(1, [red]).without(red) is None
        True
        """
        kept = [other for other in self.atoms if other != atom]
        named = sorted({thing for other in kept for thing in other.things})
        if not named:
            return None
        places = {thing: place for place, thing in enumerate(named)}
        shorter = Pattern.of(len(named), [other.renamed(places) for other in kept])
        return shorter if shorter.is_connected else None

    @property
    def is_connected(self) -> bool:
        """Whether atoms about several things join all things of the pattern."""
        reached = {0}
        for _ in range(self.things):
            for atom in self.atoms:
                if reached & set(atom.things):
                    reached |= set(atom.things)
        return len(reached) == self.things


@dataclass(frozen=True)
class There:
    """There are things as in a pattern; with ``holds`` False there are none, or not so many.

    ``least`` is how many there are at least, of a pattern of one thing.
    """

    pattern: Pattern
    least: int = 1
    holds: bool = True

    @property
    def literals(self) -> int:
        """How much is asked: the atoms of the pattern, and the number where it is counted."""
        return max(1, len(self.pattern.atoms)) + (self.least > 1)

    @property
    def denied(self) -> There:
        """The opposite."""
        return There(self.pattern, self.least, not self.holds)


@dataclass(frozen=True)
class Whole:
    """The picture as a whole has a value of a feature; with ``holds`` False it has another one."""

    feature: str
    value: str
    holds: bool = True

    @property
    def literals(self) -> int:
        """As of :class:`There`."""
        return 1

    @property
    def denied(self) -> Whole:
        """The opposite."""
        return Whole(self.feature, self.value, not self.holds)


Condition = There | Whole
"""What a rule asks of a scene."""


@dataclass(frozen=True)
class ThingRule:
    """Scenes in which all conditions hold are of a class.

    Attributes
    ----------
    label : str
    conditions : tuple of Condition
    unless : tuple of str
        Other classes, of which a scene must not be believed to be: what is none of them is of this
        class.
    """

    label: str
    conditions: tuple[Condition, ...]
    unless: tuple[str, ...] = ()

    @property
    def literals(self) -> int:
        """How much is asked in all."""
        return sum(condition.literals for condition in self.conditions)


def is_expressible(conditions: Sequence[Condition]) -> bool:
    """Whether the knowledge language can say the conditions in one axiom.

    That nothing stands in a relation to a thing is a count, and there is no count in a count; and
    an axiom has variables for three things.

    Examples
    --------
    >>> alone = There(Pattern.of(1, [Alone(0, "on")]))
    >>> is_expressible([alone]), is_expressible([alone.denied])
    (True, False)
    """
    alone = [
        condition
        for condition in conditions
        if isinstance(condition, There)
        and any(isinstance(atom, Alone) for atom in condition.pattern.atoms)
    ]
    things = sum(condition.pattern.things for condition in alone)
    return things <= MOST_THINGS and all(
        condition.holds and condition.least == 1 for condition in alone
    )
