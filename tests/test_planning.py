"""Histories, diagnoses and plans, on the office building and on small random worlds."""

from __future__ import annotations

import itertools
from collections import deque
from collections.abc import Sequence

import clingo
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from seewhy.errors import KnowledgeError, PlanningError
from seewhy.knowledge.history import History, read_history
from seewhy.knowledge.language import Knowledge, read_knowledge
from seewhy.planning.diagnosis.belief_state import State
from seewhy.planning.diagnosis.diagnosis import Diagnosis, diagnose, diagnosis_program
from seewhy.planning.domain import load_planning_domain
from seewhy.planning.goal import REACHED, read_goal, with_goal
from seewhy.planning.planner.planner import Plan, PlanStatus, plan

OFFICE = load_planning_domain("robot_assistant").knowledge
IN_LIBRARY = "observed loc(rob1, library) at 0. "
SALLY_GONE = (
    IN_LIBRARY + "happened move(rob1, kitchen) at 0. happened move(rob1, sallys_office) at 1. "
    "observed -loc(sally, sallys_office) at 2. "
)


def history(text: str, knowledge: Knowledge = OFFICE) -> History:
    return read_history(text, knowledge.signature)


def after(text: str) -> Diagnosis:
    return diagnose(OFFICE, history(text))


def surprises(text: str) -> list[tuple[int, str, str]]:
    return [
        (surprise.step, surprise.kind.value, str(surprise.what))
        for surprise in after(text).surprises
    ]


def places(diagnosis: Diagnosis) -> list[str]:
    return [str(fluent) for fluent in diagnosis.now.positive("loc")]


def planned(goal: str, text: str = IN_LIBRARY) -> Plan:
    return plan(OFFICE, read_goal(goal, OFFICE), start=after(text).now)


# Beliefs and diagnoses


def test_people_are_in_their_offices_until_they_are_seen_elsewhere() -> None:
    usual = after(IN_LIBRARY)
    assert places(usual) == [
        "loc(bob,bobs_office)",
        "loc(john,johns_office)",
        "loc(rob1,library)",
        "loc(sally,sallys_office)",
        "loc(sarah,sarahs_office)",
    ]
    assert usual.surprises == ()


def test_somebody_observed_absent_is_nowhere_that_is_known() -> None:
    gone = after(SALLY_GONE)
    assert not [fluent for fluent in places(gone) if fluent.startswith("loc(sally,")]
    assert surprises(SALLY_GONE) == [(0, "exception", "loc(sally,sallys_office)")]
    assert clingo.parse_term("loc(sally,library)") in gone.now.unknown


def test_what_is_clear_from_the_first_look_is_no_surprise() -> None:
    assert surprises("observed loc(sally, library) at 0.") == []
    assert surprises("observed loc(sally, library) at 1. happened move(rob1, kitchen) at 0.") == [
        (0, "exception", "loc(sally,sallys_office)")
    ]


def test_somebody_seen_before_must_have_walked() -> None:
    seen = "observed -loc(sally, kitchen) at 1. happened move(rob1, kitchen) at 2. "
    found = SALLY_GONE + seen + "observed loc(sally, kitchen) at 3."
    # The latest event that explains what was seen, beside the exception: she was not in her office.
    assert surprises(SALLY_GONE + "observed loc(sally, sallys_office) at 1. ")[0][:2] == (
        1,
        "event",
    )
    assert "loc(sally,kitchen)" in places(after(found))
    assert (1, "event", "walk(sally,kitchen)") in surprises(found)


def test_an_attempt_without_effect_failed() -> None:
    text = IN_LIBRARY + "attempted move(rob1, kitchen) at 0. observed loc(rob1, library) at 1."
    assert surprises(text) == [(0, "failed", "move(rob1,kitchen)")]


def test_a_sensor_may_be_wrong_only_where_that_is_allowed() -> None:
    text = IN_LIBRARY + "observed loc(rob1, kitchen) at 1."
    with pytest.raises(PlanningError, match="nothing that may be assumed explains this history"):
        after(text)
    found = diagnose(OFFICE, history(text), sensors_err=True).surprises
    assert [surprise.kind.value for surprise in found] == ["misread"]


def test_what_nothing_explains_is_named() -> None:
    text = IN_LIBRARY + "happened move(rob1, bathroom) at 0."
    with pytest.raises(PlanningError) as problem:
        after(text)
    assert str(problem.value) in {
        "nothing that may be assumed explains this history as long as it says 'observed "
        "loc(rob1, library) at 0'; correct it, or add to the knowledge what could have happened",
        "nothing that may be assumed explains this history as long as it says 'happened "
        "move(rob1, bathroom) at 0'; correct it, or add to the knowledge what could have happened",
    }


HISTORY_ERRORS = {
    "nothing": (
        "saw loc(bob, kitchen) at 1.",
        "h.al:1:1: a history says 'observed literal at step.', 'happened action at step.' or "
        "'attempted action at step.', got 'saw loc(bob, kitchen) at 1.'; it must be one of: "
        "observed, happened, attempted",
    ),
    "no step": (
        "observed loc(bob, kitchen).",
        "h.al:1:1: a history says 'observed literal at step.', 'happened action at step.' or "
        "'attempted action at step.', got 'observed loc(bob, kitchen).'",
    ),
    "unknown person": (
        "observed loc(bobb, kitchen) at 1.",
        "h.al:1:10: 'bobb' is not of sort 'agent', which 'loc' takes; did you mean 'bob'?",
    ),
    "unknown action": (
        "happened mov(rob1, kitchen) at 1.",
        "h.al:1:10: 'mov' is no action; did you mean 'move'?",
    ),
    "a fluent that happens": (
        "happened loc(rob1, kitchen) at 1.",
        "h.al:1:10: 'loc' is a fluent basic and no action; did you mean 'unlock'?",
    ),
    "denied action": (
        "happened -move(rob1, kitchen) at 1.",
        "h.al:1:10: an action happens or does not; remove '-' from '-move(rob1, kitchen)'",
    ),
    "variable": (
        "observed loc(bob, X) at 1.",
        "h.al:1:10: 'loc(bob, X)' has an argument that is no name and no number; give each "
        "argument of it one value",
    ),
    "too few": (
        "observed loc(bob) at 1.",
        "h.al:1:10: 'loc' takes 2 arguments (agent, place), got 'loc(bob)'",
    ),
    "no literal": (
        "observed bob is there at 1.",
        "h.al:1:10: 'bob is there' is no fluent; write one such as loc(rob1, bobs_office)",
    ),
    "contradiction": (
        "observed closed(kitchen) at 1.\nobserved -closed(kitchen) at 1.",
        "h.al:2:1: '-closed(kitchen)' was observed at step 1, and its opposite at h.al:1:1; "
        "remove one of the two",
    ),
}


@pytest.mark.parametrize("kind", HISTORY_ERRORS)
def test_every_error_of_a_history(kind: str) -> None:
    text, expected = HISTORY_ERRORS[kind]
    with pytest.raises(KnowledgeError) as problem:
        read_history(text, OFFICE.signature, file="h.al")
    assert str(problem.value) == expected


# Plans


def test_the_problem_of_the_paper() -> None:
    found = planned("message_status(m1, sarah, delivered), loc(rob1, L), loc(sally, L)")
    assert [str(action) for action in found.actions] == [
        "move(rob1,kitchen)",
        "move(rob1,sarahs_office)",
        "deliver(rob1,m1,sarah)",
        "move(rob1,kitchen)",
        "move(rob1,sallys_office)",
    ]
    assert len(found.states) == 6
    assert [str(fluent) for fluent in found.states[2].positive("loc") if "rob1" in str(fluent)] == [
        "loc(rob1,sarahs_office)"
    ]


def test_a_goal_that_is_true_already_needs_no_action() -> None:
    assert planned("loc(rob1, library)").status is PlanStatus.ALREADY_TRUE


def test_people_do_not_walk_because_the_robot_wishes() -> None:
    assert planned("loc(sally, library)").status is PlanStatus.UNREACHABLE


def test_a_closed_door_makes_what_is_behind_it_unreachable() -> None:
    closed = IN_LIBRARY + "observed closed(kitchen) at 0."
    found = planned("message_status(m1, sarah, delivered)", closed)
    assert (found.status, found.actions) == (PlanStatus.UNREACHABLE, ())


def test_somebody_unknown_is_supposed_where_the_way_is_shortest() -> None:
    found = planned("message_status(m1, sally, delivered)", SALLY_GONE)
    assert [str(action) for action in found.actions] == [
        "move(rob1,kitchen)",
        "deliver(rob1,m1,sally)",
    ]


def test_the_horizon_bounds_the_search() -> None:
    goal = read_goal("message_status(m1, sarah, delivered)", OFFICE)
    start = after(IN_LIBRARY).now
    assert plan(OFFICE, goal, start=start, horizon=2).status is PlanStatus.NOT_WITHIN_HORIZON
    assert plan(OFFICE, goal, start=start, seconds=0.0).status is PlanStatus.OUT_OF_TIME


GOAL_ERRORS = {
    "unknown person": (
        "loc(saly, kitchen)",
        "'saly' is not of sort 'agent', which 'loc' takes here; did you mean 'sally'?",
    ),
    "unknown place": (
        "loc(sally, kitchn)",
        "'kitchn' is not of sort 'place', which 'loc' takes here; did you mean 'kitchen'?",
    ),
    "unknown fluent": ("lok(sally, kitchen)", "'lok' is not declared; did you mean 'loc'?"),
    "no condition": (
        "loc(rob1, kitchen) and loc(bob, kitchen)",
        "syntax error, unexpected a name; conditions are separated by commas",
    ),
    "an action": (
        "move(rob1, kitchen)",
        "the action 'move' is a condition; actions stand before 'causes' or after 'impossible' "
        "only",
    ),
}


@pytest.mark.parametrize("kind", GOAL_ERRORS)
def test_every_error_of_a_goal(kind: str) -> None:
    text, expected = GOAL_ERRORS[kind]
    with pytest.raises(PlanningError) as problem:
        read_goal(text, OFFICE)
    assert str(problem.value) == f"the goal '{text}' cannot be used: {expected}"


def test_an_empty_goal_is_refused() -> None:
    with pytest.raises(PlanningError) as problem:
        read_goal(" ", OFFICE)
    assert str(problem.value) == (
        'the goal is empty; say what shall hold, such as "loc(rob1, bobs_office)"'
    )


# Shortest, against breadth-first search in Python over random maps

PLACES = "abcdef"


def building(edges: list[tuple[str, str]], locked: list[str]) -> Knowledge:
    lines = [
        "#sort place = {a, b, c, d, e, f}. #static next_to(place, place). #static locked(place).",
        "#fluent basic at(place). #fluent basic key. #fluent defined open(place).",
        "#action go(place). #action take.",
        "go(L) causes at(L). take causes key.",
        "-at(L2) if at(L1), L1 != L2.",
        "open(L) if not locked(L). open(L) if key.",
        "impossible go(L) if at(K), not next_to(K, L).",
        "impossible go(L) if not open(L).",
        "impossible take if not at(b).",
        *(f"next_to({one}, {other}). next_to({other}, {one})." for one, other in edges),
        *(f"locked({place})." for place in locked),
    ]
    text = "\n".join(lines).replace(
        "open(L) if not locked(L).", "open(L) if place(L), not locked(L)."
    )
    return read_knowledge(text.replace("open(L) if key.", "open(L) if place(L), key."))


def shortest(edges: list[tuple[str, str]], locked: list[str], goal: str) -> int | None:
    """The least number of actions from a without the key, found without any logic."""
    waiting, seen = deque([(("a", False), 0)]), {("a", False)}
    while waiting:
        (place, key), steps = waiting.popleft()
        if place == goal:
            return steps
        following = [
            (other, key)
            for one, other in itertools.chain(edges, ((b, a) for a, b in edges))
            if one == place and (key or other not in locked)
        ]
        following += [(place, True)] if place == "b" else []
        for state in following:
            if state not in seen:
                seen.add(state)
                waiting.append((state, steps + 1))
    return None


@settings(max_examples=25)
@given(
    edges=st.lists(
        st.tuples(st.sampled_from(PLACES), st.sampled_from(PLACES)).filter(lambda e: e[0] != e[1]),
        max_size=8,
    ),
    locked=st.lists(st.sampled_from("cdef"), max_size=3, unique=True),
    goal=st.sampled_from(PLACES),
)
def test_plans_are_as_short_as_can_be(
    edges: list[tuple[str, str]], locked: list[str], goal: str
) -> None:
    known = building(edges, locked)
    start = diagnose(known, history("observed at(a) at 0. observed -key at 0.", known)).now
    found = plan(known, read_goal(f"at({goal})", known), start=start, horizon=9)
    best = shortest(edges, locked, goal)
    assert (len(found.actions) if found.found else None) == best


# Shortest, against breadth-first search over answer sets, in random worlds

WORLD = """
#sort place = {a, b, c}.
#fluent basic at(place). #fluent basic p. #fluent basic q. #fluent basic r.
#fluent defined d. #fluent defined e.
#action go(place). #action x. #action y. #action z.
go(L) causes at(L).
-at(L2) if at(L1), L1 != L2.
impossible go(L) if at(L).
"""
ATOMS = ("at(a)", "at(b)", "at(c)", "p", "q", "r")
BASIC = st.builds(
    lambda sign, atom: sign + atom, st.sampled_from(("", "-")), st.sampled_from(ATOMS)
)
ANY = st.builds(
    lambda sign, atom: sign + atom,
    st.sampled_from(("", "-", "not ", "not -")),
    st.sampled_from((*ATOMS, "d")),
)
ACTIONS = st.sampled_from(("go(a)", "go(b)", "go(c)", "x", "y", "z"))


def bodies(conditions: st.SearchStrategy[str], least: int = 0) -> st.SearchStrategy[str]:
    return st.lists(conditions, min_size=least, max_size=2, unique=True).map(", ".join)


def statement(head: str, body: str) -> str:
    return f"{head} if {body}." if body else f"{head}."


LAWS = st.builds(
    lambda action, head, body: statement(f"{action} causes {head}", body),
    ACTIONS,
    BASIC,
    bodies(ANY),
)
BANS = st.builds(
    lambda action, body: statement(f"impossible {action}", body), ACTIONS, bodies(ANY, 1)
)
# With 'not', a constraint could change what no action does.
CONSTRAINTS = st.builds(statement, BASIC, bodies(BASIC, 1))
DEFINITIONS = st.one_of(
    st.builds(lambda body: statement("d", body), bodies(BASIC, 1)),
    st.builds(lambda body: statement("e", body), bodies(ANY, 1)),
)
WORLDS = st.tuples(
    st.lists(LAWS, min_size=2, max_size=6),
    st.lists(BANS, max_size=4),
    st.lists(CONSTRAINTS, max_size=2),
    st.lists(DEFINITIONS, max_size=3),
).map(lambda parts: read_knowledge(WORLD + "\n".join(itertools.chain(*parts))))

Beliefs = frozenset[clingo.Symbol]


def following(knowledge: Knowledge, before: Beliefs, action: clingo.Symbol) -> set[Beliefs]:
    """The states that may follow when an action is done, as diagnosis sees it."""
    return answer_states(
        knowledge,
        " ".join(
            [*(f":- not holds({literal}, 0)." for literal in before), f"happened({action}, 0)."]
        ),
        last=1,
    )


def answer_states(knowledge: Knowledge, text: str, *, last: int) -> set[Beliefs]:
    control = clingo.Control(["--warn=none", "0", "--opt-mode=ignore"], logger=lambda *_: None)
    control.add(diagnosis_program(knowledge, last=last) + text)
    control.ground()
    found: set[Beliefs] = set()
    with control.solve(yield_=True) as models:
        for model in models:
            shown = [atom for atom in model.symbols(shown=True) if atom.name == "holds"]
            found.add(
                frozenset(atom.arguments[0] for atom in shown if atom.arguments[1].number == last)
            )
    return found


def least_actions(knowledge: Knowledge, goal: str, start: State, horizon: int) -> int | None:
    aimed = with_goal(knowledge, read_goal(goal, knowledge))
    facts = " ".join(f":- not holds({literal}, 0)." for literal in start.holds)
    states = answer_states(aimed, facts, last=0)
    actions = [clingo.parse_term(action) for action in ("go(a)", "go(b)", "go(c)", "x", "y", "z")]
    seen = set(states)
    for steps in range(horizon + 1):
        if any(clingo.Function(REACHED, []) in state for state in states):
            return steps
        states = {
            after
            for state, action in itertools.product(states, actions)
            for after in following(aimed, state, action)
        } - seen
        seen |= states
    return None


def reaches_whatever_is_unknown(
    knowledge: Knowledge, goal: str, start: State, actions: Sequence[clingo.Symbol]
) -> bool:
    aimed = with_goal(knowledge, read_goal(goal, knowledge))
    facts = " ".join(f":- not holds({literal}, 0)." for literal in start.holds)
    for complete in answer_states(aimed, facts, last=0):
        ends = {complete}
        for action in actions:
            ends = {end for before in ends for end in following(aimed, before, action)}
        if not any(clingo.Function(REACHED, []) in end for end in ends):
            return False
    return True


@settings(max_examples=25)
@given(
    known=WORLDS,
    goal=bodies(ANY, 1),
    where=st.sampled_from(("observed at(a) at 0. ", "observed -at(b) at 0. ", "")),
    seen=st.lists(st.sampled_from(("p", "q", "r")), unique=True),
    signs=st.tuples(*[st.sampled_from(("", "-"))] * 3),
)
def test_plans_are_as_short_as_can_be_in_random_worlds(
    known: Knowledge, goal: str, where: str, seen: list[str], signs: tuple[str, str, str]
) -> None:
    past = where + " ".join(
        f"observed {sign}{fluent} at 0." for fluent, sign in zip(seen, signs, strict=False)
    )
    try:
        start = diagnose(known, history(past, known)).now
    except PlanningError:
        return
    found = plan(known, read_goal(goal, known), start=start, horizon=4)
    assert (len(found.actions) if found.found else None) == least_actions(known, goal, start, 4)
    alone = plan(known, read_goal(goal, known), start=start, horizon=4, answer_sets=True)
    assert (alone.found, len(alone.actions)) == (found.found, len(found.actions))
    assert len(found.states) == (len(found.actions) + 1 if found.found else 0)
    for before, action, after in zip(found.states, found.actions, found.states[1:], strict=False):
        # What stays unknown may be either way.
        assert any(after.holds <= state for state in following(known, before.holds, action))
    if found.found and not found.settles(start):
        assert reaches_whatever_is_unknown(known, goal, start, found.actions)


def test_the_states_of_a_plan_tell_what_no_way_to_the_goal_asks_about() -> None:
    known = read_knowledge(WORLD + "d if at(a). impossible go(a) if at(a), d.")
    start = diagnose(known, history("observed at(a) at 0.", known)).now
    before, after = plan(known, read_goal("at(b)", known), start=start).states
    d = clingo.Function("d")
    assert d in before.holds
    assert d not in after.holds


def test_what_an_axiom_touches_but_nothing_makes_false_stays_true() -> None:
    known = read_knowledge("#fluent basic p. #fluent basic r. #action x. x causes r. p if -r, p.")
    start = diagnose(known, history("observed p at 0. observed -r at 0.", known)).now
    assert not plan(known, read_goal("not p", known), start=start).found
