"""A goal in words: "make a tower of three with the red block on top" becomes conditions."""

from __future__ import annotations

import itertools
import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from seewhy.dialogue.lexicon import NUMBERS
from seewhy.dialogue.question_words import words_of
from seewhy.domain.things import Things
from seewhy.errors import PlanningError
from seewhy.knowledge.axiom import Axiom, AxiomKind, substitute, variables_in
from seewhy.knowledge.signature import PredicateKind
from seewhy.planning.domain import PlanningDomain
from seewhy.planning.goal import Goal, read_goal
from seewhy.planning.things.referring import Referent, ThingReferences
from seewhy.planning.unreachable import excluded_by
from seewhy.text.nouns import plural
from seewhy.text.number_words import number_word

__all__ = ["SpokenGoals", "goal_of"]

_ARTICLES = frozenset({"a", "an", "the"})
_ASIDES = (
    "please", "can you", "could you", "i want you to", "i want that", "make sure that", "now",
    "then", "so that", "try to", "i would like you to", "see to it that", "first",
)  # fmt: skip
_SLOT = re.compile(r"\{(\w+)\}")
_JOINED = ("and then", "and", "then")
_PRONOUNS = (("it",), ("them",), ("that",), ("this",))
_MOST_WORDS = 80


def goal_of(text: str, domain: PlanningDomain) -> Goal:
    """Return the goal that literals or words name.

    Raises
    ------
    PlanningError
        If it is neither; the text says what could be said.

    Examples
    --------
    >>> from seewhy.planning.domain import load_planning_domain
    >>> domain = load_planning_domain("tabletop")
    >>> str(goal_of("on(thing1, thing3)", domain))
    'on(thing1, thing3)'
    >>> str(goal_of("make a tower of three with the red block on top", domain))
    'height(thing1, 3), clear(thing1)'
    """
    if in_words(text, domain):
        return SpokenGoals(domain).read(text)
    return read_goal(text, domain.knowledge)


def in_words(text: str, domain: PlanningDomain) -> bool:
    """Whether a goal is said in words: it has several, and no literal.

    Examples
    --------
    >>> from seewhy.planning.domain import load_planning_domain
    >>> domain = load_planning_domain("tabletop")
    >>> in_words("clear the ball", domain), in_words("not stacked", domain)
    (True, False)
    """
    words = text.strip(" .").split()
    literals = {"not", *domain.knowledge.signature.predicates}
    return (
        len(words) > 1
        and not any(sign in text for sign in "(){}=<>%")
        and not {word.strip("-,") for word in words} <= literals
    )


@dataclass(frozen=True)
class _Form:
    """Words with slots, the conditions that they ask for, and the sort of each slot."""

    words: tuple[str, ...]
    conditions: tuple[str, ...]
    sorts: Mapping[str, str]


@dataclass(frozen=True)
class _Said:
    """What was said before of a goal: how many parts of it, and the things of the last."""

    number: int = 0
    about: tuple[str, ...] = ()


_NOTHING = _Said()


@dataclass(frozen=True)
class _Single:
    """One part of a goal: its conditions, the words before its first slot, the things in that."""

    conditions: tuple[str, ...]
    lead: tuple[str, ...]
    about: tuple[str, ...]

    def after(self, said: _Said) -> _Said:
        """What was said when this was, too."""
        return _Said(said.number + 1, self.about)


class SpokenGoals:
    """The goals of a domain that can be said in words.

    They are those of ``[[goals]]`` in planning.toml, what its actions bring about ("put … on …"),
    and what its fluents say ("… is on …"), in this order.

    Parameters
    ----------
    domain : PlanningDomain

    Examples
    --------
    >>> from seewhy.planning.domain import load_planning_domain
    >>> goals = SpokenGoals(load_planning_domain("robot_assistant"))
    >>> str(goals.read("deliver the first message to Sally, and move to the kitchen"))
    'message_status(m1, sally, delivered), loc(rob1, kitchen)'
    """

    def __init__(self, domain: PlanningDomain) -> None:
        self.domain = domain
        written = [*_of_table(domain), *_of_actions(domain), *_of_fluents(domain)]
        # What names nothing is meant as a whole: "put everything on the table".
        self.forms = sorted(written, key=lambda form: any(map(_SLOT.fullmatch, form.words)))
        self._first_words: dict[tuple[str, ...], tuple[str, ...]] = {}
        for form in written:
            self._first_words.setdefault(form.conditions, form.words)
        at_first = domain.at_first
        self.references = None if at_first is None else ThingReferences(at_first)
        self._named = {
            (sort.name, _plain(words_of(name))): member
            for sort in domain.knowledge.signature.sorts.values()
            for member in sort.members or ()
            for name in (domain.words.name(member), member.replace("_", " "))
        }

    def read(self, text: str) -> Goal:
        """Return the goal that is said.

        Raises
        ------
        PlanningError
            If it is not understood, or speaks of one thing where there are several.
        """
        words = _without_asides(words_of(text))
        if len(words) > _MOST_WORDS:
            raise PlanningError(
                f"the goal has {len(words)} words, at most {_MOST_WORDS} are read; say it in fewer"
            )
        unclear: list[PlanningError] = []
        conditions = self._several(words, unclear)
        if conditions is None and unclear:
            raise unclear[0]
        if conditions is None:
            said = " · ".join(self.examples())
            raise PlanningError(
                f"the goal '{text.strip()}' is not understood; say one such as {said}"
            )
        return self._goal(conditions)

    def examples(self) -> list[str]:
        """Return a few goals as they can be said, with dots for what is named."""
        said = (_SLOT.sub("…", " ".join(words)) for words in self._first_words.values())
        return list(itertools.islice(dict.fromkeys(said), 6))

    def _several(
        self, words: Sequence[str], unclear: list[PlanningError], said: _Said = _NOTHING
    ) -> list[str] | None:
        """The conditions of one goal, or of several that are joined by "and" or "then"."""
        found = self._single(words, unclear, said)
        if found is not None:
            return list(found.conditions)
        for at in range(1, len(words)):
            for joint in _JOINED:
                size = len(joint.split())
                if list(words[at : at + size]) != joint.split():
                    continue
                first = self._single(words[:at], unclear, said)
                if first is None:
                    continue
                rest = _without_asides(words[at + size :])
                for more in (rest, [*first.lead, *rest]):  # "and the green one on the red one"
                    others = self._several(more, unclear, first.after(said))
                    if others is not None:
                        return self._joined(first.conditions, others, in_turn="then" in joint)
        listed = self._single(words, unclear, said, several=True)
        return None if listed is None else list(listed.conditions)

    def _joined(self, first: Sequence[str], others: Sequence[str], *, in_turn: bool) -> list[str]:
        """What is asked for together; what cannot stay so when the rest is so is on the way."""
        together = [*first, *others]
        if in_turn and excluded_by(self.domain, self._goal(together)):
            return list(others)
        return together

    def _goal(self, conditions: Sequence[str]) -> Goal:
        return read_goal(", ".join(dict.fromkeys(conditions)), self.domain.knowledge)

    def _single(
        self,
        words: Sequence[str],
        unclear: list[PlanningError],
        said: _Said,
        *,
        several: bool = False,
    ) -> _Single | None:
        for form in self.forms:
            for filled in _matches(form.words, tuple(words)):
                try:
                    found = self._conditions(form, filled, said, several=several)
                except PlanningError as problem:
                    unclear.append(problem)
                    continue
                if found is not None:
                    return found
        return None

    def _conditions(
        self,
        form: _Form,
        filled: Mapping[str, tuple[str, ...]],
        said: _Said,
        *,
        several: bool,
    ) -> _Single | None:
        """The conditions of a form; its first slot may name several things, where that is asked."""
        bindings: list[dict[str, str]] = [{}]
        asked: list[str] = []
        about: tuple[str, ...] = ()
        for place, (slot, words) in enumerate(filled.items()):
            meant = self._meant(form, slot, words, said)
            if meant is None and several and place == 0:
                meant = self._each_of(form, slot, words)
            if meant is None:
                return None
            variable = f"{slot}{said.number}"
            about = about or meant.terms
            asked += meant.conditions(variable)
            if not meant.terms and not meant.values:
                asked.append(f"{form.sorts[slot]}({variable})")  # "something"
            bindings = [
                {**binding, slot: term}
                for binding in bindings
                for term in meant.terms or (variable,)
            ]
        # "All cubes on the red cube" are the others.
        apart_from = [one for one in bindings if len(set(one.values())) == len(one)]
        bindings = apart_from or bindings
        # Other variables than those of goals that are joined to this one.
        free = {name for text in form.conditions for name in variables_in(text)}
        apart = {
            name: f"{name}{said.number}" for name in free if name not in filled and name != "_"
        }
        told = [
            substitute(text, {**apart, **binding})
            for binding in bindings
            for text in form.conditions
        ]
        lead = tuple(itertools.takewhile(lambda word: not _SLOT.fullmatch(word), form.words))
        return _Single((*told, *asked), lead, about)

    def _meant(
        self, form: _Form, slot: str, words: tuple[str, ...], said: _Said
    ) -> Referent | None:
        """What words mean of a sort."""
        sort, at_first = form.sorts[slot], self.domain.at_first
        if words in _PRONOUNS and said.about:
            members = self.domain.knowledge.signature.members(sort)
            return Referent(said.about) if set(said.about) <= set(members) else None
        if at_first is not None and self.references is not None and sort == at_first.things.sort:
            return self.references.read(" ".join(words))
        plain = _plain(words)
        if at_first is not None and len(plain) == 2 and plain[1] in _nouns(at_first.things):
            plain = plain[:1]  # "three things"
        if len(plain) == 1 and plain[0] in NUMBERS:
            plain = (str(NUMBERS.index(plain[0])),)
        member = self._named.get((sort, plain))
        if member is None and len(plain) == 1 and plain[0].isdigit():
            self._refuse_number(form, sort, words[0])
        return None if member is None else Referent((member,))

    def _refuse_number(self, form: _Form, sort: str, said: str) -> None:
        """Raise a PlanningError if a sort is one of numbers, of which this is none."""
        numbers = [int(m) for m in self.domain.knowledge.signature.members(sort) if m.isdigit()]
        if not numbers:
            return
        goal = _SLOT.sub("…", " ".join(form.words))
        at_first = self.domain.at_first
        there = ""
        if at_first is not None:
            count, things = at_first.scene.count, at_first.things
            noun = things.one if count == 1 else things.many
            there = f"; there {'is' if count == 1 else 'are'} {number_word(count)} {noun}"
        raise PlanningError(
            f"'{said}' is no number that '{goal}' takes: it goes from {min(numbers)} to "
            f"{max(numbers)}{there}"
        )

    def _each_of(self, form: _Form, slot: str, words: tuple[str, ...]) -> Referent | None:
        """What several phrases mean together: "the red block, the ball and the green block"."""
        for at in range(1, len(words)):
            joint = words[at]
            if joint != "and" and joint not in _ARTICLES:
                continue
            first = self._meant(form, slot, words[:at], _NOTHING)
            if first is None or not first.terms:
                continue
            rest = words[at + (joint == "and") :]
            others = self._meant(form, slot, rest, _NOTHING) or self._each_of(form, slot, rest)
            if others is not None and others.terms:
                return Referent((*first.terms, *others.terms))
        return None


def _nouns(things: Things) -> frozenset[str]:
    """The words for any things of a domain."""
    return frozenset({things.many, *map(plural, things.words)})


def _of_table(domain: PlanningDomain) -> Iterator[_Form]:
    for table in domain.goals:
        goal = read_goal(table.goal, domain.knowledge)
        sorts = _sorts_of_variables(goal.axiom, domain)
        texts = tuple(condition.text for condition in goal.axiom.body)
        for text in table.say:
            yield _Form(_words_with_slots(text), texts, sorts)


def _sorts_of_variables(axiom: Axiom, domain: PlanningDomain) -> dict[str, str]:
    signature = domain.knowledge.signature
    return {
        argument: sort
        for condition in axiom.body
        if condition.literal is not None
        for argument, sort in zip(
            condition.literal.arguments,
            signature.argument_sorts(condition.literal.predicate),
            strict=True,
        )
    }


def _of_actions(domain: PlanningDomain) -> Iterator[_Form]:
    """What actions bring about whatever else is so, as their instructions say it."""
    for name, table in domain.words.actions.items():
        predicate = domain.knowledge.signature.predicates[name]
        if predicate.kind is not PredicateKind.ACTION or table.do is None:
            continue
        effects = tuple(_effects(name, domain))
        sorts = {f"V{place}": sort for place, sort in enumerate(predicate.sorts)}
        for text in (table.do, *table.also) if effects else ():
            yield _Form(_words_with_slots(_SLOT.sub(r"{V\1}", text)), effects, sorts)


def _effects(action: str, domain: PlanningDomain) -> Iterator[str]:
    actor = domain.words.actors.get(action)
    for axiom in domain.knowledge.axioms:
        if axiom.kind is not AxiomKind.CAUSAL_LAW or axiom.action is None or axiom.body:
            continue
        if axiom.action.predicate != action or not axiom.head.positive:
            continue
        arguments = axiom.action.arguments
        names = {name: f"V{place}" for place, name in enumerate(arguments)}
        if actor is not None and domain.robot is not None:
            names[arguments[actor]] = domain.robot
        if {name for text in axiom.head.arguments for name in variables_in(text)} <= names.keys():
            yield substitute(str(axiom.head), names)


def _of_fluents(domain: PlanningDomain) -> Iterator[_Form]:
    for name, predicate in domain.knowledge.signature.predicates.items():
        if not predicate.kind.is_fluent:
            continue
        variables = [f"V{place}" for place in range(len(predicate.sorts))]
        atom = f"{name}({', '.join(variables)})" if variables else name
        sorts = dict(zip(variables, predicate.sorts, strict=True))
        denied = "not " if predicate.kind is PredicateKind.FLUENT_DEFINED else "-"
        for text, condition in zip(
            domain.words.clauses(name, len(variables)), (atom, f"{denied}{atom}"), strict=True
        ):
            yield _Form(_words_with_slots(_SLOT.sub(r"{V\1}", text)), (condition,), sorts)


def _words_with_slots(text: str) -> tuple[str, ...]:
    parts = re.split(r"(\{\w+\})", text)
    return tuple(
        word for part in parts for word in ([part] if _SLOT.fullmatch(part) else words_of(part))
    )


def _matches(form: tuple[str, ...], words: tuple[str, ...]) -> Iterator[dict[str, tuple[str, ...]]]:
    """The ways in which words fill the slots of a form; its articles may be left out."""
    if not form:
        if not words:
            yield {}
        return
    slot = _SLOT.fullmatch(form[0])
    if slot is None:
        if words and words[0] == form[0]:
            yield from _matches(form[1:], words[1:])
        if form[0] in _ARTICLES:
            yield from _matches(form[1:], words)
        return
    for size in range(1, len(words) + 1):
        for filled in _matches(form[1:], words[size:]):
            yield {slot.group(1): words[:size], **filled}


def _without_asides(words: Sequence[str]) -> list[str]:
    for aside in map(str.split, _ASIDES):
        if list(words[: len(aside)]) == aside:
            return _without_asides(words[len(aside) :])
    left = list(words)
    while left and left[-1] == "please":
        left.pop()
    return left


def _plain(words: Sequence[str]) -> tuple[str, ...]:
    return tuple(word for word in words if word not in _ARTICLES)
