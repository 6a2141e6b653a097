"""Whether a goal holds in a complete state, or is believed in one that is not."""

from __future__ import annotations

from collections.abc import Iterable

import clingo

from seewhy.knowledge.bounded_control import BoundedControl
from seewhy.knowledge.dynamics import body_at, fixed_rules, rule
from seewhy.knowledge.grounding_size import grounding_size
from seewhy.knowledge.language import Knowledge
from seewhy.planning.goal import Goal, with_goal


def goal_holds(knowledge: Knowledge, goal: Goal, literals: Iterable[clingo.Symbol]) -> bool:
    """Whether the conditions of the goal hold where these literals do.

    Examples
    --------
    >>> from seewhy.knowledge.language import read_knowledge
    >>> from seewhy.planning.goal import read_goal
    >>> known = read_knowledge("#sort place = {a, b}. #fluent basic at(place).")
    >>> goal_holds(known, read_goal("at(L), L != a", known), [clingo.parse_term("at(b)")])
    True
    """
    aimed = with_goal(knowledge, goal)
    lines = [
        *fixed_rules(aimed),
        rule("reached", body_at(goal.axiom, aimed.signature, "0")),
        "at(0, 0). :- not reached. #defined holds/2.",
        " ".join(f"holds({literal}, 0)." for literal in sorted(literals)),
    ]
    return BoundedControl("\n".join(lines), size=grounding_size(aimed)).satisfiable()
