"""Say a goal in the words of a planning domain."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence

import clingo

from seewhy.domain.wording import join_words
from seewhy.knowledge.axiom import Condition, substitute, variables_in
from seewhy.knowledge.ground import complement_of
from seewhy.knowledge.signature import Signature
from seewhy.planning.diagnosis.belief_state import State
from seewhy.planning.dialogue.surface_realisation import Speech
from seewhy.planning.domain import PlanningDomain
from seewhy.planning.goal import Goal

_COMPARED = re.compile(r"([\w\" ]+?)\s*(!=|<=|>=|=|<|>)\s*([\w\" ]+)$")
_COMPARISONS = {
    "!=": "is not",
    "=": "is",
    "<": "is less than",
    ">": "is more than",
    "<=": "is at most",
    ">=": "is at least",
}


def say_goal(
    goal: Goal, domain: PlanningDomain, speech: Speech, *, end: State | None = None
) -> str:
    """Return a goal as a clause; where a state is given, only what does not hold in it.

    Examples
    --------
    >>> from seewhy.planning.goal import read_goal
    >>> from seewhy.planning.domain import load_planning_domain
    >>> domain = load_planning_domain("robot_assistant")
    >>> goal = read_goal("loc(P, kitchen), person(P), P != bob", domain.knowledge)
    >>> say_goal(goal, domain, Speech(domain.words))
    'some person is in the kitchen and that person is not Bob'
    """
    signature = domain.knowledge.signature
    some = _names_of_variables(goal.axiom.body, signature)
    clauses: list[tuple[str, bool]] = []
    for condition in goal.axiom.body:
        if condition.literal is None:
            clauses.append((_comparison(condition.text, some, speech), False))
        elif condition.literal.predicate not in signature.sorts:
            symbol = clingo.parse_term(str(condition.literal.substitute(some)))
            met = end is not None and condition.absent != (symbol in end.holds)
            clauses.append((speech.say(complement_of(symbol) if condition.absent else symbol), met))
    unmet = [text for text, met in clauses if not met]
    return join_words(unmet or [text for text, _ in clauses])


def _comparison(text: str, some: Mapping[str, str], speech: Speech) -> str:
    those = {variable: name.replace("some ", "that ") for variable, name in some.items()}
    found = _COMPARED.match(substitute(text, those))
    if found is None:
        return text
    one, sign, other = found.groups()
    return f"{speech.name(one)} {_COMPARISONS[sign]} {speech.name(other)}"


def _names_of_variables(body: Sequence[Condition], signature: Signature) -> dict[str, str]:
    """What a goal's variables are called: "some person"."""
    found: dict[str, str] = {}
    for condition in body:
        if condition.literal is None:
            continue
        name = condition.literal.predicate
        is_sort = name in signature.sorts
        sorts = (name,) if is_sort else signature.predicates[name].sorts
        for argument, sort in zip(condition.literal.arguments, sorts, strict=True):
            if variables_in(argument) == (argument,) and (is_sort or argument not in found):
                found[argument] = f'"some {sort.replace("_", " ")}"'
    return found
