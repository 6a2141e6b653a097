"""A reason in words, "it is unstable because a ball lies on a box", as a rule about things."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from seewhy.dialogue.things import query as asked
from seewhy.dialogue.things.reading import QuestionReader
from seewhy.domain.domain import Domain
from seewhy.domain.things import Things
from seewhy.errors import QuestionError
from seewhy.induction.things.conditions import (
    MOST_THINGS,
    Alike,
    Alone,
    Atom,
    Condition,
    Grouped,
    HasValue,
    Pattern,
    Related,
    There,
    ThingRule,
    Whole,
    is_expressible,
)
from seewhy.text.nouns import with_article

__all__ = ["class_named", "example_of_a_reason", "gives_reason", "rule_of_reason"]

_BECAUSE = re.compile(r"\s*\bbecause\b(?:\s+of\b)?\s*", re.IGNORECASE)
_NO = re.compile(r"^\s*(?:no|nope|wrong|but)\b[\s,;:.!–-]*", re.IGNORECASE)
_AND = re.compile(r"\s*,?\s+and\s+|\s*,\s*(?:but\s+)?|\s+but\s+")
_SHOWS = re.compile(r"^(?:it|this|that|the \w+) (?:has|have|shows?|contains?) ")
_VERB = re.compile(r"\b(is|are|was|were)\b")
_EXACTLY = re.compile(r"\b(?:exactly|just|precisely|only)\b")
_ANYTHING = re.compile(r"\b(?:something|anything)\b")
_NOTHING = re.compile(r"^(no) (.+?) (is|are|lies|lie|stands|stand) (.+)$")


class _NotSaidError(Exception):
    """What a query asks cannot be a condition of a rule."""


def gives_reason(text: str) -> bool:
    """Whether a text says why.

    Examples
    --------
    >>> gives_reason("it is tidy because there is no ball"), gives_reason("why is it tidy?")
    (True, False)
    """
    parts = _BECAUSE.split(text.strip(), maxsplit=1)
    return len(parts) == 2 and all(parts) and not text.rstrip().endswith("?")


def class_named(domain: Domain, text: str) -> str | None:
    """Return the class that "it is CLASS" names; None where it names none, or two.

    Examples
    --------
    >>> from seewhy.domain.domain import load_domain
    >>> class_named(load_domain("structure_stability"), "No, it is unstable")
    'unstable'
    """
    said = " ".join(_NO.sub("", text.casefold()).strip(" .!").split())
    found: dict[str, int] = {}
    for key, scene_class in domain.classes.items():
        for word in (scene_class.say, *scene_class.words):
            if re.search(rf"\b(?:is|are|be) (?:an? |the )?{re.escape(word.casefold())}$", said):
                found[key] = max(len(word), found.get(key, 0))
        for verb in scene_class.verbs:
            if re.search(rf"\b{re.escape(verb.casefold())}(?:s|es)?$", said):
                found[key] = max(len(verb), found.get(key, 0))
    longest = max(found.values(), default=0)
    named = [key for key, length in found.items() if length == longest]
    return named[0] if len(named) == 1 else None


def example_of_a_reason(domain: Domain, label: str | None = None) -> str:
    """Return what somebody may say of a domain's pictures; empty where it has no classes.

    Examples
    --------
    >>> from seewhy.domain.domain import load_domain
    >>> example_of_a_reason(load_domain("tabletop"))
    ''
    """
    things = domain.things
    assert things is not None, "the domain has no things"
    if not domain.classes:
        return ""
    said = domain.classes[label or next(iter(domain.classes))].say
    for feature in things.features.values():
        for value in feature.values:
            if feature.words[value] and not feature.nouns[value] and value not in feature.behind:
                shown = with_article(f"{feature.words[value][0]} {things.one}")
                return f"it is {said} because there is {shown}"
    return f"it is {said} because there are two {things.many}"


def rule_of_reason(domain: Domain, text: str) -> ThingRule:
    """Return the rule that a sentence with "because" states, in the words of the domain.

    Raises
    ------
    QuestionError
        If it names no class, or a part of the reason is not understood, or is no condition that a
        rule can have.

    Examples
    --------
    >>> from dataclasses import replace
    >>> from seewhy.domain.domain import load_domain
    >>> from seewhy.domain.scene_class import SceneClass
    >>> from seewhy.knowledge.axiom import Literal
    >>> good = SceneClass("good", Literal("good", ("picture",)), "good", ("good",))
    >>> domain = replace(load_domain("tabletop"), classes={"good": good})
    >>> rule = rule_of_reason(domain, "it is good because there are at least two red things")
    >>> rule.label, rule.conditions[0].least, rule.conditions[0].pattern.atoms
    ('good', 2, (HasValue(thing=0, feature='colour', value='red', holds=True),))
    """
    said, _, reason = _BECAUSE.sub(" because ", text.strip(), count=1).partition(" because ")
    label = class_named(domain, said)
    if label is None:
        classes = " or ".join(each.say for each in list(domain.classes.values())[:3])
        raise QuestionError(
            f"'{' '.join(said.split())}' names no class, and a rule concludes one; say for "
            f"instance 'it is {classes} because …'"
        )
    conditions = tuple(_conditions(domain, reason.strip(" .!")))
    things = sum(each.pattern.things for each in conditions if isinstance(each, There))
    if things > MOST_THINGS or not is_expressible(conditions):
        raise QuestionError(
            f"a rule speaks of {MOST_THINGS} things at most, got '{' '.join(reason.split())}'; "
            "leave something out"
        )
    return ThingRule(label, conditions)


def _conditions(domain: Domain, text: str) -> Sequence[Condition]:
    """What a reason asks; of several, each by itself, where they are not understood as one."""
    text = " ".join(text.split())
    whole = _of_the_whole(domain, text)
    if whole is not None:
        return (whole,)
    assert domain.things is not None, "the domain has no things"
    reader = QuestionReader(domain.things)
    # Two red balls are two at least, unless somebody says that they are no more.
    just = _EXACTLY.search(text.casefold()) is not None
    no_condition = False
    for question in _questions(_ANYTHING.sub(f"a {domain.things.one}", text)):
        try:
            for reading in reader.readings(question):
                try:
                    return _of_query(reading.query, domain.things, just=just)
                except _NotSaidError:
                    no_condition = True
        except QuestionError:
            continue
    parts = [part for part in _AND.split(text) if part]
    if len(parts) > 1:
        return [condition for part in parts for condition in _conditions(domain, part)]
    if no_condition:
        raise QuestionError(
            f"'{text}' is no condition that a rule can have; say what there is, how many, or what "
            f"there is not, as in '{example_of_a_reason(domain)}'"
        )
    raise QuestionError(
        f"'{text}' is not understood as a reason; say for instance '{example_of_a_reason(domain)}'"
    )


def _questions(text: str) -> Iterator[str]:
    """The questions whether a statement is so, the most natural first."""
    said = _SHOWS.sub("there is ", text.casefold())
    if said.startswith(("there is ", "there are ")):
        _, verb, rest = said.split(" ", 2)
        yield f"{verb} there {rest}"
    nothing = _NOTHING.match(said)
    if nothing is not None:
        yield f"is there no {nothing[2]} that {nothing[3]} {nothing[4]}"
    for verb_found in _VERB.finditer(said):
        before, after = said[: verb_found.start()].strip(), said[verb_found.end() :].strip()
        if before:
            yield f"{verb_found[1]} {before} {after}"
    yield f"does {said}"
    yield f"is there {said}"


def _of_the_whole(domain: Domain, text: str) -> Whole | None:
    """A value of the picture as a whole, said as the domain says it."""
    said = text.casefold()
    for key, feature in domain.features.items():
        for value, clause in feature.say.items():
            if said in {
                clause.replace("{it}", subject).casefold() for subject in ("it", domain.subject)
            }:
                return Whole(key, value)
    return None


# Queries as conditions -----------------------------------------------------------------------


def _of_query(query: object, things: Things, *, just: bool) -> tuple[Condition, ...]:
    match query:
        case asked.Exists(described=described, denied=denied):
            return (There(_pattern(described, things), holds=not denied),)
        case asked.CompareNumber(sign=sign, described=described, number=number):
            bound = ">=" if sign == "=" and number and not just else sign
            return _counted(_pattern(described, things), bound, number)
        case asked.Holds(ones=ones, condition=condition):
            return tuple(_holding(thing, condition, things) for thing in ones)
        case asked.SameValue(feature=feature, first=first, second=second, denied=denied):
            maker = _PatternMaker(things)
            pair = sorted((maker.add(first), maker.add(second)))
            maker.atoms.append(Alike(pair[0], pair[1], feature, not denied))
            return (There(maker.pattern),)
        case asked.Groups(group=group, denied=denied) if things.groups[group].size == MOST_THINGS:
            together = Pattern.of(MOST_THINGS, [Grouped(tuple(range(MOST_THINGS)), group)])
            return (There(together, holds=not denied),)
    raise _NotSaidError


def _counted(pattern: Pattern, sign: str, number: int) -> tuple[Condition, ...]:
    """How many things there are, as that there are so many at least, or fewer."""
    least = {">": number + 1, "<=": number + 1}.get(sign, number)
    if pattern.things != 1 or (sign == "<" and number < 1):
        raise _NotSaidError
    if sign == "=":
        fewer = There(pattern, number + 1, holds=False)
        return (There(pattern, number), fewer) if number else (There(pattern, holds=False),)
    if sign in (">", ">="):
        return (There(pattern, max(1, least)),)
    return (There(pattern, max(1, least), holds=False),)


def _holding(one: asked.Reference, condition: asked.Condition, things: Things) -> Condition:
    """That something is so of one of some things, or of every one."""
    described = one.description
    if one.which is asked.References.EVERY:
        lacking = described.also(asked.Not(condition))
        return There(_pattern(lacking, things), holds=False)
    return There(_pattern(described.also(condition), things))


def _pattern(described: asked.Description, things: Things) -> Pattern:
    maker = _PatternMaker(things)
    maker.add(asked.Reference(described, asked.References.SOME))
    return maker.pattern


class _PatternMaker:
    """Collects the things that are spoken of, and what is asked of them."""

    def __init__(self, things: Things) -> None:
        self.things = things
        self.count = 0
        self.atoms: list[Atom] = []

    @property
    def pattern(self) -> Pattern:
        """All of it; a thing that would have two values of one feature is not what was said."""
        values: dict[tuple[int, str], str] = {}
        for atom in self.atoms:
            if isinstance(atom, HasValue) and atom.holds:
                place = (atom.thing, atom.feature)
                if values.setdefault(place, atom.value) != atom.value:
                    raise _NotSaidError
        if self.count > MOST_THINGS:
            raise _NotSaidError
        return Pattern.of(self.count, self.atoms)

    def add(self, one: asked.Reference) -> int:
        """Add a thing that is like a description; return its place."""
        described = one.description
        if described.selection is not None or one.which is asked.References.EVERY:
            raise _NotSaidError
        place = self.count
        self.count += 1
        for condition in described.conditions:
            self._ask(place, condition)
        return place

    def _ask(self, place: int, condition: asked.Condition) -> None:
        match condition:
            case asked.All(conditions=conditions):
                for each in conditions:
                    self._ask(place, each)
            case asked.HasValue(feature=feature, value=value):
                self.atoms.append(HasValue(place, feature, value))
            case asked.Concluded(conclusion=conclusion):
                self.atoms.append(HasValue(place, conclusion, "yes"))
            case asked.Related(relation=relation, to=to, inverse=inverse):
                other = self.add(to)
                pair = (other, place) if inverse else (place, other)
                self.atoms.append(Related(*pair, relation))
            case asked.Shares(feature=feature, other=other_one):
                self.atoms.append(Alike(place, self.add(other_one), feature))
            case asked.PartOf(group=group) if self.things.groups[group].size == MOST_THINGS:
                more = (self.count, self.count + 1)
                self.count += 2
                self.atoms.append(Grouped((place, *more), group))
            case asked.Not(condition=denied):
                self._deny(place, denied)
            case _:
                raise _NotSaidError

    def _deny(self, place: int, condition: asked.Condition) -> None:
        match condition:
            case asked.HasValue(feature=feature, value=value):
                self.atoms.append(HasValue(place, feature, value, holds=False))
            case asked.Concluded(conclusion=conclusion):
                self.atoms.append(HasValue(place, conclusion, "no"))
            case asked.Related(relation=relation, to=to, inverse=inverse) if (
                to.description == asked.Description(many=to.description.many)
            ):
                self.atoms.append(Alone(place, relation, inverse=not inverse))
            case _:
                raise _NotSaidError
