"""The simulated world as an environment: what is done in it, and what is sensed of it."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import clingo
import numpy as np
from numpy.typing import NDArray

from seewhy.errors import PlanningError
from seewhy.knowledge.axiom import Literal
from seewhy.knowledge.ground import complement_of, literal_of
from seewhy.planning.diagnosis.diagnosis import diagnose
from seewhy.planning.domain import PlanningDomain
from seewhy.planning.execution.sensing import Sensors
from seewhy.planning.execution.transition_function import TransitionFunction, World
from seewhy.planning.goal import Goal
from seewhy.planning.planner.goal_test import goal_holds

if TYPE_CHECKING:
    from seewhy.planning.execution.sight import Look, Sight

NOT_SENSED, SEEN_FALSE, SEEN_TRUE = 0, 1, 2


@dataclass(frozen=True)
class Happening:
    """What really happened in one step of the world, which the robot is not told."""

    action: clingo.Symbol | None
    failed: bool
    events: tuple[clingo.Symbol, ...]
    misread: tuple[clingo.Symbol, ...]


class PlanningEnvironment:
    """A world that follows a domain's knowledge, with chance as planning.toml says.

    Each step the robot's action is done, or fails; then, or at the same time, exogenous actions
    happen; then the robot senses. An action that is impossible in the true state has no effect.
    ``reset`` and ``step`` are those of Gymnasium, whose spaces
    ``seewhy_lab.gymnasium_environment`` adds.

    Parameters
    ----------
    domain : PlanningDomain
    goal : Goal, optional
        An episode ends, with a reward of 1, where it truly holds.
    steps : int
        An episode is cut off after so many actions.

    Attributes
    ----------
    actions : list of clingo.Symbol
        What the numbers of actions stand for; the number after the last is to do nothing.
    fluents : list of clingo.Symbol
        What the entries of an observation are about: 0 not sensed, 1 seen false, 2 seen true.
    state : World
        The true state.

    Examples
    --------
    >>> from seewhy.planning.domain import load_planning_domain
    >>> environment = PlanningEnvironment(load_planning_domain("robot_assistant"))
    >>> observation, info = environment.reset(seed=0)
    >>> "loc(rob1, library)" in map(str, environment.read(observation))
    True
    """

    def __init__(
        self,
        domain: PlanningDomain,
        *,
        goal: Goal | None = None,
        steps: int = 100,
        sight: Sight | None = None,
    ) -> None:
        self.domain = domain
        self.goal = goal
        self.steps = steps
        self.transitions = TransitionFunction(domain.knowledge)
        self.sensors = Sensors(domain.knowledge, domain.sensing)
        self.actions = self.transitions.actions
        self.fluents = sorted(self.transitions.fluents)
        self._places = {fluent: number for number, fluent in enumerate(self.fluents)}
        self.state: World = frozenset()
        self.sight = sight
        self.look: Look | None = None
        self.done = 0
        self.random = np.random.default_rng()

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[NDArray[np.int8], dict[str, Any]]:
        """Begin an episode in a random world; ``options={"state": World}`` sets it.

        ``options={"holds": literals}`` changes the random world no more than that these hold.

        Raises
        ------
        PlanningError
            If one of these cannot hold together with the ones before it.
        """
        if seed is not None:
            self.random = np.random.default_rng(seed)
        self.done = 0
        given = (options or {}).get("state")
        self.state = self._random_state() if given is None else frozenset(given)
        if options and options.get("holds"):
            self.state = self._changed(self.state, options["holds"])
        observation, misread = self._sense()
        return observation, {"happening": Happening(None, False, (), misread)}

    def step(
        self, action: int | np.int64
    ) -> tuple[NDArray[np.int8], float, bool, bool, dict[str, Any]]:
        """Do the action of this number; see Gymnasium for what is returned."""
        chosen = self.actions[action] if action < len(self.actions) else None
        failures = self.domain.simulation.failures
        fails = chosen is not None and self.random.random() < failures.get(chosen.name, 0.0)
        done = [chosen] if chosen is not None and not fails else []
        following = self.transitions.after(self.state, done)
        if following is None:
            done, fails = [], True
            following = self.transitions.after(self.state, [])
        assert following is not None
        events: list[clingo.Symbol] = []
        for event in self._random_events():
            changed = self.transitions.after(self.state, [*done, *events, event])
            if changed is not None:
                following = changed
                events.append(event)
        self.state = following
        self.done += 1
        observation, misread = self._sense()
        reached = self.goal is not None and goal_holds(self.domain.knowledge, self.goal, self.state)
        happening = Happening(chosen, fails, tuple(events), misread)
        return (
            observation,
            float(reached),
            reached,
            self.done >= self.steps,
            {"happening": happening},
        )

    def number(self, action: clingo.Symbol) -> int:
        """The number of an action."""
        return self.actions.index(action)

    def read(self, observation: NDArray[np.int8]) -> list[Literal]:
        """The literals that an observation shows."""
        return [
            literal_of(str(fluent)) if seen == SEEN_TRUE else literal_of(str(fluent)).complement
            for fluent, seen in zip(self.fluents, observation, strict=True)
            if seen != NOT_SENSED
        ]

    def _sense(self) -> tuple[NDArray[np.int8], tuple[clingo.Symbol, ...]]:
        observation = np.zeros(len(self.fluents), dtype=np.int8)
        misread = []
        for fluent, error in self.sensors.sensed(self.state):
            holds = fluent in self.state
            if error and self.random.random() < error:
                holds = not holds
                misread.append(fluent)
            observation[self._places[fluent]] = SEEN_TRUE if holds else SEEN_FALSE
        if self.sight is not None:
            # A stream of its own, so that the world's course does not depend on who looks at it.
            (stream,) = self.random.spawn(1)
            self.look = self.sight.look(self.state, seed=int(stream.integers(2**31)))
            for fluent, holds in self.look.read.items():
                observation[self._places[fluent]] = SEEN_TRUE if holds else SEEN_FALSE
            misread = [fluent for fluent in misread if fluent not in self.look.read]
            misread += self.look.misread
        return observation, tuple(misread)

    def _random_events(self) -> Iterator[clingo.Symbol]:
        for name, chance in self.domain.simulation.events.items():
            if self.random.random() < chance:
                possible = [event for event in self.transitions.events if event.name == name]
                order = self.random.permutation(len(possible))
                yield from self._first_possible(possible[int(number)] for number in order)

    def _first_possible(self, events: Iterable[clingo.Symbol]) -> Iterator[clingo.Symbol]:
        for event in events:
            if self.transitions.after(self.state, [event]) is not None:
                yield event
                return

    def _random_state(self) -> World:
        knowledge, simulation = self.domain.knowledge, self.domain.simulation
        usual = diagnose(knowledge, self.domain.history).states[0]
        open_fluents = sorted(usual.unknown)
        chosen = [fluent for fluent in open_fluents if self.random.random() < simulation.unknown]
        order = self.random.permutation(len(chosen))
        state = self.transitions.complete(
            [*sorted(usual.holds), *(chosen[int(number)] for number in order)]
        )
        for _ in range(simulation.before):
            for event in self._events_in(state):
                changed = self.transitions.after(state, [event])
                state = state if changed is None else changed
        return state

    def _changed(self, state: World, holds: Sequence[clingo.Symbol]) -> World:
        changed = self.transitions.complete([*holds, *sorted(state)])
        for literal in holds:
            is_so = (
                literal in changed if literal.positive else complement_of(literal) not in changed
            )
            if not is_so:
                raise PlanningError(
                    f"it cannot be that {self.domain.words.say(literal)} at first; suppose "
                    "something else, or change knowledge.al"
                )
        return changed

    def _events_in(self, state: World) -> list[clingo.Symbol]:
        kept, self.state = self.state, state
        try:
            return list(self._random_events())
        finally:
            self.state = kept
