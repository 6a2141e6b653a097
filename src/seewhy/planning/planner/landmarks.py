"""How many actions are needed at least: what every plan makes true, and the walk past it.

Two counts in which no action counts twice. What every plan must make true and is not yet (a
landmark: each message delivered) needs an action. And where exactly one of several fluents holds
(where a robot is), every plan walks through the values that these actions need; the walk is no
shorter than the shortest one past all of them.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

from seewhy.planning.planner.ground_problem import GroundProblem, Literals
from seewhy.planning.planner.held_karp import FAR, MOST_STOPS, HeldKarpWalks


@dataclass(frozen=True)
class _Tour:
    """A group of fluents of which one holds, with the walks past what landmarks need of it."""

    group: int  # as bits
    walks: HeldKarpWalks
    stops: dict[int, int]  # landmark -> the bit of its stop


class LandmarkHeuristic:
    """A lower bound for the number of actions from a state to a goal.

    Parameters
    ----------
    problem : GroundProblem
    goal : the literals to reach, together
    """

    def __init__(self, problem: GroundProblem, goal: Literals) -> None:
        self._goal = sorted(goal)
        self._derived = {head for stratum in problem.derivations for head, _ in stratum}
        adders: dict[int, list[tuple[int | None, Literals]]] = {}
        for number, operator in enumerate(problem.operators):
            for body, head in operator.effects:
                adders.setdefault(head, []).append((number, operator.condition | body))
        for stratum in problem.derivations:
            for head, body in stratum:
                adders.setdefault(head, []).append((None, body))
        self._needs = self._landmarks(adders)
        self._tours, walking = self._all_tours(problem)
        added: dict[int, set[int]] = {}
        for fact in self._needs:
            for number_, _ in adders.get(fact, ()):
                if number_ is not None:
                    added.setdefault(number_, set()).add(fact)
        self._weight = {}
        for fact in self._needs:
            numbers = [number for number, _ in adders.get(fact, ())]
            counted = [number for number in numbers if number is not None and number not in walking]
            whole = numbers and len(counted) == len(numbers) and -fact not in self._derived
            # An action that makes several landmarks true is shared out among them.
            self._weight[fact] = 1 / max(len(added[number]) for number in counted) if whole else 0.0
            if not numbers and -fact not in self._derived:
                self._weight[fact] = FAR  # nothing makes it true

    def __call__(self, state: int) -> int:
        """Return the bound for a state: the fluents that hold, as bits, fluent 1 the lowest."""
        pending: set[int] = set()
        waiting = self._goal.copy()
        needs = self._needs
        while waiting:
            fact = waiting.pop()
            if fact not in pending and (state >> abs(fact) - 1 & 1) != (fact > 0):
                pending.add(fact)
                waiting += needs[fact]
        weight = self._weight
        bound = math.ceil(sum([weight[fact] for fact in pending]) - 1e-6)
        for tour in self._tours:
            stops = 0
            for fact in pending:
                stops |= tour.stops.get(fact, 0)
            bound += tour.walks.length((state & tour.group).bit_length(), stops)
        return min(bound, FAR)

    def _landmarks(
        self, adders: dict[int, list[tuple[int | None, Literals]]]
    ) -> dict[int, Literals]:
        """The literals without which the goal is not reached, with what holds whenever they are
        made true."""
        found: dict[int, Literals] = {}
        waiting = list(self._goal)
        while waiting:
            fact = waiting.pop()
            if fact not in found:
                ways = (
                    []
                    if -fact in self._derived
                    else [conditions for _, conditions in adders.get(fact, ())]
                )
                found[fact] = frozenset.intersection(*ways) if ways else frozenset()
                waiting += found[fact]
        return found

    def _all_tours(self, problem: GroundProblem) -> tuple[list[_Tour], set[int]]:
        """The tours of groups that no operator walks in two of, and the operators that walk."""
        tours: list[_Tour] = []
        walking: set[int] = set()
        for group in problem.groups:
            movers = set(_movers(problem, group))
            if movers & walking:
                continue
            into: dict[int, set[int]] = {value: set() for value in group}
            for number in movers:
                operator = problem.operators[number]
                for body, head in operator.effects:
                    if head in group:
                        into[head] |= (operator.condition | body) & group or group - {head}
            wanted = {
                fact: value
                for fact, needs in self._needs.items()
                if fact not in group
                for value in needs & group
            }
            ends = [fact for fact in self._goal if fact in group]
            stops = sorted(set(wanted.values()))[:MOST_STOPS]
            if not stops and (not ends or len(group) == 2):
                continue  # one step, which counts as a landmark
            bits = {value: 1 << number for number, value in enumerate(stops)}
            tours.append(
                _Tour(
                    group=sum(1 << value - 1 for value in group),
                    walks=HeldKarpWalks(into, stops, ends[0] if ends else None),
                    stops={fact: bits[value] for fact, value in wanted.items() if value in bits},
                )
            )
            walking |= movers
        return tours, walking


def _movers(problem: GroundProblem, group: frozenset[int]) -> Iterator[int]:
    for number, operator in enumerate(problem.operators):
        if any(head in group for _, head in operator.effects):
            yield number
