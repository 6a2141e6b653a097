"""The goals that can be said in a domain: words with slots, and what they ask for."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from seewhy.dialogue.question_words import words_of
from seewhy.knowledge.axiom import Axiom, AxiomKind, substitute, variables_in
from seewhy.knowledge.signature import PredicateKind
from seewhy.planning.domain import PlanningDomain
from seewhy.planning.goal import read_goal

__all__ = ["ARTICLES", "SLOT", "GoalForm", "goal_forms", "slots_filled"]

ARTICLES = frozenset({"a", "an", "the"})
SLOT = re.compile(r"\{(\w+)\}")


@dataclass(frozen=True)
class GoalForm:
    """Words with slots, the conditions that they ask for, and the sort of each slot."""

    words: tuple[str, ...]
    conditions: tuple[str, ...]
    sorts: Mapping[str, str]


def goal_forms(domain: PlanningDomain) -> list[GoalForm]:
    """Return the goals of ``[[goals]]``, of what actions bring about, and of what fluents say.

    Examples
    --------
    >>> from seewhy.planning.domain import load_planning_domain
    >>> goal_forms(load_planning_domain("tabletop"))[0].words
    ('make', 'a', 'tower', 'of', '{N}')
    """
    return [*_of_table(domain), *_of_actions(domain), *_of_fluents(domain)]


def _of_table(domain: PlanningDomain) -> Iterator[GoalForm]:
    for table in domain.goals:
        goal = read_goal(table.goal, domain.knowledge)
        sorts = _sorts_of_variables(goal.axiom, domain)
        texts = tuple(condition.text for condition in goal.axiom.body)
        for text in table.say:
            yield GoalForm(_words_with_slots(text), texts, sorts)


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


def _of_actions(domain: PlanningDomain) -> Iterator[GoalForm]:
    """What actions bring about whatever else is so, as their instructions say it."""
    for name, table in domain.words.actions.items():
        predicate = domain.knowledge.signature.predicates[name]
        if predicate.kind is not PredicateKind.ACTION or table.do is None:
            continue
        effects = tuple(_effects(name, domain))
        sorts = {f"V{place}": sort for place, sort in enumerate(predicate.sorts)}
        for text in (table.do, *table.also) if effects else ():
            yield GoalForm(_words_with_slots(SLOT.sub(r"{V\1}", text)), effects, sorts)


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


def _of_fluents(domain: PlanningDomain) -> Iterator[GoalForm]:
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
            yield GoalForm(_words_with_slots(SLOT.sub(r"{V\1}", text)), (condition,), sorts)


def _words_with_slots(text: str) -> tuple[str, ...]:
    parts = re.split(r"(\{\w+\})", text)
    return tuple(
        word for part in parts for word in ([part] if SLOT.fullmatch(part) else words_of(part))
    )


def slots_filled(
    form: tuple[str, ...], words: tuple[str, ...]
) -> Iterator[dict[str, tuple[str, ...]]]:
    """Yield the ways in which words fill the slots of a form; its articles may be left out."""
    if not form:
        if not words:
            yield {}
        return
    slot = SLOT.fullmatch(form[0])
    if slot is None:
        if words and words[0] == form[0]:
            yield from slots_filled(form[1:], words[1:])
        if form[0] in ARTICLES:
            yield from slots_filled(form[1:], words)
        return
    for size in range(1, len(words) + 1):
        for filled in slots_filled(form[1:], words[size:]):
            yield {slot.group(1): words[:size], **filled}
