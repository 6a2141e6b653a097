"""The simulated world, and the robot that pursues a goal in it."""

from __future__ import annotations

import itertools
from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Any

import clingo
import numpy as np
import pytest
from gymnasium.utils.env_checker import check_env

from seewhy.knowledge.axiom import Literal
from seewhy.knowledge.language import Knowledge
from seewhy.planning.diagnosis.belief_state import State
from seewhy.planning.diagnosis.diagnosis import diagnose
from seewhy.planning.diagnosis.persistence_doubt import PersistenceDoubt
from seewhy.planning.domain import load_planning_domain
from seewhy.planning.execution import execution
from seewhy.planning.execution.environment import PlanningEnvironment
from seewhy.planning.execution.execution import Decision, Outcome, Run, execute
from seewhy.planning.execution.plan_monitoring import suppositions
from seewhy.planning.execution.transition_function import World
from seewhy.planning.goal import Goal, read_goal
from seewhy.planning.planner.planner import Plan
from seewhy_lab.gymnasium_environment import GymnasiumEnvironment

OFFICE = load_planning_domain("robot_assistant")
TO_SALLY = read_goal("message_status(m1, sally, delivered)", OFFICE.knowledge)


@pytest.fixture(scope="module")
def environment() -> PlanningEnvironment:
    return PlanningEnvironment(OFFICE, goal=TO_SALLY)


def term(text: str) -> clingo.Symbol:
    return clingo.parse_term(text)


def world(environment: PlanningEnvironment, *literals: str) -> World:
    """A world in which these hold, and else what is usual."""
    usual = sorted(diagnose(OFFICE.knowledge, OFFICE.history).states[0].holds)
    return environment.transitions.complete([*map(term, literals), *usual])


def run(
    environment: PlanningEnvironment,
    start: World,
    script: Callable[[int, World], World] = lambda _, state: state,
    *,
    goal: Goal = TO_SALLY,
    most_steps: int = 40,
) -> Run:
    """Pursue the goal in a world without chance, which ``script`` changes after each step."""
    environment.reset(seed=0, options={"state": start})
    state = start
    steps = itertools.count(1)

    def seen() -> list[Literal]:
        shown = np.zeros(len(environment.fluents), dtype=np.int8)
        for fluent, _ in environment.sensors.sensed(state):
            shown[environment.fluents.index(fluent)] = 2 if fluent in state else 1
        return environment.read(shown)

    def act(action: clingo.Symbol) -> list[Literal]:
        nonlocal state
        state = script(next(steps), environment.transitions.after(state, [action]) or state)
        return seen()

    *_, last = execute(OFFICE, goal, sensed=seen(), act=act, most_steps=most_steps)
    return last


def decisions(found: Run) -> list[str]:
    return [step.decision.value for step in found.steps]


def test_a_plan_that_works_is_persisted_in(environment: PlanningEnvironment) -> None:
    found = run(environment, world(environment))
    assert decisions(found) == ["plan", "persist", "persist", "stop"]
    assert list(map(str, found.actions)) == [
        "move(rob1,kitchen)",
        "move(rob1,sallys_office)",
        "deliver(rob1,m1,sally)",
    ]
    assert found.outcome is Outcome.ACHIEVED
    assert not any(step.surprises for step in found.steps)


def test_somebody_met_on_the_way_makes_the_rest_needless(environment: PlanningEnvironment) -> None:
    found = run(environment, world(environment, "loc(sally,kitchen)"))
    assert decisions(found) == ["plan", "skip", "stop"]
    assert list(map(str, found.steps[1].skipped)) == ["move(rob1,sallys_office)"]
    assert [str(surprise.what) for surprise in found.steps[1].surprises] == [
        "loc(sally,sallys_office)"
    ]


def test_a_goal_reached_by_luck_stops_the_robot() -> None:
    seen = Literal("message_status", ("m1", "sally", "delivered"))
    (found,) = execute(OFFICE, TO_SALLY, sensed=[seen], act=lambda _: [])
    assert decisions(found) == ["stop"]


def test_somebody_who_is_away_is_looked_for_where_she_was_not_seen(
    environment: PlanningEnvironment,
) -> None:
    found = run(environment, world(environment, "loc(sally,johns_office)"))
    assert found.outcome is Outcome.ACHIEVED
    visited = [str(action.arguments[1]) for action in found.actions if action.name == "move"]
    assert visited[-1] == "johns_office"
    searched = [place for place in visited if place not in ("kitchen", "library")]
    assert len(searched) == len(set(searched))  # nowhere twice


def test_a_door_that_closes_is_a_reason_to_give_up(environment: PlanningEnvironment) -> None:
    closed = world(environment, "closed(kitchen)", "closed(bobs_office)", "closed(johns_office)")
    found = run(environment, closed)
    assert decisions(found) == ["give up"]
    assert found.outcome is Outcome.IMPOSSIBLE
    assert list(map(str, found.steps[0].because)) == [
        "closed(bobs_office)",
        "closed(johns_office)",
        "closed(kitchen)",
    ]


def test_a_lost_message_is_printed_again(environment: PlanningEnvironment) -> None:
    def lose(step: int, state: World) -> World:
        if step != 1:
            return state
        return environment.transitions.after(state, [term("lose(m1)")]) or state

    found = run(environment, world(environment), lose)
    assert found.outcome is Outcome.ACHIEVED
    assert "print(rob1,m1)" in map(str, found.actions)
    assert [(str(surprise.what), surprise.step) for surprise in found.steps[1].surprises] == [
        ("lose(m1)", 0)
    ]


def test_the_most_steps_bound_a_run(environment: PlanningEnvironment) -> None:
    found = run(environment, world(environment), most_steps=1)
    assert found.outcome is Outcome.OUT_OF_STEPS
    assert len(found.actions) == 1


def test_the_environment_is_one_of_gymnasium(environment: PlanningEnvironment) -> None:
    check_env(GymnasiumEnvironment(environment), skip_render_check=True)


def test_a_seed_settles_everything(environment: PlanningEnvironment) -> None:
    def episode(seed: int) -> list[bytes]:
        observation, _ = environment.reset(seed=seed)
        seen = [observation.tobytes()]
        for action in range(12):
            observation, *_ = environment.step(action)
            seen.append(observation.tobytes())
        return seen

    assert episode(3) == episode(3)
    assert episode(3) != episode(4)


def test_what_is_impossible_has_no_effect(environment: PlanningEnvironment) -> None:
    start = world(environment)
    environment.reset(seed=0, options={"state": start})
    *_, info = environment.step(environment.number(term("deliver(rob1,m1,bob)")))
    assert info["happening"].failed
    assert term("message_status(m1,bob,undelivered)") in environment.state


def test_the_goal_truly_reached_ends_an_episode(environment: PlanningEnvironment) -> None:
    start = world(environment, "loc(sally,library)")
    for seed in range(5):  # one of them without a failed delivery
        environment.reset(seed=seed, options={"state": start})
        _, reward, ended, _, info = environment.step(
            environment.number(term("deliver(rob1,m1,sally)"))
        )
        assert (reward == 1.0) == ended == (not info["happening"].failed)


def test_decisions_have_words_of_their_own() -> None:
    assert len({decision.value for decision in Decision}) == len(Decision)


def test_a_goal_that_may_hold_already_is_looked_at(environment: PlanningEnvironment) -> None:
    together = read_goal("loc(sally, kitchen), loc(bob, kitchen)", OFFICE.knowledge)
    start = world(environment, "loc(sally,kitchen)", "loc(bob,kitchen)")
    found = run(environment, start, goal=together)
    assert list(map(str, found.actions)) == ["move(rob1,kitchen)"]
    assert found.outcome is Outcome.ACHIEVED


def test_a_count_that_may_be_reached_is_looked_at(environment: PlanningEnvironment) -> None:
    crowd = read_goal("#count { P : loc(P, kitchen) } >= 3", OFFICE.knowledge)
    found = run(
        environment, world(environment, "loc(sally,kitchen)", "loc(bob,kitchen)"), goal=crowd
    )
    assert found.outcome is Outcome.ACHIEVED


@pytest.mark.parametrize(
    ("literals", "supposing"),
    [
        ((), 0),  # she is where she usually is
        (("loc(sally,library)",), 0),  # she is seen at once
        (("loc(sally,bobs_office)",), 3),  # she is looked for in three places
    ],
)
def test_what_a_plan_supposes_is_worked_out_only_where_the_search_left_something_open(
    environment: PlanningEnvironment,
    monkeypatch: pytest.MonkeyPatch,
    literals: tuple[str, ...],
    supposing: int,
) -> None:
    worked_out = []

    def noted(
        knowledge: Knowledge, goal: Goal, actions: Sequence[clingo.Symbol], *, start: State
    ) -> tuple[clingo.Symbol, ...]:
        worked_out.append(suppositions(knowledge, goal, actions, start=start))
        return worked_out[-1]

    monkeypatch.setattr(execution, "suppositions", noted)
    found = run(environment, world(environment, *literals))
    assert len(worked_out) == supposing
    assert worked_out == [step.supposed for step in found.plans if step.supposed]
    # Were it worked out for every plan, nothing would be otherwise.
    monkeypatch.setattr(Plan, "settles", lambda plan, _: plan.found)
    whole = run(environment, world(environment, *literals))
    assert len(worked_out) == supposing + len(whole.plans)
    assert [replace(step, planning_seconds=0.0) for step in whole.steps] == [
        replace(step, planning_seconds=0.0) for step in found.steps
    ]


@pytest.mark.parametrize(
    ("literals", "ends"),
    [
        (("loc(sally,bobs_office)",), Decision.STOP),
        (("closed(kitchen)", "closed(bobs_office)", "closed(johns_office)"), Decision.GIVE_UP),
    ],
)
def test_the_clock_of_planning_runs_in_looking_for_plans_alone(
    environment: PlanningEnvironment,
    monkeypatch: pytest.MonkeyPatch,
    literals: tuple[str, ...],
    ends: Decision,
) -> None:
    """Everything that a robot does takes an hour by this clock, and looking for a plan a second."""
    clock, explaining = Counter[str](), list[bool]()

    def taking(place: object, name: str, kind: str, seconds: int) -> None:
        original = getattr(place, name)

        def slow(*arguments: Any, **options: Any) -> Any:
            clock["now"] += seconds
            clock[kind] += not explaining
            return original(*arguments, **options)

        monkeypatch.setattr(place, name, slow)

    monkeypatch.setattr(execution.time, "process_time", lambda: float(clock["now"]))
    taking(execution, "plan", "plan", 1)
    for name in ("diagnose", "reaches_goal", "suppositions", "goal_holds"):
        taking(execution, name, name, 3600)
    taking(PersistenceDoubt, "applied", "doubt", 3600)
    in_the_way = execution._Robot._in_the_way

    def explained(*arguments: Any) -> Any:
        explaining.append(True)
        try:
            return in_the_way(*arguments)
        finally:
            explaining.pop()

    monkeypatch.setattr(execution._Robot, "_in_the_way", explained)
    found = run(environment, world(environment, *literals))
    assert found.steps[-1].decision is ends
    assert sum(step.planning_seconds for step in found.steps) == clock["plan"]
    assert all((step.planning_seconds > 0) == (step in found.plans) for step in found.steps[:-1])
