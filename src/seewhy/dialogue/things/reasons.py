"""Why an answer about things is as it is: a tree down to the things and what was seen of them."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from seewhy.dialogue.things.evaluating import Evaluation, members
from seewhy.dialogue.things.following import compared_numbers
from seewhy.dialogue.things.query import (
    All,
    AnyOf,
    ClassIs,
    CompareCounts,
    CompareNumber,
    Compares,
    Completing,
    Concluded,
    Condition,
    Consequence,
    Corner,
    Count,
    CountDifference,
    Describe,
    Description,
    Difference,
    Exists,
    Extreme,
    Fixed,
    Groups,
    HasValue,
    Holds,
    Is,
    Most,
    MostCommon,
    Nearest,
    Not,
    Occurring,
    PartOf,
    Query,
    Ranked,
    Reference,
    References,
    Related,
    SameValue,
    SharedByMost,
    Shares,
    Together,
    ValueOf,
    Which,
    WhichClass,
    references_in,
)
from seewhy.dialogue.things.reasons_following import (
    of_class,
    of_completing,
    of_consequence,
    of_groups,
    of_part,
    of_together,
    shortened,
    why_concluded,
)
from seewhy.dialogue.things.reasons_tallies import of_tally
from seewhy.dialogue.things.wording import ThingWords, number_word
from seewhy.domain.things import CONCLUDED
from seewhy.knowledge.justification import Basis, Node

__all__ = ["Reasons"]


class Reasons:
    """Builds the reasons of answers in one scene.

    Every description that a question refers to is justified once: which things fit it and what was
    seen of them, and of each other thing what is not so.
    """

    def __init__(self, evaluation: Evaluation, words: ThingWords) -> None:
        self.evaluation = evaluation
        self.words = words

    def tree(self, query: Query, text: str) -> Node:
        """Return the reasons of a query's answer, which is said as ``text``."""
        children: list[Node] = []
        told: dict[int, Reference] = {}
        for reference in _references(query):
            self._add_reference(reference, children, told)
        for description in _descriptions(query):
            self._add_referred(description.conditions, children, told)
            children += self._described(description)
        children += self._settling(query, children, told)
        return Node(_literal(query), text, Basis.JOINTLY, children=tuple(children))

    def judged(self, number: int, condition: Condition) -> Node:
        """Return whether a condition holds of a thing, down to what was seen."""
        return self._so(number, condition, self.words.name(number))

    def so(self, number: int, description: Description) -> list[str]:
        """Return what of a description holds of a thing, as clauses about "it"."""
        held = [c for c in description.conditions if self.evaluation.holds(c).surely >> number & 1]
        return [self._so(number, condition, "it").text for condition in held]

    def missing(self, number: int, description: Description) -> list[str]:
        """Return what of a description does not hold of a thing, as clauses about it."""
        lacked = [
            c for c in description.conditions if not self.evaluation.holds(c).surely >> number & 1
        ]
        name = self.words.name(number)
        return [
            self._so(number, condition, name if at == 0 else "it").text
            for at, condition in enumerate(lacked)
        ]

    def _add_reference(self, one: Reference, nodes: list[Node], told: dict[int, Reference]) -> None:
        """Add what a reference refers to, and first what that depends on; each once."""
        if id(one) in told:
            return
        told[id(one)] = one
        if isinstance(one.description.selection, Fixed):
            return  # it was found out before what was meant
        self._add_referred(one.description.conditions, nodes, told)
        if isinstance(one.description.selection, Nearest):
            self._add_reference(one.description.selection.to, nodes, told)
        children = tuple(self._described(one.description))
        if one.description.selection is not None and one.which is References.THE:
            chosen, *others = children
            children = (*chosen.children, *others)
        if one.which is References.THE:
            number = self.evaluation.the(one)
            name, phrase = self.words.name(number), self.words.phrase(one.description, many=False)
            text = (
                f"the {phrase} is {name}" if name != f"the {phrase}" else f"there is one {phrase}"
            )
            nodes.append(Node(self.words.term(number), text, Basis.JOINTLY, children=children))
            return
        count = self.evaluation.fits(one.description).surely.bit_count()
        verb = "is" if count == 1 else "are"
        text = f"there {verb} {self.words.counted(count, one.description)}"
        nodes.append(Node(self.words.reference(one), text, Basis.JOINTLY, children=children))

    def _add_referred(
        self, conditions: Sequence[Condition], nodes: list[Node], told: dict[int, Reference]
    ) -> None:
        for condition in conditions:
            for reference in references_in(condition):
                self._add_reference(reference, nodes, told)

    def _described(self, description: Description) -> Iterator[Node]:
        """The things that fit a description with what is so of each, and why no others do."""
        fits = self.evaluation.fits(description)
        for number in members(fits.surely):
            children = tuple(self._so(number, c, "it") for c in description.conditions)
            children += tuple(self._ordered(number, description, "it"))
            name = self.words.name(number)
            if description.selection is None or not children:
                yield Node(
                    self.words.term(number), f"there is {name}", Basis.JOINTLY, children=children
                )
            else:
                text = f"{name} is the {self.words.phrase(description, many=False)}"
                yield Node(self.words.term(number), text, Basis.COMPARISON, children=children)
        for number in members(fits.maybe & ~fits.surely):
            name = self.words.name(number)
            yield Node(
                self.words.term(number), f"of {name} it is not known", Basis.ABSENCE, holds=False
            )
        others = self.evaluation.everything & ~fits.maybe
        if not others or not (description.conditions or description.selection):
            return
        text = f"no other {self.evaluation.things.one} is"
        if not fits.surely:
            text = f"there is no {self.words.phrase(description, many=False)}"
        excluded = tuple(self.excluded(number, description) for number in members(others))
        yield Node("not", text, Basis.ABSENCE, children=excluded)

    def excluded(self, number: int, description: Description) -> Node:
        """Return the first condition of a description that a thing does not meet."""
        for condition in description.conditions:
            if not self.evaluation.holds(condition).maybe >> number & 1:
                return shortened(self._so(number, condition, self.words.name(number)))
        name = self.words.name(number)
        text = f"{name} is not the {self.words.phrase(description, many=False)}"
        ordered = tuple(self._ordered(number, description, "it"))
        return Node(self.words.term(number), text, Basis.COMPARISON, children=ordered)

    def _ordered(self, number: int, description: Description, subject: str) -> Iterator[Node]:
        """How many others come before a thing, or what it has, by what one is chosen."""
        match description.selection:
            case Ranked(feature=feature):
                yield self._seen(number, feature, None, subject)
                return
            case Extreme(relation=relation):
                relations: tuple[str, ...] = (relation,)
            case Corner(relations=relations):
                pass
            case _:
                return
        others = self.evaluation.fits(Description(description.conditions)).surely
        for relation in relations:
            count = self.evaluation.before(others, relation, number) or 0
            noun = self.words.phrase(Description(description.conditions), many=count > 1)
            before = f"{number_word(count) if count else 'no other'} {noun}"
            verb = "are" if count > 1 else "is"
            text = f"{before} {verb} {self.words.predicate_of(relation, subject)}"
            yield Node(f"{relation}({self.words.term(number)})", text, Basis.COMPARISON)

    def _so(self, number: int, condition: Condition, subject: str) -> Node:
        """Whether a condition holds of a thing, down to what was seen."""
        holds = bool(self.evaluation.holds(condition).surely >> number & 1)
        match condition:
            case HasValue(feature=feature, value=value):
                return self._seen(number, feature, value, subject)
            case Concluded(conclusion=conclusion):
                return why_concluded(conclusion, (number,), self.words, subject=subject)
            case PartOf(group=group):
                text = self._predicated(subject, condition, holds)
                children = tuple(of_part(group, number, self.words))
                return Node(
                    f"{self.words.term(number)}: {text}", text, Basis.JOINTLY, children=children
                )
            case Related(relation=relation, to=to, inverse=inverse) if to.which is References.THE:
                other = self.evaluation.the(to)
                if inverse:
                    return self._related(other, relation, number, self.words.name(other))
                return self._related(number, relation, other, subject)
            case Shares(feature=feature, other=one) | Compares(feature=feature, than=one) if (
                one.which is References.THE
            ):
                return self._compared(number, condition, feature, self.evaluation.the(one), subject)
            case Not(condition=inner):
                return self._so(number, inner, subject)
            case All(conditions=inners) if not holds:
                failing = next(
                    c for c in inners if not self.evaluation.holds(c).surely >> number & 1
                )
                return self._so(number, failing, subject)
            case AnyOf(conditions=inners) if holds:
                meeting = next(c for c in inners if self.evaluation.holds(c).surely >> number & 1)
                return self._so(number, meeting, subject)
            case All(conditions=inners) | AnyOf(conditions=inners):
                children = tuple(self._so(number, inner, "it") for inner in inners)
                text = self._predicated(subject, condition, holds)
                return Node(text, text, Basis.JOINTLY, children=children)
        text = self._predicated(subject, condition, holds)
        return Node(f"{self.words.term(number)}: {text}", text, Basis.COMPARISON)

    def _predicated(self, subject: str, condition: Condition, holds: bool) -> str:
        return f"{subject} is {'' if holds else 'not '}{self.words.predicate(condition)}"

    def _seen(self, number: int, feature: str, value: str | None, subject: str) -> Node:
        """What was seen of a feature, beside the value that is asked for."""
        actual = self.evaluation.scene.values[feature][number]
        term = self.words.term(number)
        name = self.evaluation.things.features[feature].name
        if actual is None:
            text = f"the {name} of {subject} is not known"
            return Node(f"{feature}({term})", text, Basis.ABSENCE)
        text = self.words.clause(feature, actual, subject)
        if value is not None and value != actual:
            text += self.words.denied(feature, value)
        yes_or_no = self.evaluation.things.features[feature].values == ("yes", "no")
        literal = f"{feature}({term},{actual})"
        if yes_or_no:
            literal = f"{'' if actual == 'yes' else '-'}{feature}({term})"
        return Node(literal, text, Basis.FEATURE, feature=f"{feature}({term})", value=actual)

    def _seen_of(self, number: int, feature: str) -> Node:
        return self._seen(number, feature, None, self.words.name(number))

    def _related(self, number: int, relation: str, to: int, subject: str) -> Node:
        related = self.evaluation.scene.related[relation][to] >> number & 1
        unknown = self.evaluation.scene.unknown.get(relation)
        concluded = self.evaluation.things.relations[relation].measure == CONCLUDED
        if concluded and number != to and self.evaluation.scene.conclusions is not None:
            return why_concluded(relation, (number, to), self.words, subject=subject)
        key = f"{relation}({self.words.term(number)},{self.words.term(to)})"
        other = self.words.name(to) if to != number else "itself"
        said = self.evaluation.things.relations[relation].say.format(subject, other)
        if unknown and unknown[to] >> number & 1:
            return Node(key, f"it is not known whether {said}", Basis.ABSENCE)
        if related:
            return Node(key, said, Basis.FEATURE, feature=key, value="yes")
        denied = said.replace(f"{subject} is ", f"{subject} is not ", 1)
        if denied == said:
            denied = f"it is not so that {said}"
        return Node(f"-{key}", denied, Basis.FEATURE, feature=key, value="no")

    def _compared(
        self, number: int, condition: Condition, feature: str, other: int, subject: str
    ) -> Node:
        holds = bool(self.evaluation.holds(condition).surely >> number & 1)
        text = (
            f"{subject} is that thing itself"
            if number == other
            else self._predicated(subject, condition, holds)
        )
        children = (
            self._seen(number, feature, None, "it"),
            self._seen(other, feature, None, self.words.name(other)),
        )
        literal = f"{feature}({self.words.term(number)}), {feature}({self.words.term(other)})"
        return Node(literal, text, Basis.COMPARISON, children=children)

    def _settling(
        self, query: Query, nodes: list[Node], told: dict[int, Reference]
    ) -> Iterator[Node]:
        """What was seen of the things themselves that a query asks about."""
        match query:
            case ValueOf(feature=feature, one=one):
                for number in self.numbers(one):
                    yield self._seen(number, feature, None, self.words.name(number))
            case SameValue(feature=feature):
                for number in compared_numbers(query, self.evaluation):
                    yield self._seen_of(number, feature)
            case Holds(ones=(kind,), condition=Is(one=only)) if kind.which is References.EVERY:
                self._add_referred((query.condition,), nodes, told)
                yield from self.besides(self.evaluation.the(only), kind.description)
            case Holds(ones=ones, condition=condition):
                self._add_referred((condition,), nodes, told)
                for reference in ones:
                    for number in self.numbers(reference):
                        yield self._so(number, condition, self.words.name(number))
            case Describe(one=one):
                for number in self.numbers(one):
                    for feature in self.evaluation.scene.values:
                        yield self._seen(number, feature, None, self.words.name(number))
            case Difference():
                for feature in self.evaluation.scene.values:
                    for number in compared_numbers(query, self.evaluation):
                        yield self._seen_of(number, feature)
            case Consequence():
                yield from of_consequence(query, self.words)
            case Most(described=described, condition=condition):
                self._add_referred((condition,), nodes, told)
                for number in members(self.evaluation.fits(described).surely):
                    yield self._so(number, condition, self.words.name(number))
            case MostCommon() | Occurring() | SharedByMost():
                yield from of_tally(query, self.words, self._seen_of)
            case Groups():
                yield from of_groups(query, self.words)
            case Together():
                yield from of_together(query, self.words)
            case Completing():
                yield from of_completing(query, self.words)
            case ClassIs() | WhichClass():
                yield from of_class(query, self.words)
            case _:
                return

    def besides(self, only: int, kind: Description) -> Iterator[Node]:
        """Why a thing is not the only one of a kind: it is none, or there are others, too."""
        fits = self.evaluation.fits(kind)
        if not fits.maybe >> only & 1:
            yield self.excluded(only, kind)
            return
        for number in members(fits.surely & ~(1 << only)):
            text = f"there is {self.words.name(number)}, too"
            children = tuple(self._so(number, condition, "it") for condition in kind.conditions)
            yield Node(self.words.term(number), text, Basis.JOINTLY, children=children)

    def numbers(self, one: Reference) -> list[int]:
        """Return the things that a reference surely means."""
        if one.which is References.THE:
            return [self.evaluation.the(one)]
        return list(members(self.evaluation.fits(one.description).surely))


def _descriptions(query: Query) -> tuple[Description, ...]:
    match query:
        case Count(described=one) | Exists(described=one) | Which(described=one):
            return (one,)
        case CompareNumber(described=one):
            return (one,)
        case (
            CompareCounts(first=first, second=second) | CountDifference(first=first, second=second)
        ):
            return (first, second)
        case Most(described=one) | SharedByMost(described=one) if one.conditions:
            return (one,)
        case MostCommon(described=one) | Occurring(described=one) if one.conditions:
            return (one,)
    return ()


def _references(query: Query) -> tuple[Reference, ...]:
    match query:
        case ValueOf(one=one) | Describe(one=one) | Consequence(one=one):
            return (one,)
        case SameValue(first=first, second=second) | Difference(first=first, second=second):
            return (first, second)
        case Holds(ones=ones):
            return ones
    return ()


def _literal(query: Query) -> str:
    """What is asked for, as one word of the algebra."""
    return type(query).__name__.lower()
