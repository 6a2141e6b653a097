"""The page of a simulated run: map, path, beliefs against the truth, and explanations."""

from __future__ import annotations

from typing import Any

import clingo

from seewhy import __version__
from seewhy.knowledge.ground import complement_of
from seewhy.planning.diagnosis.belief_state import State
from seewhy.planning.domain import PlanningDomain
from seewhy.planning.execution.run_narration import narrate_end, narrate_step
from seewhy.planning.execution.simulation import Simulation
from seewhy.planning.execution.transition_function import World
from seewhy.planning.words import PlanningWords
from seewhy.report.card import embedded
from seewhy.report.floor_plan import Occupant, draw_floor_plan, layout
from seewhy.report.html import rendered

_PICTURE = 192
"""Side of the robot's pictures on the page, in pixels."""


def run_page(domain: PlanningDomain, simulation: Simulation, *, command: str) -> str:
    """Return a run as the text of an HTML file that opens with no network.

    Where planning.toml has a ``[map]``, every step shows who is believed to be where, and who is.
    """
    run, shown = simulation.run, StepsShown(domain)
    steps = [shown.step(simulation, number) for number in range(len(run.steps))]
    return rendered(
        "run.html",
        title=domain.title,
        goal=run.goal.text,
        steps=steps,
        ended=narrate_end(run),
        achieved=simulation.achieved,
        has_map=domain.map is not None,
        version=__version__,
        command=command,
    )


class StepsShown:
    """The steps of runs in a domain, each as a page shows it.

    Parameters
    ----------
    domain : PlanningDomain
    """

    def __init__(self, domain: PlanningDomain) -> None:
        self._words = domain.words
        self._map = _Map(domain) if domain.map is not None else None

    def step(self, simulation: Simulation, number: int) -> dict[str, Any]:
        """A step as values that JSON can hold.

        ``said``, ``plan``, what of the world was ``unseen``, which beliefs are ``wrong``, and the
        ``map`` in SVG, empty where the domain draws none.
        """
        words, step = self._words, simulation.run.steps[number]
        happened = simulation.happenings[number - 1] if number else None
        unseen = [] if happened is None else list(map(words.did, happened.events))
        if happened is not None and happened.failed and happened.action is not None:
            unseen.insert(0, f"the attempt to {words.do(happened.action)} failed")
        wrong = _wrong(step.believed, simulation.worlds[number])
        return {
            "number": step.number,
            "decision": step.decision.value,
            "said": narrate_step(words, step),
            "plan": list(map(words.do, step.plan)),
            "unseen": unseen,
            "wrong": [words.say(literal) for literal in wrong],
            "map": self._map.svg(simulation, number) if self._map else "",
            "picture": _picture(words, simulation, number),
        }


def _picture(words: PlanningWords, simulation: Simulation, number: int) -> dict[str, Any] | None:
    """The picture taken at a step: what was read from it, and what of that is not so."""
    if not simulation.looks:
        return None
    look = simulation.looks[number]
    as_read = {
        fluent: fluent if holds else complement_of(fluent) for fluent, holds in look.read.items()
    }
    return {
        "data": embedded(look.picture, size=_PICTURE),
        "read": [words.say(as_read[fluent]) for fluent, holds in look.read.items() if holds],
        "misread": [words.say(as_read[fluent]) for fluent in look.misread],
    }


def _wrong(believed: State, world: World) -> list[clingo.Symbol]:
    """What is believed and not so; of what is denied, only where nothing affirms the opposite."""
    return sorted(
        literal
        for literal in believed.holds
        if literal not in world and (literal.positive or _rest(literal, believed))
    )


def _rest(denied: clingo.Symbol, believed: State) -> bool:
    same = denied.arguments[:-1]
    return not any(
        literal.positive and literal.name == denied.name and literal.arguments[:-1] == same
        for literal in believed.holds
    )


class _Map:
    """The places of a domain, laid out once, with who is where at each step."""

    def __init__(self, domain: PlanningDomain) -> None:
        table = domain.map
        assert table is not None
        self.domain, self.table = domain, table
        self.places = list(domain.knowledge.signature.members(table.places))
        statics = domain.statics(table.links)
        self.links = sorted(
            {tuple(sorted(map(str, link.arguments))) for link in statics if link.positive}
        )
        self.at = layout(self.places, self.links)  # type: ignore[arg-type]

    def svg(self, simulation: Simulation, number: int) -> str:
        """The map at a step, with the robot's way up to there."""
        step, world = simulation.run.steps[number], simulation.worlds[number]
        robot, where = self.domain.robot, self.table.where
        occupants: dict[str, list[Occupant]] = {}
        for literal in sorted({*step.believed.positive(where), *_of(where, world)}):
            thing, place = map(str, literal.arguments)
            occupants.setdefault(place, []).append(
                Occupant(
                    name=self.domain.words.name(thing).removeprefix("the "),
                    believed=literal in step.believed.holds,
                    true=literal in world,
                    is_robot=thing == robot,
                )
            )
        path = [
            str(literal.arguments[1])
            for past in simulation.worlds[: number + 1]
            for literal in _of(where, past)
            if str(literal.arguments[0]) == robot
        ]
        closed = self.table.closed
        shaded = [str(literal.arguments[0]) for literal in _of(closed, world)] if closed else []
        names = {place: self.domain.words.name(place) for place in self.places}
        return draw_floor_plan(
            self.at,
            self.links,  # type: ignore[arg-type]
            names,
            occupants,
            path=path,
            shaded=shaded,
        ).svg


def _of(predicate: str, world: World) -> list[clingo.Symbol]:
    return sorted(literal for literal in world if literal.positive and literal.name == predicate)
