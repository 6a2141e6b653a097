"""A hand on a simulated table: what it does to things is what plans say, as far as physics lets."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest

pytest.importorskip("mujoco")

from seewhy.data.thing import BoundingBox
from seewhy.data.thing_scene import thing_scene
from seewhy.dialogue.things.evaluating import Evaluation
from seewhy.dialogue.things.wording import ThingWords
from seewhy.domain.domain import load_domain
from seewhy.planning.domain import PlanningDomain, load_planning_domain
from seewhy.planning.execution.execution import Outcome, Run
from seewhy.planning.spoken_goals import SpokenGoals, goal_of
from seewhy_lab.commands.tables_planned import random_goals, trial
from seewhy_lab.rendering.rays import Scene
from seewhy_lab.simulators.tabletop.hand import Hand
from seewhy_lab.simulators.tabletop.planned import carried_out, reached, scene_of_table, seen_by
from seewhy_lab.simulators.tabletop.source import random_scene
from seewhy_lab.simulators.tabletop.table import Table, TableThing, half_extent
from seewhy_lab.simulators.tabletop.view import View
from seewhy_lab.simulators.tabletop.visibility import seen_things
from seewhy_lab.simulators.thing_rows import boxes


def thing(
    shape: str,
    size: str,
    x: float,
    *,
    colour: str = "red",
    on: tuple[int, TableThing] | None = None,
) -> TableThing:
    below = 0.0 if on is None else on[1].top
    return TableThing(
        shape=shape,
        size=size,
        colour=colour,
        material="rubber",
        x=x,
        y=0.0,
        z=below + half_extent(shape, size)[1],
        yaw=0.3,
        support=None if on is None else on[0],
    )


BASE = thing("cube", "large", -0.1)
TOP = thing("cube", "small", -0.1, colour="blue", on=(0, BASE))
BALL = thing("sphere", "large", 0.0, colour="green")
FREE = thing("cylinder", "small", 0.1, colour="gray")
TABLE = Table((BASE, TOP, BALL, FREE))


def hand_on(table: Table = TABLE, **spreads: float) -> Hand:
    return Hand(table, np.random.default_rng(1), **spreads)


def test_what_stands_on_what_is_seen() -> None:
    hand = hand_on()
    assert hand.stands_on() == {(1, 0)}
    hand.pick_up(3)
    assert (hand.held, hand.stands_on()) == (3, {(1, 0)})
    hand.put_on(3, 1)
    assert (hand.held, hand.stands_on()) == (None, {(1, 0), (3, 1)})
    hand.pick_up(3)
    hand.put_down(3)
    assert hand.stands_on() == {(1, 0)}


def test_what_loses_its_support_falls() -> None:
    hand = hand_on()
    hand.pick_up(0)
    assert hand.stands_on() == set()
    hand.put_on(0, 1)
    assert hand.stands_on() == {(0, 1)}


def test_nothing_stays_on_a_ball() -> None:
    hand = hand_on()
    hand.pick_up(3)
    hand.put_on(3, 2)
    assert hand.stands_on() == {(1, 0)}


def planning(table: Table) -> PlanningDomain:
    things = load_domain("tabletop").things
    assert things is not None
    return load_planning_domain("tabletop", scene=scene_of_table(table, things))


@pytest.fixture(scope="module")
def domain() -> PlanningDomain:
    return planning(TABLE)


def pursued(domain: PlanningDomain, said: str, hand: Hand) -> tuple[Run, bool]:
    goal = goal_of(said, domain)
    bodies = {f"thing{number + 1}": number for number in range(len(TABLE.things))}
    run = carried_out(domain, goal, hand, bodies=bodies, most_steps=8)
    return run, reached(domain, goal, seen_by(hand, bodies))


def test_a_tower_is_built(domain: PlanningDomain) -> None:
    run, truly = pursued(domain, "make a tower of three with the red block on top", hand_on())
    assert (run.outcome, truly) == (Outcome.ACHIEVED, True)
    assert [action.name for action in run.actions] == [
        "pick_up", "put_on", "pick_up", "put_on"
    ]  # fmt: skip


def test_what_rolls_off_is_seen_and_not_taken_for_reached(domain: PlanningDomain) -> None:
    # A hand that throws: the ball never stays.
    run, truly = pursued(domain, "put the ball on the cylinder", hand_on(released=2.0))
    assert (run.outcome, truly) == (Outcome.OUT_OF_STEPS, False)
    assert any(step.surprises for step in run.steps)


def test_random_goals_are_understood(domain: PlanningDomain) -> None:
    assert domain.at_first is not None
    words = ThingWords(Evaluation(domain.at_first.scene, domain.at_first.things))
    goals = random_goals(words, np.random.default_rng(0))
    reader = SpokenGoals(domain)
    kinds = set()
    for _ in range(30):
        kind, said = next(goals)
        kinds.add(kind)
        reader.read(said)
    assert len(kinds) == 8


class Seeing:
    """What sees a table as it is, but counts its things from the last to the first."""

    def __init__(self, table: Table, view: View, scene: Scene) -> None:
        self.table = table
        self.boxes = boxes(seen_things(scene, view, size=320), len(table.things))

    def read(self, _: object) -> None:
        """What is seen is known already."""

    def scene_of(self, _: object) -> SimpleNamespace:
        things = load_domain("tabletop").things
        assert things is not None
        last = len(self.table.things) - 1
        values = [
            {"size": t.size, "colour": t.colour, "material": t.material, "shape": t.shape}
            for t in reversed(self.table.things)
        ]
        on = [(last - upper, last - lower) for upper, lower in self.table.stands_on()]
        seen = [SimpleNamespace(box=BoundingBox(*map(float, box))) for box in reversed(self.boxes)]
        return SimpleNamespace(
            scene=thing_scene(things, values, relations={"on": on}),
            reading=SimpleNamespace(things=seen),
        )


def test_a_hand_acts_by_what_is_seen() -> None:
    table, view, scene = random_scene(seed=0, index=9)
    seeing = Seeing(table, view, scene)
    found = trial(table, view, scene, rng=np.random.default_rng(4), agent=seeing)  # type: ignore[arg-type]
    assert found is not None
    assert (found.problem, found.reached) == ("", True)
    assert found.run is not None
    assert found.run.actions
