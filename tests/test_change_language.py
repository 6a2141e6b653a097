"""Knowledge about change, read: fluents, actions, causal laws, what is impossible, histories."""

from __future__ import annotations

import pytest

from seewhy.errors import KnowledgeError
from seewhy.knowledge.axiom import AxiomKind
from seewhy.knowledge.language import read_knowledge
from seewhy.knowledge.signature import PredicateKind

HEADER = (
    "#sort robot = {rob1}. #sort person = {sally}. #sort agent = robot + person. "
    "#sort place = {library, kitchen}. #static open(place). "
    "#fluent basic loc(agent, place). #fluent defined crowded(place). "
    "#action move(robot, place). #action exogenous wander(person, place).\n"
)
# Statement (6) of the paper, word for word, over the signature that it needs.
PAPER = """
#sort robot = {rob1}.
#sort person = {sally, bob}.
#sort agent = robot + person.
#sort message = {m1}.
#sort status = {delivered, undelivered}.
#sort place = {kitchen, office}.
#static work_place(person, place).
#fluent basic loc(agent, place).
#fluent basic message_status(message, person, status).
#action move(robot, place).
#action deliver(robot, message, person).

move(R, L) causes loc(R, L).
deliver(R, M, P) causes message_status(M, P, delivered).
loc(P, L) if work_place(P, L), not -loc(P, L).
-loc(T, L2) if loc(T, L1), L1 != L2.
impossible deliver(R, M, P) if loc(R, L1), loc(P, L2), L1 != L2.
impossible move(R, L) if loc(R, L).
"""


def below(text: str) -> str:
    """The error that a statement makes below the header, its place counted from the statement."""
    with pytest.raises(KnowledgeError) as problem:
        read_knowledge(HEADER + text)
    return str(problem.value).removeprefix("knowledge.al:2:")


def test_the_statements_of_the_paper_are_read_and_written_as_they_stand() -> None:
    knowledge = read_knowledge(PAPER)
    written = [str(axiom) for axiom in knowledge.axioms]
    assert written == PAPER.strip().splitlines()[-6:]
    assert [axiom.kind for axiom in knowledge.axioms] == [
        AxiomKind.CAUSAL_LAW,
        AxiomKind.CAUSAL_LAW,
        AxiomKind.STATE_CONSTRAINT,
        AxiomKind.STATE_CONSTRAINT,
        AxiomKind.EXECUTABILITY_CONDITION,
        AxiomKind.EXECUTABILITY_CONDITION,
    ]
    assert [str(axiom.action) for axiom in knowledge.axioms][-1] == "move(R, L)"


def test_a_sort_made_of_others_has_their_members_once() -> None:
    signature = read_knowledge(
        "#sort robot = {rob1}. #sort person = {sally, rob1}.\n#sort agent = robot\n + person."
    ).signature
    assert signature.members("agent") == ("rob1", "sally")


def test_declarations_say_what_a_predicate_is() -> None:
    signature = read_knowledge(HEADER).signature
    assert {name: predicate.kind for name, predicate in signature.predicates.items()} == {
        "open": PredicateKind.STATIC,
        "loc": PredicateKind.FLUENT_BASIC,
        "crowded": PredicateKind.FLUENT_DEFINED,
        "move": PredicateKind.ACTION,
        "wander": PredicateKind.EXOGENOUS_ACTION,
    }


def test_positions_behind_causes_are_those_of_the_file() -> None:
    assert below("move(R, L) causes\n  loc(R, kitchn).").startswith(
        "knowledge.al:3:10: 'kitchn' is not of sort 'place'"
    )


IMPOSSIBLE_AND_CAUSES = (
    "in one statement; a causal law reads 'action causes fluent if condition, condition.'"
)
ONE_ACTION = (
    "a causal law reads 'action causes fluent if condition, condition.', with one action and one "
    "literal, got "
)
ERRORS = {
    "static caused": (
        "move(R, L) causes open(L).",
        "1: 'open' is a static; an action causes a basic fluent, declared as "
        "'#fluent basic name(sort, sort).'",
    ),
    "defined fluent caused": (
        "move(R, L) causes crowded(L).",
        "1: 'crowded' is a fluent defined; an action causes a basic fluent, declared as "
        "'#fluent basic name(sort, sort).'",
    ),
    "fluent that causes": (
        "loc(R, L) causes loc(R, L).",
        "1: 'loc' is a fluent basic; before 'causes' stands an action, declared as "
        "'#action name(sort, sort).'",
    ),
    "fluent that is impossible": (
        "impossible loc(R, L).",
        "1: 'loc' is a fluent basic; after 'impossible' stands an action, declared as "
        "'#action name(sort, sort).'",
    ),
    "action as a condition": (
        "crowded(L) if move(R, L).",
        "1: the action 'move' is a condition; actions stand before 'causes' or after "
        "'impossible' only",
    ),
    "action concluded": (
        "move(R, L) if loc(R, L).",
        "1: 'move' is an action, which no axiom concludes; write 'move(…) causes …' or "
        "'impossible move(…) if …'",
    ),
    "static that would change": (
        "open(L) if loc(rob1, L).",
        "1: 'open' is a static, which never changes, but is concluded from the fluent 'loc'; "
        "declare 'open' as '#fluent defined'",
    ),
    "defined fluent denied": (
        "-crowded(L) if open(L).",
        "1: 'crowded' is a defined fluent, which is false wherever no axiom concludes it; "
        "remove this axiom or declare it as '#fluent basic'",
    ),
    "defined fluent by default": (
        "default crowded(L) if open(L).",
        "1: 'crowded' is a defined fluent, and a default speaks of basic fluents; remove "
        "'default' or declare it as '#fluent basic'",
    ),
    "impossible and causes": (
        "impossible move(R, L) causes loc(R, L).",
        f"1: found 'impossible' and 'causes' {IMPOSSIBLE_AND_CAUSES}",
    ),
    "causes twice": (
        "move(R, L) causes loc(R, L) causes crowded(L).",
        f"1: found 'causes' and 'causes' {IMPOSSIBLE_AND_CAUSES}",
    ),
    "denied action causes": (
        "-move(R, L) causes loc(R, L).",
        f"1: {ONE_ACTION}'-move(R, L) causes loc(R, L).'",
    ),
    "two effects": (
        "move(R, L) causes loc(R, L); -loc(R, L).",
        f"1: {ONE_ACTION}'move(R, L) causes loc(R, L); -loc(R, L).'",
    ),
    "denied action impossible": (
        "impossible -move(R, L).",
        "1: what is impossible is an action without '-', got '-move(R, L)'",
    ),
    "unbound in a condition": (
        "impossible move(R, L) if not loc(A, L).",
        "34: nothing says what 'A' ranges over; use it in a condition without 'not', a sort such "
        "as structure(S) for instance",
    ),
    "action of the wrong sort": (
        "move(sally, L) causes loc(rob1, L).",
        "6: 'sally' is not of sort 'robot', which 'move' takes here; it must be one of: rob1",
    ),
    "fluent without a kind": (
        "#fluent at(place).",
        "1: a fluent is declared as '#fluent basic name(sort, sort).' or "
        "'#fluent defined name(sort, sort).', got '#fluent at(place).'",
    ),
    "action without a name": (
        "#action (place).",
        "1: an action is declared as '#action name(sort, sort).' or, where it happens unasked, "
        "'#action exogenous name(sort, sort).', got '#action (place).'",
    ),
    "union with a stranger": (
        "#sort thing = agent + objct.",
        "1: sort 'thing' is made of 'objct', which is no sort declared above; "
        "did you mean 'robot'? (a set of names is written {objct})",
    ),
    "union with the picture": (
        "#sort picture. #sort thing = agent + picture.",
        "16: sort 'thing' is made of 'picture', which stands for the picture; give it sorts with "
        "members",
    ),
}


@pytest.mark.parametrize("kind", ERRORS)
def test_every_error_in_full(kind: str) -> None:
    text, expected = ERRORS[kind]
    assert below(text) == expected
