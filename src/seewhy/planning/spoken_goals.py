"""A goal in words: "make a tower of three with the red block on top" becomes conditions."""

from __future__ import annotations

import itertools
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from seewhy.dialogue.lexicon import NUMBERS
from seewhy.dialogue.question_words import words_of
from seewhy.domain.things import Things
from seewhy.errors import PlanningError
from seewhy.knowledge.axiom import substitute, variables_in
from seewhy.planning.domain import PlanningDomain
from seewhy.planning.goal import Goal, read_goal
from seewhy.planning.goal_forms import ARTICLES, SLOT, GoalForm, goal_forms, slots_filled
from seewhy.planning.things.referring import Referent, ThingReferences
from seewhy.planning.unreachable import excluded_by
from seewhy.text.nouns import plural
from seewhy.text.number_words import number_word

__all__ = ["SpokenGoals", "goal_of"]

_ASIDES = (
    "please", "can you", "could you", "i want you to", "i want that", "make sure that", "now",
    "then", "so that", "try to", "i would like you to", "see to it that", "first",
)  # fmt: skip
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
        written = goal_forms(domain)
        # What names nothing is meant as a whole: "put everything on the table".
        self.forms = sorted(written, key=lambda form: any(map(SLOT.fullmatch, form.words)))
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
        said = (SLOT.sub("…", " ".join(words)) for words in self._first_words.values())
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
            for filled in slots_filled(form.words, tuple(words)):
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
        form: GoalForm,
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
        apart_from = [binding for binding in bindings if len(set(binding.values())) == len(binding)]
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
        lead = tuple(itertools.takewhile(lambda word: not SLOT.fullmatch(word), form.words))
        return _Single((*told, *asked), lead, about)

    def _meant(
        self, form: GoalForm, slot: str, words: tuple[str, ...], said: _Said
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

    def _refuse_number(self, form: GoalForm, sort: str, said: str) -> None:
        """Raise a PlanningError if a sort is one of numbers, of which this is none."""
        numbers = [int(m) for m in self.domain.knowledge.signature.members(sort) if m.isdigit()]
        if not numbers:
            return
        goal = SLOT.sub("…", " ".join(form.words))
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

    def _each_of(self, form: GoalForm, slot: str, words: tuple[str, ...]) -> Referent | None:
        """What several phrases mean together: "the red block, the ball and the green block"."""
        for at in range(1, len(words)):
            joint = words[at]
            if joint != "and" and joint not in ARTICLES:
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


def _without_asides(words: Sequence[str]) -> list[str]:
    for aside in map(str.split, _ASIDES):
        if list(words[: len(aside)]) == aside:
            return _without_asides(words[len(aside) :])
    left = list(words)
    while left and left[-1] == "please":
        left.pop()
    return left


def _plain(words: Sequence[str]) -> tuple[str, ...]:
    return tuple(word for word in words if word not in ARTICLES)
