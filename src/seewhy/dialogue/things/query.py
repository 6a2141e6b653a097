"""What a question about things asks: a small algebra of descriptions, references and queries.

A description is a list of conditions; a reference is the one thing that a description fits, some
thing, or every one. Conditions speak of references, so that chains are of any length.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from enum import StrEnum

__all__ = [
    "All", "AnyOf", "Apart", "Between", "ClassIs", "CompareCounts", "CompareNumber", "Compares",
    "Completing", "Concluded", "Condition", "Consequence", "Corner", "Count", "CountDifference",
    "Describe", "Description", "Difference", "Exists", "Extreme", "Fixed", "Groups", "HasValue",
    "Holds", "Is", "Most", "MostCommon", "Nearest", "Not", "Numbered", "Occurring", "PartOf",
    "Query", "Ranked", "Reference", "References", "Related", "SameValue", "SharedByMost", "Shares",
    "Together", "ValueOf", "Which", "WhichClass", "references_in",
]  # fmt: skip


class References(StrEnum):
    """Which of the things that fit a description a reference means."""

    THE = "the"
    SOME = "some"
    EVERY = "every"


@dataclass(frozen=True)
class HasValue:
    """A thing has a value of a feature."""

    feature: str
    value: str
    noun: bool = False
    """Whether it was said as a noun; it is meant all the same."""


@dataclass(frozen=True)
class Concluded:
    """Axioms conclude something of a thing."""

    conclusion: str


@dataclass(frozen=True)
class PartOf:
    """A thing is one of several of which axioms conclude something together."""

    group: str


@dataclass(frozen=True)
class Related:
    """A thing stands in a relation to what is referred to; ``inverse``: that stands so to it."""

    relation: str
    to: Reference
    inverse: bool = False


@dataclass(frozen=True)
class Shares:
    """A thing other than that one has the same value of a feature."""

    feature: str
    other: Reference


@dataclass(frozen=True)
class Compares:
    """A thing has more (or less) of an ordered feature than another."""

    feature: str
    more: bool
    than: Reference


@dataclass(frozen=True)
class _OfTwo:
    """What is said or asked of two things."""

    first: Reference
    second: Reference


class Between(_OfTwo):
    """A thing is between two others."""


@dataclass(frozen=True)
class Apart:
    """A thing is another than that one; None: than the one that the question speaks of."""

    one: Reference | None


@dataclass(frozen=True)
class Is:
    """A thing is the one that is referred to."""

    one: Reference


@dataclass(frozen=True)
class Not:
    """A condition does not hold."""

    condition: Condition


@dataclass(frozen=True)
class _OfConditions:
    """What several conditions make together."""

    conditions: tuple[Condition, ...]


class All(_OfConditions):
    """Every one of some conditions holds."""


class AnyOf(_OfConditions):
    """At least one of some conditions holds."""


Condition = (
    HasValue
    | Concluded
    | PartOf
    | Related
    | Shares
    | Compares
    | Between
    | Apart
    | Is
    | Not
    | All
    | AnyOf
)


@dataclass(frozen=True)
class Extreme:
    """The one that comes first by a relation: to the left of the others of its description.

    ``rank`` counts from 1; ``from_end`` counts from the other end.
    """

    relation: str
    rank: int = 1
    from_end: bool = False


@dataclass(frozen=True)
class Corner:
    """The one that comes first by two relations at once: at the top and to the left.

    It is the one with the fewest others before it in the order in which it has more of them; of
    several such, the one with the fewest in both orders together.
    """

    relations: tuple[str, str]


@dataclass(frozen=True)
class Ranked:
    """The one with the most (or least) of an ordered feature."""

    feature: str
    most: bool


@dataclass(frozen=True)
class Nearest:
    """The one that is nearest to (or farthest from) another."""

    to: Reference
    farthest: bool = False


@dataclass(frozen=True)
class Numbered:
    """The one that has a number in the picture, from 1."""

    number: int


@dataclass(frozen=True)
class Fixed:
    """The thing that has a number in the scene, from 0, whatever comes to be so of it."""

    number: int


Selection = Extreme | Corner | Ranked | Nearest | Numbered | Fixed


@dataclass(frozen=True)
class Description:
    """What things may be like; with a selection, one of those that are so.

    ``many`` says whether the question speaks of several.
    """

    conditions: tuple[Condition, ...] = ()
    selection: Selection | None = None
    many: bool = False

    def also(self, *conditions: Condition) -> Description:
        """Return a description that asks for more."""
        return Description((*self.conditions, *conditions), self.selection, self.many)


@dataclass(frozen=True)
class Reference:
    """The thing, some thing or every thing of a description."""

    description: Description
    which: References = References.THE


@dataclass(frozen=True)
class _OfDescribed:
    """What is asked of the things that fit a description."""

    described: Description


class Count(_OfDescribed):
    """How many there are."""


@dataclass(frozen=True)
class Exists(_OfDescribed):
    """Whether there is one; with ``denied``, whether there is none."""

    denied: bool = False


class Which(_OfDescribed):
    """Which things they are."""


@dataclass(frozen=True)
class CompareCounts:
    """Whether there are as many (``=``), fewer (``<``) or more (``>``) of one than of another."""

    sign: str
    first: Description
    second: Description


@dataclass(frozen=True)
class CountDifference:
    """How many more (``>``) or fewer (``<``) there are of one than of another."""

    sign: str
    first: Description
    second: Description


@dataclass(frozen=True)
class Most(_OfDescribed):
    """Whether something is so of more than half of them."""

    condition: Condition


class SharedByMost(_OfDescribed):
    """Which values more than half of them have."""


@dataclass(frozen=True)
class MostCommon(_OfDescribed):
    """Which value of a feature most of them have, or of those that occur the fewest."""

    feature: str
    least: bool = False


@dataclass(frozen=True)
class Occurring(_OfDescribed):
    """Which values of a feature they have; with ``counted``, how many different ones."""

    feature: str
    counted: bool = False


@dataclass(frozen=True)
class CompareNumber:
    """Whether there are so many: ``=``, ``<``, ``>``, ``<=`` or ``>=`` a number."""

    sign: str
    described: Description
    number: int


@dataclass(frozen=True)
class ValueOf:
    """Which value of a feature a thing has."""

    feature: str
    one: Reference


@dataclass(frozen=True)
class SameValue:
    """Whether two things have the same value of a feature; ``denied``: different values."""

    feature: str
    first: Reference
    second: Reference
    denied: bool = False


@dataclass(frozen=True)
class Holds:
    """Whether something is so of each of some things."""

    ones: tuple[Reference, ...]
    condition: Condition


@dataclass(frozen=True)
class Describe:
    """What a thing is like; with ``place``, where it is."""

    one: Reference
    place: bool = False


@dataclass(frozen=True)
class Difference(_OfTwo):
    """In which features two things differ; with ``alike``, which they have in common."""

    alike: bool = False


@dataclass(frozen=True)
class Consequence:
    """What follows where a thing is taken away, or something else is so of it.

    ``to`` is the thing for which it is asked; None: for all of them.
    """

    one: Reference
    supposed: Condition | None = None
    to: Reference | None = None


@dataclass(frozen=True)
class Groups:
    """Groups of several things of which axioms conclude something: whether, how many, which."""

    group: str
    asks: str
    denied: bool = False


@dataclass(frozen=True)
class Together:
    """Whether some things are such a group; with ``denied``, whether they are none."""

    group: str
    ones: tuple[Reference, ...]
    denied: bool = False


@dataclass(frozen=True)
class Completing:
    """Which thing would make such a group with some others."""

    ones: tuple[Reference, ...]
    group: str = ""
    """Empty where the question does not name it: the only one that the domain has."""


@dataclass(frozen=True)
class ClassIs:
    """Whether the picture as a whole is of a class; with ``denied``, whether it is not."""

    label: str
    denied: bool = False


@dataclass(frozen=True)
class WhichClass:
    """Of which class the picture as a whole is."""


Query = (
    Count | Exists | Which | CompareCounts | CompareNumber | ValueOf | SameValue | Holds | Describe
    | Difference | Consequence | Groups | Together | Completing | CountDifference | Most
    | SharedByMost | MostCommon | Occurring | ClassIs | WhichClass
)  # fmt: skip


def references_in(condition: Condition) -> Iterator[Reference]:
    """Yield the references that a condition itself speaks of, in order."""
    match condition:
        case Related(to=one) | Shares(other=one) | Compares(than=one) | Is(one=one):
            yield one
        case Between(first=first, second=second):
            yield from (first, second)
        case Apart(one=one) if one is not None:
            yield one
        case Not(condition=inner):
            yield from references_in(inner)
        case All(conditions=inners) | AnyOf(conditions=inners):
            for inner in inners:
                yield from references_in(inner)
        case _:
            return
