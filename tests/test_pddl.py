"""Planning problems as PDDL: the whole text, what cannot be said, and another planner's opinion."""

from __future__ import annotations

import pytest

from seewhy.errors import PlanningError
from seewhy.knowledge.history import read_history
from seewhy.knowledge.language import Knowledge, read_knowledge
from seewhy.planning.diagnosis.belief_state import State
from seewhy.planning.diagnosis.diagnosis import diagnose
from seewhy.planning.domain import load_planning_domain
from seewhy.planning.goal import read_goal
from seewhy.planning.planner.pddl import PddlProblem, to_pddl
from seewhy.planning.planner.planner import plan


def start(knowledge: Knowledge, past: str) -> State:
    return diagnose(knowledge, read_history(past, knowledge.signature)).now


def exported(knowledge: Knowledge, goal: str, past: str) -> PddlProblem:
    return to_pddl(knowledge, read_goal(goal, knowledge), start=start(knowledge, past))


HOUSE = read_knowledge("""
#sort place = {hall, attic, cellar}. #static next_to(place, place).
#fluent basic at(place). #fluent basic lamp. #fluent basic carried. #fluent basic wet.
#fluent defined safe(place).
#action go(place). #action take. #action douse.
next_to(hall, attic). next_to(attic, hall). next_to(hall, cellar). next_to(cellar, hall).
go(L) causes at(L).
take causes carried.
take causes lamp if -wet.
douse causes wet.
-at(L2) if at(L1), L1 != L2.
%% what is doused does not burn
-lamp if wet.
safe(L) if place(L), L != cellar.
safe(cellar) if lamp.
impossible go(L) if at(K), not next_to(K, L).
impossible go(L) if not safe(L).
impossible take if -at(attic).
impossible douse if wet.
""")
IN_HALL = "observed at(hall) at 0. observed -lamp at 0. observed -carried at 0. observed -wet at 0."


def test_the_whole_text() -> None:
    found = exported(HOUSE, "at(cellar), carried", IN_HALL)
    assert (
        found.domain
        == """\
(define (domain knowledge)
  (:requirements :strips :negative-preconditions :conditional-effects :derived-predicates)
  (:predicates (carried) (lamp) (wet) (at_attic) (at_cellar) (at_hall) (safe_cellar))
  (:derived (safe_cellar) (and (lamp)))
  ; douse
  (:action douse
    :parameters ()
    :precondition (and (not (wet)))
    :effect (and (wet) (not (lamp))))
  ; take
  (:action take
    :parameters ()
    :precondition (and (at_attic))
    :effect (and (carried) (when (and (not (wet))) (lamp))))
  ; go(attic)
  (:action go_attic
    :parameters ()
    :precondition (and (at_hall))
    :effect (and (at_attic) (not (at_hall))))
  ; go(cellar)
  (:action go_cellar
    :parameters ()
    :precondition (and (at_hall) (safe_cellar))
    :effect (and (at_cellar) (not (at_hall))))
  ; go(hall)
  (:action go_hall
    :parameters ()
    :precondition (and (at_attic))
    :effect (and (at_hall) (not (at_attic))))
  ; go(hall)
  (:action go_hall_2
    :parameters ()
    :precondition (and (at_cellar))
    :effect (and (at_hall) (not (at_cellar))))
)"""
    )
    assert (
        found.problem
        == """\
(define (problem knowledge-problem)
  (:domain knowledge)
  (:init (at_hall))
  (:goal (and (carried) (at_cellar)))
)"""
    )


def test_a_goal_with_a_variable_is_a_choice() -> None:
    found = exported(HOUSE, "at(L), not next_to(L, hall)", IN_HALL)
    assert "(:goal (and (at_hall)))" in found.problem
    found = exported(HOUSE, "at(L), next_to(L, hall)", IN_HALL)
    assert "(:goal (or (and (at_attic)) (and (at_cellar))))" in found.problem


ERRORS = {
    "a count": (
        "#sort n = {a, b}. #fluent basic on(n). #fluent defined two. #action flip(n).\n"
        "flip(N) causes on(N).\n"
        "two if #count { N : on(N) } >= 2.",
        "two",
        "observed -on(a) at 0. observed -on(b) at 0.",
        "knowledge.al:3:1: the axiom 'two if 2 <= #count { N: on(N) }.' asks about several fluents "
        "at once, in a count or with '_'; PDDL cannot say that",
    ),
    "what is left open": (
        "#fluent basic up. #fluent basic low. #action push.\npush causes -low.\nup if not low.",
        "up",
        "observed -up at 0. observed low at 0.",
        "knowledge.al:3:1: the axiom 'up if not low.' asks for 'not low', which leaves open what "
        "happens; PDDL cannot say that",
    ),
    "a basic fluent from a defined one": (
        "#fluent basic up. #fluent basic on. #fluent defined lit. #action push.\n"
        "push causes on. lit if on.\nup if lit.",
        "up",
        "observed -up at 0. observed -on at 0.",
        "knowledge.al:3:1: the axiom 'up if lit.' concludes a basic fluent from 'lit'; PDDL cannot "
        "say that",
    ),
    "what depends on its own denial": (
        "#fluent basic on. #fluent defined odd. #fluent defined lit. #action push.\n"
        "push causes on. lit if on, not odd.\nodd if lit, on.",
        "lit",
        "observed -on at 0.",
        "knowledge.al:2:17: the axiom 'lit if on, not odd.' depends on its own denial; PDDL cannot "
        "say that",
    ),
    "what is unknown": (
        "#fluent basic key. #fluent basic open. #action push. push causes open.\n"
        "impossible push if -key.",
        "open",
        "observed -open at 0.",
        "whether 'key' holds at the start is unknown, and it matters to the goal; observe it, or "
        "add a default to the knowledge",
    ),
}


@pytest.mark.parametrize("kind", ERRORS)
def test_what_pddl_cannot_say(kind: str) -> None:
    text, goal, past, expected = ERRORS[kind]
    with pytest.raises(PlanningError) as problem:
        exported(read_knowledge(text), goal, past)
    assert str(problem.value) == expected


@pytest.mark.parametrize(
    "goal",
    [
        "message_status(m1, sarah, delivered), loc(rob1, L), loc(sally, L)",
        "message_status(m1, bob, delivered), message_status(m2, sally, delivered)",
        "loc(rob1, bathroom), -has(rob1, m1)",
    ],
)
def test_another_planner_needs_as_many_actions(goal: str) -> None:
    pytest.importorskip("up_pyperplan")
    io = pytest.importorskip("unified_planning.io")
    shortcuts = pytest.importorskip("unified_planning.shortcuts")
    shortcuts.get_environment().credits_stream = None
    known = load_planning_domain("robot_assistant").knowledge
    past = "observed loc(rob1, library) at 0."
    ours = plan(known, read_goal(goal, known), start=start(known, past))
    text = exported(known, goal, past)
    problem = io.PDDLReader().parse_problem_string(text.domain, text.problem)
    with shortcuts.OneshotPlanner(name="pyperplan-opt") as engine:
        theirs = engine.solve(problem).plan
    assert (theirs is None) == (not ours.found)
    assert theirs is None or len(theirs.actions) == len(ours.actions)
