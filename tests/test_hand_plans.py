"""The hand of `tabletop` in plans: shortest plans, what falls, what happens unasked."""

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

DOMAIN = load_planning_domain("tabletop")
KNOWLEDGE = DOMAIN.knowledge
CUBE, BLUE, GREEN, CYLINDER, BALL, GRAY = (f"thing{number}" for number in range(1, 7))
AT_FIRST = f"observed on({BALL}, {GREEN}) at 0. "


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


# The same rules without any logic: stacks as tuples from the table up, and what is held.

Stacks = frozenset[tuple[str, ...]]
Tower = tuple[Stacks, str | None]


def following(tower: Tower) -> Iterator[Tower]:
    stacks, held = tower
    for stack in stacks:
        rest = stacks - {stack}
        if held is None:
            yield rest | ({stack[:-1]} if stack[:-1] else set()), stack[-1]
        elif stack[-1] not in {BALL, GRAY}:
            yield rest | {(*stack, held)}, None
    if held is not None:
        yield stacks | {(held,)}, None


def shortest(reached: Callable[[Tower], bool], first: Stacks) -> int | None:
    start: Tower = (first, None)
    waiting, seen = deque([(start, 0)]), {start}
    while waiting:
        tower, steps = waiting.popleft()
        if reached(tower):
            return steps
        for other in following(tower):
            if other not in seen:
                seen.add(other)
                waiting.append((other, steps + 1))
    return None


def has_height(thing: str, number: int) -> Callable[[Tower], bool]:
    return lambda tower: any(stack[number - 1 : number] == (thing,) for stack in tower[0])


def tower_of(number: int) -> Callable[[Tower], bool]:
    return lambda tower: any(len(stack) == number for stack in tower[0])


def on(upper: str, lower: str) -> Callable[[Tower], bool]:
    return lambda tower: any((lower, upper) in itertools.pairwise(s) for s in tower[0])


USUAL: Stacks = frozenset({(CUBE,), (BLUE,), (GREEN, BALL), (CYLINDER,), (GRAY,)})
LOW: Stacks = frozenset({(CYLINDER, GREEN, CUBE), (BLUE, BALL), (GRAY,)})
LOW_TEXT = (
    f"observed on({GREEN}, {CYLINDER}) at 0. observed on({CUBE}, {GREEN}) at 0. "
    f"observed on({BALL}, {BLUE}) at 0. "
)
GOALS: dict[str, Callable[[Tower], bool]] = {
    f"height({CUBE}, 3)": has_height(CUBE, 3),
    f"height({GREEN}, 2), height({BLUE}, 4)": (
        lambda t: has_height(GREEN, 2)(t) and has_height(BLUE, 4)(t)
    ),
    "tower_of(5)": tower_of(5),
    f"on({BALL}, {CUBE}), on({CUBE}, {BLUE})": lambda t: on(BALL, CUBE)(t) and on(CUBE, BLUE)(t),
    f"holding(hand, {GREEN})": lambda t: t[1] == GREEN,
    f"base({CUBE}, {BLUE}), height({CUBE}, 3)": (
        lambda t: any(s[0] == BLUE and s[2:3] == (CUBE,) for s in t[0])
    ),
    "not stacked": lambda t: all(len(stack) == 1 for stack in t[0]),
}


@pytest.mark.parametrize("goal", GOALS)
@pytest.mark.parametrize("text", [AT_FIRST, LOW_TEXT], ids=["usual", "low"])
def test_plans_are_as_short_as_a_search_through_all_towers_finds(goal: str, text: str) -> None:
    best = shortest(GOALS[goal], USUAL if text is AT_FIRST else LOW)
    found = planned(goal, text, horizon=12)
    assert (len(found.actions) if found.found else None) == best


def test_nothing_falls_on_the_way() -> None:
    for state in planned("tower_of(5)").states:
        assert names(state, "falls") == set()
        held = {str(fluent.arguments[1]) for fluent in state.positive("holding")}
        things = {CUBE, BLUE, GREEN, CYLINDER, BALL, GRAY}
        assert names(state, "stable") >= {f"stable({thing})" for thing in things - held}


def test_what_is_known_of_pictures_is_known_of_states() -> None:
    text = f"observed on({CUBE}, {BALL}) at 0. observed on({BLUE}, {CUBE}) at 0. "
    assert names(after(text).now, "falls") == {f"falls({CUBE})", f"falls({BLUE})"}
    assert names(after(AT_FIRST).now, "falls_without") == {f"falls_without({BALL},{GREEN})"}


def test_what_cannot_be_is_reported() -> None:
    assert planned(f"on({CUBE}, {BALL})").status is PlanStatus.UNREACHABLE
    assert check_change(DOMAIN) == (
        "it is never possible to put any thing on the small purple metal sphere: "
        "put_on(hand, _, thing5)",
        "it is never possible to put any thing on the large gray metal sphere: "
        "put_on(hand, _, thing6)",
    )


HAPPENED = {
    "a failed attempt to pick up a thing": (
        f"attempted pick_up(hand, {CUBE}) at 0. observed -holding(hand, {CUBE}) at 1.",
        [(0, "failed", f"pick_up(hand,{CUBE})")],
    ),
    "an attempt that did not fail": (
        f"attempted pick_up(hand, {CUBE}) at 0. observed holding(hand, {CUBE}) at 1.",
        [],
    ),
    "a thing that fell from the hand": (
        f"happened pick_up(hand, {CUBE}) at 0. attempted put_on(hand, {CUBE}, {CYLINDER}) at 1. "
        f"observed -on({CUBE}, {CYLINDER}) at 2. observed -holding(hand, {CUBE}) at 2.",
        [(1, "event", f"drop({CUBE})"), (1, "failed", f"put_on(hand,{CUBE},{CYLINDER})")],
    ),
    "a tower that fell": (
        f"observed on({BLUE}, {CYLINDER}) at 0. observed on({CUBE}, {BLUE}) at 0. "
        f"attempted pick_up(hand, {GRAY}) at 0. observed holding(hand, {GRAY}) at 1. "
        f"observed -on({CUBE}, {BLUE}) at 1. observed -on({BLUE}, {CYLINDER}) at 1.",
        [(0, "event", f"topple({BLUE})")],
    ),
    "a thing that fell onto another": (
        f"observed on({CUBE}, {CYLINDER}) at 0. attempted pick_up(hand, {GRAY}) at 0. "
        f"observed holding(hand, {GRAY}) at 1. observed on({CUBE}, {BLUE}) at 1.",
        [(0, "event", f"fall_onto({CUBE},{BLUE})")],
    ),
}


@pytest.mark.parametrize("happened", HAPPENED)
def test_what_happens_unasked_is_found(happened: str) -> None:
    text, expected = HAPPENED[happened]
    # What lay otherwise at first than usual is no surprise here.
    found = [one for one in surprises(text) if one[1] != "exception"]
    assert sorted(found, key=str) == sorted(expected, key=str)


def test_the_hand_builds_a_tower_in_the_simulated_world() -> None:
    *_, last = simulate(DOMAIN, read_goal("tower_of(3)", KNOWLEDGE), seed=3)
    assert last.achieved
    assert not any(
        literal.name == "falls" and literal.positive for w in last.worlds for literal in w
    )
