"""When a robot doubts what it saw, and when it gives up: as if every age of doubt were tried."""

from __future__ import annotations

import itertools
import time
from dataclasses import replace

import clingo
from hypothesis import given, settings
from hypothesis import strategies as st

from seewhy.errors import PlanningError
from seewhy.knowledge.ground import complement_of, fluent_of, literal_of
from seewhy.knowledge.history import read_history
from seewhy.knowledge.language import Knowledge, read_knowledge
from seewhy.planning.diagnosis.belief_state import State
from seewhy.planning.diagnosis.diagnosis import diagnose
from seewhy.planning.diagnosis.persistence_doubt import PersistenceDoubt
from seewhy.planning.domain import PlanningDomain, load_planning_domain
from seewhy.planning.execution.execution import Decision, execute
from seewhy.planning.goal import Goal, read_goal
from seewhy.planning.planner.planner import Plan, PlanStatus, plan

OFFICE = load_planning_domain("robot_assistant")
WORLD = """
#sort place = {a, b, c}.
#fluent basic at(place). #fluent basic shut(place). #fluent basic p. #fluent basic q.
#action go(place). #action x. #action y.
#action exogenous close(place). #action exogenous turn.
go(L) causes at(L). -at(L2) if at(L1), L1 != L2. impossible go(L) if at(L).
impossible go(L) if shut(L). close(L) causes shut(L).
"""
LITERALS = ("at(a)", "at(b)", "shut(b)", "shut(c)", "p", "q")
SIGNED = st.builds(lambda sign, literal: sign + literal, st.sampled_from(("", "-")),
                   st.sampled_from(LITERALS))  # fmt: skip
LAWS = st.builds(
    lambda action, head, body: f"{action} causes {head} if {body}.",
    st.sampled_from(("x", "y", "turn")),
    SIGNED,
    SIGNED,
)
BANS = st.builds(
    lambda action, body: f"impossible {action} if {body}.",
    st.sampled_from(("x", "y", "go(b)")),
    SIGNED,
)
WORLDS = st.tuples(st.lists(LAWS, min_size=1, max_size=4), st.lists(BANS, max_size=3)).map(
    lambda parts: read_knowledge(WORLD + "\n".join(itertools.chain(*parts)))
)
SEEN = st.lists(st.tuples(st.sampled_from(LITERALS), st.booleans(), st.integers(0, 3)),
                max_size=6, unique_by=lambda entry: entry[0])  # fmt: skip


def one_after_the_other(
    domain: PlanningDomain, goal: Goal, now: State, last_seen: dict[clingo.Symbol, int]
) -> tuple[bool, Plan]:
    """The old way: one age of doubt after the other, the least first; whether it was doubted."""
    doubt = PersistenceDoubt(domain.knowledge)
    found = plan(domain.knowledge, goal, start=now, horizon=domain.horizon)
    doubted = False
    for before in sorted({0, *(n for fluent, n in last_seen.items() if fluent in doubt.fluents)}):
        if found.found:
            break
        start = doubt.applied(now, last_seen, before=before)
        found = plan(domain.knowledge, goal, start=start, horizon=domain.horizon)
        doubted = True
    return doubted, found


def in_the_way(
    domain: PlanningDomain, goal: Goal, now: State, last_seen: dict[clingo.Symbol, int]
) -> list[clingo.Symbol]:
    """What is seen last that alone, were it otherwise, would leave a plan."""
    doubt = PersistenceDoubt(domain.knowledge)
    latest = max(last_seen.values(), default=0)
    found = []
    for fluent in sorted(fluent for fluent, step in last_seen.items() if step == latest):
        less = {other: step for other, step in last_seen.items() if other != fluent}
        start = doubt.applied(now, less, before=latest)
        if fluent in start.unknown:
            other = plan(domain.knowledge, goal, start=start, horizon=domain.horizon)
            if other.actions:
                found.append(fluent if fluent in now.holds else complement_of(fluent))
    return found


@settings(max_examples=60)
@given(known=WORLDS, goal=SIGNED, seen=SEEN)
def test_what_is_doubted_is_what_trying_every_age_finds(
    known: Knowledge, goal: str, seen: list[tuple[str, bool, int]]
) -> None:
    text = "observed at(a) at 0. " + " ".join(
        f"observed {'' if true else '-'}{literal} at {step}." for literal, true, step in seen
    )
    try:
        past = read_history(text, known.signature)
        now = diagnose(known, past).now
    except PlanningError:
        return
    except ValueError:
        return  # the same was seen true and false at the same step
    domain = replace(OFFICE, knowledge=known, history=past, sensing=(), robot=None, horizon=6)
    aim = read_goal(goal, known)
    run = next(execute(domain, aim, sensed=[], act=lambda _: []))
    step = run.steps[0]
    if step.decision is Decision.STOP:
        return
    last_seen = {
        fluent_of(clingo.parse_term(str(observation.literal))): observation.step
        for observation in sorted(
            run.history.observations, key=lambda observation: observation.step
        )
    }
    doubted, found = one_after_the_other(domain, aim, now, last_seen)
    if found.status is PlanStatus.ALREADY_TRUE:
        assert not step.plan  # nothing is sensed here, so it cannot be looked at
        return
    assert len(step.plan) == len(found.actions)
    assert (step.decision is Decision.GIVE_UP) == (not found.found)
    if found.found:
        assert step.doubted == doubted
    else:
        usual = diagnose(known, past).states[0].holds
        blamed = in_the_way(domain, aim, now, last_seen)
        unusual = [literal for literal in blamed if complement_of(literal) in usual]
        assert list(step.because) == (unusual or blamed)


def test_giving_up_takes_no_longer_than_going_on() -> None:
    doors = ("closed(kitchen)", "closed(bobs_office)", "closed(johns_office)")
    seen = [literal_of(literal) for literal in (*doors, "loc(rob1, library)", "has(rob1, m1)")]
    absent = [
        literal_of(f"-loc({person}, library)") for person in ("sally", "sarah", "bob", "john")
    ]
    aim = read_goal("message_status(m1, sally, delivered)", OFFICE.knowledge)
    begun = time.perf_counter()
    run = next(execute(OFFICE, aim, sensed=[*seen, *absent], act=lambda _: []))
    # It was ten seconds, when plans were looked for up to the horizon, door by door.
    assert time.perf_counter() - begun < 4.0
    (step,) = run.steps
    assert step.decision is Decision.GIVE_UP
    assert sorted(map(str, step.because)) == sorted(doors)
