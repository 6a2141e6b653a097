"""What holds in a scene of things, in three values: surely, possibly, not at all.

Sets of things are whole numbers, a bit a thing, so that a condition is evaluated for all things at
once. Of every condition two sets are told: the things of which it surely holds, and those of which
it may hold.
"""

from __future__ import annotations

from collections.abc import Iterator
from enum import StrEnum
from typing import NamedTuple

from seewhy.data.thing_scene import ThingScene
from seewhy.dialogue.things import query
from seewhy.dialogue.things.geometry import between, distances
from seewhy.domain.things import Things
from seewhy.errors import SeeWhyError

__all__ = ["Evaluation", "Fits", "Obstacle", "UnclearReferenceError", "members"]


class Fits(NamedTuple):
    """The things of which something surely holds, and those of which it may."""

    surely: int
    maybe: int

    @property
    def known(self) -> bool:
        """Whether nothing is open."""
        return self.surely == self.maybe


class Obstacle(StrEnum):
    """Why a reference refers to no one thing."""

    NONE = "nothing is so"
    SEVERAL = "several are so"
    UNKNOWN = "it is not known which is so"


class UnclearReferenceError(SeeWhyError, LookupError):
    """A question speaks of the one thing that is so, and there is not one, or it is not known.

    ``fits`` are those that are so, or may be.
    """

    def __init__(self, reference: query.Reference, obstacle: Obstacle, fits: Fits) -> None:
        super().__init__(obstacle.value)
        self.reference = reference
        self.obstacle = obstacle
        self.fits = fits


def members(things: int) -> Iterator[int]:
    """Yield the numbers of a set of things.

    Examples
    --------
    >>> list(members(0b1011))
    [0, 1, 3]
    """
    while things:
        lowest = things & -things
        yield lowest.bit_length() - 1
        things ^= lowest


class Evaluation:
    """Evaluates conditions, descriptions and references in one scene.

    ``without`` are things that are taken as not there.

    Examples
    --------
    >>> from seewhy.data.thing_scene import thing_scene
    >>> from seewhy.domain.domain import load_domain
    >>> things = load_domain("tabletop").things
    >>> scene = thing_scene(things, [{"colour": "red"}, {"colour": None}], relations={})
    >>> Evaluation(scene, things).fits(query.Description((query.HasValue("colour", "red"),)))
    Fits(surely=1, maybe=3)
    """

    def __init__(self, scene: ThingScene, things: Things, *, without: int = 0) -> None:
        self.scene = scene
        self.things = things
        self.without = without
        self.everything = ((1 << scene.count) - 1) & ~without
        self.with_value: dict[str, dict[str, int]] = {}
        self.without_value: dict[str, int] = {}
        for feature, values in scene.values.items():
            sets: dict[str, int] = {}
            unknown = 0
            for number, value in enumerate(values):
                one = 1 << number & self.everything
                if value is None:
                    unknown |= one
                else:
                    sets[value] = sets.get(value, 0) | one
            self.with_value[feature] = sets
            self.without_value[feature] = unknown
        # By identity: what is asked again is asked of the same objects. They are kept here, so that
        # no others can come to have their identities.
        self._resolved: dict[int, tuple[query.Reference, int]] = {}
        self._held: dict[int, tuple[query.Condition, Fits]] = {}
        self._fitting: dict[int, tuple[query.Description, Fits]] = {}

    def fits(self, description: query.Description) -> Fits:
        """Return the things that fit a description.

        Raises
        ------
        UnclearReferenceError
            If it refers to a thing that is not there or not one.
        """
        known = self._fitting.get(id(description))
        if known is not None:
            return known[1]
        surely = maybe = self.everything
        for condition in description.conditions:
            found = self.holds(condition)
            surely &= found.surely
            maybe &= found.maybe
        fits = Fits(surely, maybe)
        if description.selection is not None:
            fits = self._selected(description, fits)
        self._fitting[id(description)] = (description, fits)
        return fits

    def the(self, reference: query.Reference) -> int:
        """Return the number of the one thing that is referred to.

        Raises
        ------
        UnclearReferenceError
            If none, several, or nobody knows which.
        """
        known = self._resolved.get(id(reference))
        if known is not None:
            return known[1]
        fits = self.fits(reference.description)
        if not fits.known:
            certain_several = fits.surely.bit_count() > 1
            obstacle = Obstacle.SEVERAL if certain_several else Obstacle.UNKNOWN
            raise UnclearReferenceError(reference, obstacle, fits)
        if fits.surely.bit_count() != 1:
            obstacle = Obstacle.SEVERAL if fits.surely else Obstacle.NONE
            raise UnclearReferenceError(reference, obstacle, fits)
        number = fits.surely.bit_length() - 1
        self._resolved[id(reference)] = (reference, number)
        return number

    def holds(self, condition: query.Condition) -> Fits:
        """Return the things of which a condition holds.

        Raises
        ------
        UnclearReferenceError
            If it refers to a thing that is not there or not one.
        """
        known = self._held.get(id(condition))
        if known is not None:
            return known[1]
        found = self._holds(condition)
        self._held[id(condition)] = (condition, found)
        return found

    def _holds(self, condition: query.Condition) -> Fits:
        match condition:
            case query.HasValue(feature=feature, value=value):
                surely = self.with_value[feature].get(value, 0)
                return Fits(surely, surely | self.without_value[feature])
            case query.Concluded(conclusion=conclusion):
                so = self.scene.concluded.get(conclusion, 0) & self.everything
                # Of a scene of which nothing was concluded, nothing is known.
                nothing = self.scene.conclusions is None
                unsettled = self.scene.unsettled & self.everything
                return Fits(so, self.everything if nothing else so | unsettled)
            case query.PartOf(group=group):
                so = 0
                for numbers in self.scene.groups.get(group, ()):
                    so |= sum(1 << number for number in numbers)
                return Fits(so, self.everything if self.scene.conclusions is None else so)
            case query.Related(to=to):
                return self._toward(to, condition)
            case query.Shares(other=to) | query.Compares(than=to) | query.Is(one=to):
                return self._toward(to, condition)
            case query.Apart(one=to):
                everything = Fits(self.everything, self.everything)
                return everything if to is None else self._toward(to, condition)
            case query.Between(first=first, second=second):
                return self._between(first, second)
            case query.Not(condition=inner):
                found = self.holds(inner)
                return Fits(self.everything & ~found.maybe, self.everything & ~found.surely)
            case query.All(conditions=inners):
                return self.fits(query.Description(inners))
            case query.AnyOf(conditions=inners):
                surely = maybe = 0
                for inner in inners:
                    found = self.holds(inner)
                    surely |= found.surely
                    maybe |= found.maybe
                return Fits(surely, maybe)
        raise TypeError(f"must be a condition, got {condition!r}")

    def toward(self, condition: query.Condition, number: int) -> Fits:
        """Return the things that stand to one thing as a condition says."""
        one = 1 << number
        others = self.everything & ~one
        match condition:
            case query.Related(relation=relation, inverse=True):
                return self._stands_to(relation, number)
            case query.Related(relation=relation):
                surely = self.scene.related[relation][number] & self.everything
                unknown = self.scene.unknown.get(relation)
                return Fits(surely, surely | unknown[number] & others if unknown else surely)
            case query.Shares(feature=feature):
                value = self.scene.values[feature][number]
                if value is None:
                    return Fits(0, others)
                alike = self.with_value[feature][value] & others
                return Fits(alike, alike | (self.without_value[feature] & others))
            case query.Compares(feature=feature, more=more):
                return self._compared(feature, number, more=more)
            case query.Apart():
                return Fits(others, others)
            case _:
                return Fits(one, one)

    def _stands_to(self, relation: str, number: int) -> Fits:
        """The things to which one stands in a relation."""
        unknown = self.scene.unknown.get(relation)
        surely = maybe = 0
        for other in members(self.everything & ~(1 << number)):
            related = self.scene.related[relation][other] >> number & 1
            surely |= related << other
            maybe |= (related | (unknown[other] >> number & 1 if unknown else 0)) << other
        return Fits(surely, maybe)

    def _toward(self, reference: query.Reference, condition: query.Condition) -> Fits:
        """What stands so to the thing, to some thing, or to every thing that is referred to."""
        if reference.which is query.References.THE:
            return self.toward(condition, self.the(reference))
        fits = self.fits(reference.description)
        if reference.which is query.References.SOME:
            surely = maybe = 0
            for number in members(fits.maybe):
                found = self.toward(condition, number)
                maybe |= found.maybe
                if fits.surely >> number & 1:
                    surely |= found.surely
            return Fits(surely, maybe)
        surely = maybe = self.everything
        for number in members(fits.maybe):
            found = self.toward(condition, number)
            itself = 1 << number  # nothing has to be left of itself to be left of all
            surely &= found.surely | itself
            if fits.surely >> number & 1:
                maybe &= found.maybe | itself
        # Where there are no others, nothing is so of them.
        alone = fits.maybe if fits.maybe.bit_count() == 1 else 0
        some = -1 if fits.maybe else 0
        return Fits(surely & ~alone & some, maybe & ~alone & some)

    def _compared(self, feature: str, number: int, *, more: bool) -> Fits:
        values = self.things.features[feature].values
        value = self.scene.values[feature][number]
        if value is None:
            maybe = self.everything & ~(1 << number)
            return Fits(0, maybe)
        at = values.index(value)
        further = values[at + 1 :] if more else values[:at]
        surely = 0
        for other in further:
            surely |= self.with_value[feature].get(other, 0)
        return Fits(surely, surely | self.without_value[feature] if further else surely)

    def _between(self, first: query.Reference, second: query.Reference) -> Fits:
        one, other = self.the(first), self.the(second)
        if self.scene.positions:
            found = between(self.scene.positions, one, other)
            return Fits(found, found)
        surely = maybe = 0
        for relation in self.things.relations.values():
            if relation.converse is None or relation.converse == relation.key:
                continue
            this = self.toward(query.Related(relation.key, first), one)
            that = self.toward(query.Related(relation.converse, second), other)
            surely |= this.surely & that.surely
            maybe |= this.maybe & that.maybe
        return Fits(surely, maybe)

    def _selected(self, description: query.Description, fits: Fits) -> Fits:
        reference = query.Reference(description)
        if not fits.known:
            raise UnclearReferenceError(reference, Obstacle.UNKNOWN, fits)
        match description.selection:
            case query.Extreme(relation=relation, rank=rank, from_end=from_end):
                chosen = self._in_order(fits.surely, relation, rank, from_end=from_end)
            case query.Corner(relations=relations):
                chosen = self._in_corner(fits.surely, relations)
            case query.Ranked(feature=feature, most=most):
                chosen = self._ranked(fits.surely, feature, most=most)
            case query.Nearest(to=to, farthest=farthest):
                chosen = self._nearest(fits.surely, self.the(to), farthest=farthest)
            case query.Fixed(number=number):
                chosen = fits.surely & 1 << number
            case query.Numbered(number=number):
                listed = list(members(fits.surely))
                at = number - 1 if number > 0 else number
                chosen = 1 << listed[at] if -len(listed) <= at < len(listed) else 0
            case _:
                chosen = fits.surely
        if chosen is None:
            raise UnclearReferenceError(reference, Obstacle.UNKNOWN, fits)
        return Fits(chosen, chosen)

    def _in_order(self, things: int, relation: str, rank: int, *, from_end: bool) -> int | None:
        """Those of which so many others come first; None where the order is not known."""
        others = things.bit_count() - 1
        wanted = others - (rank - 1) if from_end else rank - 1
        found = 0
        for number in members(things):
            before = self.before(things, relation, number)
            if before is None:
                return None
            found |= (before == wanted) << number
        return found

    def before(self, things: int, relation: str, number: int) -> int | None:
        """How many of some things stand in a relation to one; None where that is not known."""
        unknown = self.scene.unknown.get(relation)
        if unknown and unknown[number] & things:
            return None
        return (self.scene.related[relation][number] & things).bit_count()

    def _in_corner(self, things: int, relations: tuple[str, str]) -> int | None:
        best: tuple[int, int] | None = None
        found = 0
        for number in members(things):
            one, other = (self.before(things, relation, number) for relation in relations)
            if one is None or other is None:
                return None
            far = (max(one, other), one + other)
            if best is None or far < best:
                best, found = far, 0
            found |= (far == best) << number
        return found

    def _ranked(self, things: int, feature: str, *, most: bool) -> int | None:
        values = self.things.features[feature].values
        if things & self.without_value[feature]:
            return None
        for value in reversed(values) if most else values:
            found = things & self.with_value[feature].get(value, 0)
            if found:
                return found
        return 0

    def _nearest(self, things: int, to: int, *, farthest: bool) -> int | None:
        if not self.scene.positions:
            return None
        far = distances(self.scene.positions, to)
        others = [number for number in members(things) if number != to]
        if not others:
            return 0
        best = (max if farthest else min)(far[number] for number in others)
        return sum(1 << number for number in others if far[number] == best)
