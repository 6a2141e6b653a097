"""Uniform-cost search from a start of which not all is known: that is as a plan needs it.

A state says of every fluent that it is true, false, or still open. An action that asks for an open
fluent settles it; so the states are as many as what plans ask about, and not as many as the worlds
that the start leaves possible. That there is no plan is then shown by looking at all of them.
"""

from __future__ import annotations

import heapq
import itertools
import time
from collections.abc import Iterator
from typing import NamedTuple

from seewhy.planning.planner.a_star import DerivedFluents, Move, SearchResult, bits
from seewhy.planning.planner.ground_problem import GroundProblem
from seewhy.planning.planner.held_karp import FAR


class _Known(NamedTuple):
    """The fluents that are true, and those that are open, as bits; the others are false."""

    true: int
    open: int


def search_with_unknowns(
    problem: GroundProblem,
    *,
    horizon: int,
    expansions: int,
    until: float | None = None,
) -> SearchResult:
    """Return a shortest plan with at most ``horizon`` actions, if there is one.

    Of plans that are as short, it is one that asks least often about what is open at first.
    Gives up as :func:`seewhy.planning.planner.a_star.a_star` does.
    """
    return _OpenSearch(problem).run(horizon, expansions, until)


class _OpenSearch:
    def __init__(self, problem: GroundProblem) -> None:
        self.problem = problem
        self.goals = [bits(goal) for goal in problem.goals]
        self.moves = [Move(number, operator) for number, operator in enumerate(problem.operators)]
        self.groups = [bits(group)[0] for group in problem.exclusive]
        self.open, _ = bits(problem.open)
        # What is defined follows from what is known alone.
        self.with_derived = DerivedFluents(problem)

    def run(self, horizon: int, expansions: int, until: float | None) -> SearchResult:
        begin = self._begin()
        best = {begin: (0, 0)}
        came: dict[_Known, tuple[_Known, int]] = {}
        counter = itertools.count()
        waiting = [(0, 0, next(counter), begin)]
        left = expansions
        while waiting:
            done, asked, _, state = heapq.heappop(waiting)
            if best[state] < (done, asked):
                continue
            for goal in self.goals:
                if self._assumed(state, *goal) is not None:
                    return self._result(state, came, goal)
            if done == horizon and any(True for _ in self._after(state)):
                return SearchResult(None, (), horizon + 1, exhausted=False)
            if not left or (until is not None and time.perf_counter() >= until):
                return SearchResult(None, (), done, exhausted=False)
            left -= 1
            for move, after in self._after(state):
                cost = (done + 1, asked + ((move.true | move.false) & self.open).bit_count())
                if cost < best.get(after, (FAR, 0)):
                    best[after] = cost
                    came[after] = (state, move.number)
                    heapq.heappush(waiting, (*cost, next(counter), after))
        return SearchResult(None, (), FAR, exhausted=True)

    def _begin(self) -> _Known:
        """The start, with what is only ever asked for in one way being that way."""
        state = _Known(self.with_derived(bits(self.problem.start)[0]), self.open)
        wanted = denied = 0
        for true, false in (*self.goals, *((move.true, move.false) for move in self.moves)):
            wanted |= true
            denied |= false
        for move in self.moves:
            for true, false, _, _ in move.whens:
                wanted |= true | false
                denied |= true | false
        free = state.open
        for group in self.groups:
            if state.true & group:
                state = _Known(state.true, state.open & ~group)
            free &= ~group
        true, false = free & wanted & ~denied, free & ~wanted
        return _Known(state.true | true, state.open & ~(true | false))

    def _assumed(self, state: _Known, true: int, false: int) -> _Known | None:
        """The state with these true and those false, if it leaves that possible."""
        if true & ~(state.true | state.open) or false & state.true:
            return None
        settled = true & state.open
        if not settled:
            return _Known(state.true, state.open & ~false) if false & state.open else state
        now, left = state.true | settled, state.open & ~(settled | false)
        for group in self.groups:
            if settled & group:
                if (now & group).bit_count() > 1:
                    return None
                left &= ~group
        return _Known(now, left)

    def _after(self, state: _Known) -> Iterator[tuple[Move, _Known]]:
        for move in self.moves:
            before = self._assumed(state, move.true, move.false)
            if before is not None:
                for settled in self._settled(before, move):
                    after = self.with_derived(move.after(settled.true))
                    yield move, _Known(after, settled.open & ~self._changed(settled, move))

    def _settled(self, state: _Known, move: Move) -> Iterator[_Known]:
        """The states that settle under which conditions a move has its effects."""
        for true, false, _, _ in move.whens:
            undone = true & ~(state.true | state.open) or false & state.true
            asks = (true | false) & state.open
            if asks and not undone:
                first = asks & -asks
                for chosen in ((first, 0), (0, first)):
                    follows = self._assumed(state, *chosen)
                    if follows is not None:
                        yield from self._settled(follows, move)
                return
        yield state

    def _changed(self, state: _Known, move: Move) -> int:
        changed = move.adds | move.removes
        for true, false, add, remove in move.whens:
            if state.true & true == true and not state.true & false:
                changed |= add | remove
        return changed

    def _result(
        self, state: _Known, came: dict[_Known, tuple[_Known, int]], goal: tuple[int, int]
    ) -> SearchResult:
        reached = self._assumed(state, *goal)
        assert reached is not None
        path, numbers = [reached], list[int]()
        # What a later action settled was so before, unless an action in between has changed it.
        settled_true, settled = reached.true, state.open & ~reached.open
        while state in came:
            before, number = came[state]
            move = self.moves[number]
            known = self._assumed(before, move.true, move.false)
            assert known is not None
            for candidate in self._settled(known, move):
                after = _Known(
                    self.with_derived(move.after(candidate.true)),
                    candidate.open & ~self._changed(candidate, move),
                )
                if after == state:
                    known = candidate
                    break
            kept = settled & before.open
            true = known.true | (settled_true & kept)
            path.append(_Known(true, known.open & ~kept))
            settled, settled_true = kept | (before.open & ~known.open), true
            numbers.append(number)
            state = before
        return SearchResult(
            operators=tuple(self.problem.operators[number] for number in reversed(numbers)),
            states=tuple(self._fluents(visited.true) for visited in reversed(path)),
            bound=len(numbers),
            exhausted=False,
            open=tuple(self._fluents(visited.open) for visited in reversed(path)),
        )

    def _fluents(self, known: int) -> frozenset[int]:
        return frozenset(n for n in range(1, len(self.problem.fluents) + 1) if known >> n - 1 & 1)
