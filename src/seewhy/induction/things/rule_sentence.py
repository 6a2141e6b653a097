"""Say rules about things as sentences, in the words of the domain."""

from __future__ import annotations

import re
from collections.abc import Sequence
from itertools import combinations

from seewhy.domain.domain import Domain
from seewhy.domain.thing_wording import described
from seewhy.domain.things import Things
from seewhy.domain.wording import join_words
from seewhy.induction.things.conditions import (
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
)
from seewhy.text.nouns import with_article
from seewhy.text.number_words import number_word

__all__ = ["say_condition", "say_conditions", "say_thing_rule"]

_PLURAL = {"does": "do", "has": "have"}


def say_thing_rule(domain: Domain, rule: ThingRule) -> str:
    """Return a rule as "if … and …, then … is …".

    Examples
    --------
    >>> from dataclasses import replace
    >>> from seewhy.domain.domain import load_domain
    >>> from seewhy.domain.scene_class import SceneClass
    >>> from seewhy.knowledge.axiom import Literal
    >>> good = SceneClass("good", Literal("good", ("picture",)), "good", ("good",))
    >>> domain = replace(load_domain("tabletop"), classes={"good": good})
    >>> ball = Pattern.of(1, [HasValue(0, "shape", "sphere")])
    >>> say_thing_rule(domain, ThingRule("good", (There(ball),)))
    'if there is a sphere, then the picture is good'
    """
    label = domain.classes[rule.label].say
    return f"if {say_conditions(domain, rule)}, then {domain.subject} is {label}"


def say_conditions(domain: Domain, rule: ThingRule) -> str:
    """Return all that a rule asks of a picture as one clause.

    Examples
    --------
    >>> from seewhy.domain.domain import load_domain
    >>> balls = There(Pattern.of(1, [HasValue(0, "shape", "sphere")]), 2)
    >>> say_conditions(load_domain("tabletop"), ThingRule("good", (balls, balls.denied)))
    'there are at least two spheres and there is at most one sphere'
    """
    said = [say_condition(domain, condition) for condition in rule.conditions]
    if rule.unless:
        others = [domain.classes[other].say for other in rule.unless]
        said.append(f"nothing says that {domain.subject} is {join_words(others, word='or')}")
    return " and ".join(said)


def say_condition(domain: Domain, condition: Condition) -> str:
    """Return what is asked of a picture as a clause.

    Examples
    --------
    >>> from seewhy.domain.domain import load_domain
    >>> tabletop = load_domain("tabletop")
    >>> red, cube = HasValue(0, "colour", "red"), HasValue(0, "shape", "cube")
    >>> large, on = HasValue(1, "size", "large"), Related(0, 1, "on")
    >>> say_condition(tabletop, There(Pattern.of(2, [red, cube, large, on])))
    'there is a red cube that is on a large thing'
    >>> say_condition(tabletop, There(Pattern.of(1, [red]), 3, holds=False))
    'there are at most two red things'
    >>> say_condition(tabletop, There(Pattern.of(3, [Alike(0, 1, "shape"), Alike(0, 2, "shape")])))
    'there are three things of the same shape'
    """
    if not isinstance(condition, There):
        said = domain.features[condition.feature].say[condition.value]
        said = said.replace("{it}", domain.subject)
        return said if condition.holds else f"it is not so that {said}"
    assert domain.things is not None, "the domain has no things"
    speaker = _Speaker(domain.things)
    if condition.least > 1:
        return speaker.counted(condition)
    if not condition.holds and (every := speaker.every(condition.pattern)):
        return every
    if together := speaker.together(condition.pattern):
        return f"there are {'' if condition.holds else 'no '}{together}"
    phrase = speaker.phrase(condition.pattern)
    return f"there is {with_article(phrase) if condition.holds else f'no {phrase}'}"


class _Speaker:
    def __init__(self, things: Things) -> None:
        self.things = things

    def counted(self, condition: There) -> str:
        """So many things at least, or fewer."""
        least = condition.least if condition.holds else condition.least - 1
        bound = "at least" if condition.holds else "at most"
        phrase = _Phrase(self.things, condition.pattern, many=least > 1).of(0)
        return f"there {'are' if least > 1 else 'is'} {bound} {number_word(least)} {phrase}"

    def every(self, pattern: Pattern) -> str:
        """That there is none without a value: every one has it; empty where it is not that."""
        atoms = pattern.atoms
        lacking = [atom for atom in atoms if isinstance(atom, HasValue) and not atom.holds]
        if pattern.things != 1 or len(lacking) != 1:
            return ""
        if not all(isinstance(atom, HasValue) and self._is_seen(atom) for atom in atoms):
            return ""
        (atom,) = lacking
        others = [other for other in atoms if other != atom]
        every = f"every {_Phrase(self.things, Pattern(1, tuple(others)), many=False).of(0)}"
        return self.things.features[atom.feature].say[atom.value].replace("{it}", every)

    def _is_seen(self, atom: HasValue) -> bool:
        return atom.feature in self.things.features

    def together(self, pattern: Pattern) -> str:
        """Several things of the same values: "two cubes of the same colour"; empty otherwise."""
        single = [
            sorted(
                repr(atom.renamed({thing: 0})) for atom in pattern.atoms if atom.things == (thing,)
            )
            for thing in range(pattern.things)
        ]
        several = [atom for atom in pattern.atoms if len(atom.things) > 1]
        grouped = [atom for atom in several if isinstance(atom, Grouped)]
        alike = [atom for atom in several if isinstance(atom, Alike)]
        if pattern.things == 1 or len(grouped) + len(alike) < len(several):
            return ""
        if any(values != single[0] for values in single[1:]):
            return ""
        same, differ = [], []
        for feature in dict.fromkeys(atom.feature for atom in alike):
            of_feature = [atom for atom in alike if atom.feature == feature]
            name = self.things.features[feature].name
            if _same(of_feature, pattern.things):
                same.append(f"of the same {name}")
            elif _all_different(of_feature, pattern.things):
                differ.append(name)
            else:
                return ""
        alone = [atom.renamed({0: 0}) for atom in pattern.atoms if atom.things == (0,)]
        noun = _Phrase(self.things, Pattern(1, tuple(alone)), many=True).of(0)
        all_of_them = "all " if pattern.things > 2 else ""
        differing = f"that {all_of_them}differ in {join_words(differ)}" if differ else ""
        parts = [number_word(pattern.things), noun, " and ".join(same), differing]
        phrase = " ".join(filter(None, parts))
        clauses = [self.things.groups[atom.group].say for atom in grouped]
        if not clauses:
            return phrase
        behind = " and ".join(
            clause.replace("{them}", "they" if clause.startswith("{them}") else "them")
            for clause in clauses
        )
        return f"{phrase} such that {behind}"

    def phrase(self, pattern: Pattern) -> str:
        """A thing with all that is asked of it and, through it, of others."""
        related = [atom for atom in pattern.atoms if isinstance(atom, Related)]
        to = {atom.other for atom in related}
        first = [atom.thing for atom in related if atom.thing not in to]
        first += [atom.thing for atom in related]
        return _Phrase(self.things, pattern, many=False).of(first[0] if first else 0)


def _same(atoms: Sequence[Alike], things: int) -> bool:
    joined = Pattern(things, tuple(atoms))
    return all(atom.holds for atom in atoms) and joined.is_connected


def _all_different(atoms: Sequence[Alike], things: int) -> bool:
    return {atom.things for atom in atoms if not atom.holds} == set(
        combinations(range(things), 2)
    ) and not any(atom.holds for atom in atoms)


class _Phrase:
    """Says a pattern from one of its things on; each other thing is described where it comes in."""

    def __init__(self, things: Things, pattern: Pattern, *, many: bool) -> None:
        self.things, self.pattern, self.many = things, pattern, many
        self.told: set[int] = set()
        self.said: set[Atom] = set()

    def of(self, thing: int, *, behind: Sequence[str] = ()) -> str:
        """Return a thing as a phrase without an article: "red cube that is on a large thing".

        ``behind`` is what stands right behind the noun.
        """
        many = self.many and not self.told
        self.told.add(thing)
        single = [atom for atom in self.pattern.atoms if atom.things == (thing,)]
        clauses = [said for atom in single if (said := self._own(atom))]
        for other in self._others(thing):
            clauses += self._to_other(thing, other)
        for atom in self.pattern.atoms:
            if isinstance(atom, Grouped) and atom not in self.said:
                clauses.append(self._grouped(atom, thing))
        noun = self._named(thing, many=many)
        return " ".join([noun, *behind, *_relative(clauses, "are" if many else "is")])

    def _others(self, thing: int) -> list[int]:
        """The things that atoms join with a thing: those that relations do go before."""
        joint = [
            atom
            for atom in self.pattern.atoms
            if isinstance(atom, Related | Alike) and thing in atom.things
        ]
        joint.sort(key=lambda atom: not isinstance(atom, Related))
        return list(dict.fromkeys(at for atom in joint for at in atom.things if at != thing))

    def _to_other(self, thing: int, other: int) -> list[str]:
        """What is asked of a thing and another, which is described if it was not yet."""
        between = [
            atom
            for atom in self.pattern.atoms
            if set(atom.things) == {thing, other} and atom not in self.said
        ]
        self.said.update(between)
        related = [atom for atom in between if isinstance(atom, Related)]
        alike = [atom for atom in between if isinstance(atom, Alike)]
        if other in self.told:
            named = f"the {self._named(other)}"
            clauses = [self._related(atom, thing, named) for atom in related]
            return clauses + [f"is {self._likened(atom)} {named}" for atom in alike]
        if not related:
            first, *others = alike
            clauses = [f"is {self._likened(first)} {with_article(self.of(other))}"]
            return clauses + [f"is {self._likened(atom)} it" for atom in others]
        likened = " and ".join(self._likened(atom).rsplit(" ", 1)[0] for atom in alike)
        named = with_article(self.of(other, behind=[likened] if likened else []))
        clauses = [self._related(related[0], thing, named)]
        return clauses + [self._related(atom, thing, "it") for atom in related[1:]]

    def _named(self, thing: int, *, many: bool = False) -> str:
        """A thing by the values that a word, a noun or a phrase behind the noun says."""
        values = {
            atom.feature: atom.value
            for atom in self.pattern.atoms
            if isinstance(atom, HasValue)
            and atom.things == (thing,)
            and atom.holds
            and self._is_word(atom)
        }
        ordered = {key: values[key] for key in self.things.features if key in values}
        return described(self.things, ordered, many=many)

    def _is_word(self, atom: HasValue) -> bool:
        feature = self.things.features.get(atom.feature)
        return feature is not None and bool(
            feature.nouns[atom.value] or feature.words[atom.value] or atom.value in feature.behind
        )

    def _own(self, atom: Atom) -> str:
        """What is asked of one thing, where its name does not say it."""
        if isinstance(atom, HasValue):
            return "" if atom.holds and self._is_word(atom) else self._value(atom)
        assert isinstance(atom, Alone), f"must be about one thing, got {atom!r}"
        relation = self.things.relations[atom.relation]
        if atom.inverse and relation.words:
            return f"is {relation.words[0]} nothing"
        pair = ("it", "nothing") if atom.inverse else ("nothing", "it")
        return f"such that {_filled(relation.say, *pair)}"

    def _value(self, atom: HasValue) -> str:
        if atom.feature in self.things.conclusions:
            conclusion = self.things.conclusions[atom.feature]
            return _clause(conclusion.say if atom.value == "yes" else conclusion.deny)
        feature = self.things.features[atom.feature]
        say = feature.say[atom.value]
        if atom.holds:
            return _clause(say)
        if atom.value in feature.behind or not (feature.nouns[atom.value] or self._is_word(atom)):
            has = re.fullmatch(r"\{it\} has (.+)", say)
            return f"does not have {has[1]}" if has else f"such that it is not so that {_it(say)}"
        nouns = feature.nouns[atom.value]
        return f"is not {with_article(nouns[0]) if nouns else feature.words[atom.value][0]}"

    def _likened(self, atom: Alike) -> str:
        name = self.things.features[atom.feature].name
        return f"of the same {name} as" if atom.holds else f"of another {name} than"

    def _related(self, atom: Related, thing: int, other: str) -> str:
        """That a thing stands in a relation to another, or that one to it."""
        relation = self.things.relations[atom.relation]
        if atom.thing != thing and relation.converse is not None:
            relation = self.things.relations[relation.converse]
        elif atom.thing != thing:
            return f"such that {_filled(relation.say, other, 'it')}"
        if relation.words:
            return f"is {relation.words[0]} {other}"
        return _clause(_filled(relation.say, "{it}", other))

    def _grouped(self, atom: Grouped, thing: int) -> str:
        """What is concluded of a thing together with others."""
        self.said.add(atom)
        others = [
            f"the {self._named(other)}" if other in self.told else with_article(self.of(other))
            for other in atom.things
            if other != thing
        ]
        named = join_words(["it", *others])
        return f"such that {self.things.groups[atom.group].say.replace('{them}', named)}"


def _relative(clauses: Sequence[str], verb: str) -> list[str]:
    """The clauses behind a noun: what it is, what else is so of it, and how it is besides."""
    being = [said.removeprefix("is ") for said in clauses if said.startswith("is ")]
    doing = [said for said in clauses if not said.startswith(("is ", "such "))]
    if verb == "are":
        doing = [
            re.sub("^(does|has)", lambda verb_found: _PLURAL[verb_found[0]], said) for said in doing
        ]
    such = [said for said in clauses if said.startswith("such ")]
    relative = [*([f"{verb} {' and '.join(being)}"] if being else []), *doing]
    that = [f"that {' and '.join(relative)}"] if relative else []
    return [" and ".join([*that, *such])] if that or such else []


def _clause(say: str) -> str:
    """A clause about {it} as it stands behind "that", or else behind "such that"."""
    if say.startswith("{it} ") and "{it}" not in say[5:]:
        return say.removeprefix("{it} ")
    return f"such that {_it(say)}"


def _it(say: str) -> str:
    return say.replace("{it}", "it")


def _filled(say: str, first: str, second: str) -> str:
    return say.replace("{0}", first).replace("{1}", second)
