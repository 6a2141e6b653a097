"""The second planning domain: towers of boxes, some of which would not stand."""

from __future__ import annotations

import itertools
from collections import deque
from collections.abc import Callable, Iterator

import pytest

from seewhy.check.change import check_change
from seewhy.knowledge.history import read_history
from seewhy.planning.diagnosis.belief_state import State
from seewhy.planning.diagnosis.diagnosis import Diagnosis, diagnose
from seewhy.planning.domain import load_planning_domain
from seewhy.planning.execution.simulation import simulate
from seewhy.planning.goal import read_goal
from seewhy.planning.planner.planner import Plan, PlanStatus, plan

DOMAIN = load_planning_domain("tower_building")
KNOWLEDGE = DOMAIN.knowledge
AT_FIRST = "observed on(b5, b3) at 0. "


def after(text: str) -> Diagnosis:
    return diagnose(KNOWLEDGE, read_history(text, KNOWLEDGE.signature))


def surprises(text: str) -> list[tuple[int, str, str]]:
    return [
        (surprise.step, surprise.kind.value, str(surprise.what))
        for surprise in after(text).surprises
    ]


def planned(goal: str, text: str = AT_FIRST, *, horizon: int = 24) -> Plan:
    return plan(KNOWLEDGE, read_goal(goal, KNOWLEDGE), start=after(text).now, horizon=horizon)


def names(state: State, predicate: str) -> set[str]:
    return set(map(str, state.positive(predicate)))


# The same rules without any logic: stacks as tuples from the table up, and the box that is held.

Stacks = frozenset[tuple[str, ...]]
Tower = tuple[Stacks, str | None]
LARGE, NOTHING_STAYS_ON = {"b3", "b4"}, {"b5", "b6"}


def stays(box: str, stack: tuple[str, ...], heavy: frozenset[str]) -> bool:
    top = stack[-1]
    return not (
        (box in LARGE and top not in LARGE)
        or top in NOTHING_STAYS_ON
        or (box in heavy and top not in heavy)
        or (stack[0] not in LARGE and len(stack) >= 2)
    )


def following(tower: Tower, heavy: frozenset[str]) -> Iterator[Tower]:
    stacks, held = tower
    for stack in stacks:
        rest = stacks - {stack}
        if held is None:
            yield rest | ({stack[:-1]} if stack[:-1] else set()), stack[-1]
        elif stays(held, stack, heavy):
            yield rest | {(*stack, held)}, None
    if held is not None:
        yield stacks | {(held,)}, None


def shortest(
    reached: Callable[[Tower], bool], first: Stacks, heavy: frozenset[str] = frozenset()
) -> int | None:
    start: Tower = (first, None)
    waiting, seen = deque([(start, 0)]), {start}
    while waiting:
        tower, steps = waiting.popleft()
        if reached(tower):
            return steps
        for other in following(tower, heavy):
            if other not in seen:
                seen.add(other)
                waiting.append((other, steps + 1))
    return None


def has_height(box: str, number: int) -> Callable[[Tower], bool]:
    return lambda tower: any(stack[number - 1 : number] == (box,) for stack in tower[0])


def tower_of(number: int) -> Callable[[Tower], bool]:
    return lambda tower: any(len(stack) == number for stack in tower[0])


def on(upper: str, lower: str) -> Callable[[Tower], bool]:
    return lambda tower: any((lower, upper) in itertools.pairwise(s) for s in tower[0])


USUAL: Stacks = frozenset({("b1",), ("b2",), ("b3", "b5"), ("b4",), ("b6",)})
LOW: Stacks = frozenset({("b4", "b3", "b1"), ("b2", "b5"), ("b6",)})
LOW_TEXT = "observed on(b3, b4) at 0. observed on(b1, b3) at 0. observed on(b5, b2) at 0. "
GOALS: dict[str, Callable[[Tower], bool]] = {
    "height(b1, 3)": has_height("b1", 3),
    "height(b4, 2)": has_height("b4", 2),
    "height(b3, 2), height(b2, 4)": lambda t: has_height("b3", 2)(t) and has_height("b2", 4)(t),
    "tower_of(2)": tower_of(2),
    "tower_of(5)": tower_of(5),
    "on(b5, b1), on(b1, b2)": lambda t: on("b5", "b1")(t) and on("b1", "b2")(t),
    "holding(rob1, b3)": lambda t: t[1] == "b3",
    "height(b6, 5), height(b5, 2)": lambda t: has_height("b6", 5)(t) and has_height("b5", 2)(t),
}


@pytest.mark.parametrize("goal", GOALS)
@pytest.mark.parametrize("text", [AT_FIRST, LOW_TEXT], ids=["usual", "low"])
def test_plans_are_as_short_as_a_search_through_all_towers_finds(goal: str, text: str) -> None:
    best = shortest(GOALS[goal], USUAL if text is AT_FIRST else LOW)
    found = planned(goal, text, horizon=12)
    assert (len(found.actions) if found.found else None) == best


def test_heavy_boxes_go_below_light_ones() -> None:
    text = AT_FIRST + "observed heavy(b1) at 0. observed heavy(b3) at 0. "
    heavy = frozenset({"b1", "b3"})
    for goal, reached in (("height(b1, 2)", has_height("b1", 2)), ("tower_of(4)", tower_of(4))):
        assert len(planned(goal, text).actions) == shortest(reached, USUAL, heavy)
    # The light large box carries no heavy one, so that only the heavy large one can.
    assert str(planned("height(b1, 2)", text).actions[-1]) == "put(rob1,b1,b3)"


@pytest.mark.parametrize("goal", ["height(b1, 3)", "tower_of(4)", "tower_of(5)", "on(b3, b4)"])
def test_nothing_unstable_stands_on_the_way(goal: str) -> None:
    for state in planned(goal).states:
        assert names(state, "unstable") == set()
        placed = {str(fluent.arguments[0]) for fluent in state.positive("on")}
        assert names(state, "stable") == {f"stable({box})" for box in placed}


UNSTABLE = {
    "a large box on a small one": ("on(b3, b1)", {"b3"}),
    "something on a ball": ("on(b1, b5)", {"b1"}),
    "something on a roof": ("on(b2, b6)", {"b2"}),
    "three on a small base": ("on(b2, b1) on(b6, b2)", {"b6"}),
    "two on a small base": ("on(b2, b1)", set()),
    "four on a large base": ("on(b4, b3) on(b1, b4) on(b2, b1)", set()),
    "heavy on light": ("on(b1, b3) heavy(b1)", {"b1"}),
    "heavy on heavy": ("on(b1, b3) heavy(b1) heavy(b3)", set()),
    "light on unstable": ("on(b3, b1) on(b2, b3)", {"b2", "b3"}),
}


@pytest.mark.parametrize("stack", UNSTABLE)
def test_what_would_not_stand_is_known(stack: str) -> None:
    literals, expected = UNSTABLE[stack]
    seen = literals.replace(") ", ")|").split("|")
    state = after("".join(f"observed {literal} at 0. " for literal in seen)).now
    assert names(state, "unstable") == {f"unstable({box})" for box in expected}


def test_a_height_that_no_tower_has_is_reported() -> None:
    assert planned("on(b1, b5)").status is PlanStatus.UNREACHABLE
    for goal, reached in (("height(b3, 3)", has_height("b3", 3)), ("tower_of(6)", tower_of(6))):
        assert shortest(reached, USUAL) is None
        assert planned(goal, horizon=8).status in (
            PlanStatus.NOT_WITHIN_HORIZON,
            PlanStatus.UNREACHABLE,
        )


# What happens unasked


def test_a_failed_attempt_to_pick_up_a_box() -> None:
    text = AT_FIRST + "attempted pick_up(rob1, b1) at 0. "
    assert surprises(text + "observed holding(rob1, b1) at 1.") == []
    assert surprises(text + "observed on(b1, table) at 1.") == [(0, "failed", "pick_up(rob1,b1)")]


def test_a_box_that_slipped() -> None:
    text = AT_FIRST + "happened pick_up(rob1, b1) at 0. attempted put(rob1, b1, b4) at 1. "
    fell = text + "observed on(b1, table) at 2. observed -holding(rob1, b1) at 2."
    assert (1, "event", "slip(b1)") in surprises(fell)
    assert "on(b1,table)" in names(after(fell).now, "on")


def test_a_tower_that_fell() -> None:
    text = (
        "observed on(b2, b4) at 0. observed on(b1, b2) at 0. attempted pick_up(rob1, b6) at 0. "
        "observed on(b2, table) at 1. observed on(b1, table) at 1. observed holding(rob1, b6) at 1."
    )
    assert surprises(text) == [(0, "event", "topple(b2)")]


def test_a_box_that_feels_heavy_is_other_than_usual() -> None:
    text = AT_FIRST + "happened pick_up(rob1, b1) at 0. observed heavy(b1) at 1."
    assert surprises(text) == [(0, "exception", "-heavy(b1)")]


def test_nothing_is_put_on_the_ball_or_the_roof() -> None:
    assert check_change(DOMAIN) == (
        "it is never possible to put any box on the ball: put(rob1, _, b5)",
        "it is never possible to put any box on the roof: put(rob1, _, b6)",
    )


def test_the_robot_builds_a_tower_in_the_simulated_world() -> None:
    goal = read_goal("tower_of(3)", KNOWLEDGE)
    *_, last = simulate(DOMAIN, goal, seed=3)
    assert last.achieved
    assert not any(
        literal.name == "unstable" and literal.positive for w in last.worlds for literal in w
    )
