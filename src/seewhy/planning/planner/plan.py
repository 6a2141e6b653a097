"""Plan: the result of planning, and how the search for it ended."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

import clingo

from seewhy.planning.diagnosis.belief_state import State
from seewhy.text.notebook import html_line, html_list

__all__ = ["Plan", "PlanStatus"]


class PlanStatus(StrEnum):
    """How a search for a plan ended."""

    FOUND = "found"
    ALREADY_TRUE = "already true"
    UNREACHABLE = "unreachable"
    NOT_WITHIN_HORIZON = "not within the horizon"
    OUT_OF_TIME = "out of time"


@dataclass(frozen=True)
class Plan:
    """The result of planning.

    Attributes
    ----------
    status : PlanStatus
    actions : tuple of clingo.Symbol
        As few as there can be.
    states : tuple of State
        The states before, between and after the actions. What was unknown at first is taken to
        be as the plan needs it.
    seconds : float
        Wall-clock time, grounding included.
    horizon : int
        The number of actions up to which plans were looked for.
    """

    status: PlanStatus
    actions: tuple[clingo.Symbol, ...] = ()
    states: tuple[State, ...] = ()
    seconds: float = 0.0
    horizon: int = 0

    @property
    def found(self) -> bool:
        """Whether the goal can be reached by these actions (none where it holds already)."""
        return self.status in (PlanStatus.FOUND, PlanStatus.ALREADY_TRUE)

    def _repr_html_(self) -> str:
        """What a notebook shows: how the search ended, and the actions in order."""
        said = html_line(f"{self.status.value} ({1000 * self.seconds:.0f} ms)")
        return said + html_list(str(action) for action in self.actions)

    def settles(self, start: State) -> bool:
        """Whether the plan, made from ``start``, takes something to be so that is unknown there.

        Where it does not, it supposes nothing; where it does,
        :func:`seewhy.planning.execution.plan_monitoring.suppositions` says what of that must be so.

        Examples
        --------
        >>> here, there = clingo.Function("here"), clingo.Function("there")
        >>> start = State(frozenset({here}), frozenset({there}))
        >>> found = Plan(PlanStatus.ALREADY_TRUE, states=(State(frozenset({here, there})),))
        >>> found.settles(start), Plan(PlanStatus.ALREADY_TRUE, states=(start,)).settles(start)
        (True, False)
        """
        return self.found and self.states[0].unknown != start.unknown
