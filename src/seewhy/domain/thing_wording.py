"""Say what is so of things, and between two of them, in the words of the domain."""

from __future__ import annotations

import re
from collections.abc import Mapping
from types import MappingProxyType

from seewhy.domain.domain import Domain
from seewhy.domain.things import Things
from seewhy.knowledge.axiom import Literal
from seewhy.text.nouns import plural, with_article

__all__ = ["denied", "described", "say_of_things", "say_thing"]

_NOTHING: Mapping[str, str] = MappingProxyType({})


def say_thing(domain: Domain, term: str, names: Mapping[str, str] = _NOTHING) -> str:
    """Return how a thing is called: as ``names`` has it, else by its number.

    The sort itself stands for any thing.

    Examples
    --------
    >>> from seewhy.domain.domain import load_domain
    >>> domain = load_domain("tabletop")
    >>> say_thing(domain, "thing2"), say_thing(domain, "thing2", {"thing2": "the red cup"})
    ('thing 2', 'the red cup')
    """
    things = domain.things
    assert things is not None, "the domain has no things"
    if term in names:
        return names[term]
    if term in domain.schema.presence:
        return f"{things.one} {term.removeprefix(things.sort)}"
    if term == things.sort.replace("_", " "):
        return with_article(things.one)
    return term.strip('"').replace("_", " ")


def described(things: Things, values: Mapping[str, str | None], *, many: bool = False) -> str:
    """Return a thing of some values, or several, without an article.

    Examples
    --------
    >>> from seewhy.domain.domain import load_domain
    >>> things = load_domain("tabletop").things
    >>> described(things, {"size": "small", "shape": "cube"})
    'small cube'
    >>> described(things, {"colour": "red"}, many=True)
    'red things'
    """
    adjectives: list[str] = []
    behind: list[str] = []
    noun, nouns = things.one, things.many
    for key, value in values.items():
        if value is None:
            continue
        feature = things.features[key]
        if feature.nouns[value]:
            noun = feature.nouns[value][0]
            nouns = plural(noun)
        elif value in feature.behind:
            behind.append(feature.behind[value])
        elif feature.words[value]:
            adjectives.append(feature.words[value][0])
    named = nouns if many else noun
    return " ".join(filter(None, [*adjectives, named, " and ".join(behind)]))


def say_of_things(
    domain: Domain, literal: Literal, names: Mapping[str, str] = _NOTHING
) -> str | None:
    """Return a literal about what is seen of things as a clause; None for any other.

    Examples
    --------
    >>> from seewhy.domain.domain import load_domain
    >>> domain = load_domain("tabletop")
    >>> say_of_things(domain, Literal("colour", ("thing1", "red")))
    'thing 1 is red'
    >>> say_of_things(domain, Literal("left", ("thing1", "thing2"), positive=False))
    'thing 1 is not left of thing 2'
    """
    things = domain.things
    if things is None:
        return None
    told = [say_thing(domain, argument, names) for argument in literal.arguments]
    if literal.predicate == things.sort:
        if literal.arguments[0] in names:
            return f"{told[0]} is {'' if literal.positive else 'not '}there"
        return f"there is {'' if literal.positive else 'no '}{told[0]}"
    if literal.predicate in things.relations:
        said = things.relations[literal.predicate].say
        return _signed(said.replace("{0}", told[0]).replace("{1}", told[1]), literal.positive)
    if literal.predicate in things.conclusions:
        conclusion = things.conclusions[literal.predicate]
        return (conclusion.say if literal.positive else conclusion.deny).replace("{it}", told[0])
    if literal.predicate in things.groups:
        group = things.groups[literal.predicate]
        listed = f"{', '.join(told[:-1])} and {told[-1]}"
        return (group.say if literal.positive else group.deny).replace("{them}", listed)
    feature = things.features.get(literal.predicate)
    if feature is None:
        return None
    if len(literal.arguments) == 1:
        return feature.say["yes" if literal.positive else "no"].replace("{it}", told[0])
    clause = feature.say.get(literal.arguments[1])
    if clause is None:
        clause = f"the {feature.name} of {{it}} is {told[1]}"
    return _signed(clause.replace("{it}", told[0]), literal.positive)


def _signed(clause: str, positive: bool) -> str:
    """A clause, or that it is not so."""
    return clause if positive else denied(clause)


def denied(clause: str) -> str:
    """Return that a clause is not so.

    Examples
    --------
    >>> denied("{0} is on {1}"), denied("it rains")
    ('{0} is not on {1}', 'it is not so that it rains')
    """
    denial, count = re.subn(r"\b(is|are|has|can)\b", r"\1 not", clause, count=1)
    if count and "has not" not in denial:
        return denial
    return f"it is not so that {clause}"
