"""Plans of a hand carried out on a simulated table, and what is then seen of it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from itertools import permutations

import clingo

from seewhy.data.thing_scene import ThingScene, thing_scene
from seewhy.domain.things import Things
from seewhy.knowledge.axiom import Literal
from seewhy.knowledge.ground import key_of
from seewhy.knowledge.history import History
from seewhy.planning.domain import PlanningDomain
from seewhy.planning.execution.execution import Run, execute
from seewhy.planning.execution.transition_function import TransitionFunction
from seewhy.planning.goal import Goal
from seewhy.planning.planner.goal_test import goal_holds
from seewhy_lab.simulators.tabletop.hand import Hand
from seewhy_lab.simulators.tabletop.table import Table

__all__ = ["carried_out", "reached", "scene_of_table", "seen_by"]


def scene_of_table(table: Table, things: Things, azimuth: float = 0.0) -> ThingScene:
    """Return a table as it is annotated: what each thing is like, how they stand to each other.

    Examples
    --------
    >>> from seewhy.domain.domain import load_domain
    >>> from seewhy_lab.simulators.tabletop.source import random_scene
    >>> table, view, _ = random_scene(seed=0, index=0)
    >>> scene = scene_of_table(table, load_domain("tabletop").things, view.azimuth)
    >>> scene.count == len(table.things)
    True
    """
    places = table.places(azimuth)
    numbers = range(len(table.things))
    pairs = list(permutations(numbers, 2))
    return thing_scene(
        things,
        [
            {key: str(getattr(thing, key)) for key in ("size", "colour", "material", "shape")}
            for thing in table.things
        ],
        relations={
            "left": [(n, to) for n, to in pairs if places[n][0] < places[to][0]],
            "in_front": [(n, to) for n, to in pairs if places[n][1] < places[to][1]],
            "on": list(table.stands_on()),
        },
        image="table",
    )


def seen_by(hand: Hand, bodies: Mapping[str, int]) -> list[Literal]:
    """Return what is seen of a table: of each two things whether one is on the other, what is held.

    ``bodies`` says which body each thing of the plan is.
    """
    on = hand.stands_on()
    seen = [
        Literal("on", (upper, lower), positive=(bodies[upper], bodies[lower]) in on)
        for upper, lower in permutations(bodies, 2)
    ]
    held = [
        Literal("holding", ("hand", term), positive=bodies[term] == hand.held) for term in bodies
    ]
    return [*seen, *held]


def carried_out(
    domain: PlanningDomain,
    goal: Goal,
    hand: Hand,
    *,
    bodies: Mapping[str, int],
    most_steps: int = 40,
) -> Run:
    """Let the hand pursue a goal, looking at the table after every action; return the run.

    What falls is seen, and planned anew for. What the hand sees of the table before it begins takes
    the place of what a picture was taken to show of the same things.

    Raises
    ------
    KnowledgeError
        If what is seen cannot be, by what is known of the table.
    """

    def act(action: clingo.Symbol) -> list[Literal]:
        _, *terms = map(str, action.arguments)
        if all(term in bodies for term in terms):
            getattr(hand, action.name)(*(bodies[term] for term in terms))
        return seen_by(hand, bodies)

    first = seen_by(hand, bodies)
    begun = replace(domain, history=_without(domain.history, first))
    *_, run = execute(begun, goal, sensed=first, act=act, most_steps=most_steps)
    return run


def _without(history: History, seen: Sequence[Literal]) -> History:
    """A history without what was observed of the same fluents at first."""
    anew = {(literal.predicate, literal.arguments) for literal in seen}
    kept = tuple(
        observation
        for observation in history.observations
        if observation.step
        or (observation.literal.predicate, observation.literal.arguments) not in anew
    )
    return replace(history, observations=kept)


def reached(domain: PlanningDomain, goal: Goal, seen: Sequence[Literal]) -> bool:
    """Whether a goal holds in the state of which everything is seen."""
    literals = [clingo.parse_term(key_of(literal)) for literal in seen]
    world = TransitionFunction(domain.knowledge).complete(literals)
    return goal_holds(domain.knowledge, goal, world)
