"""Follow given actions from a state: do they reach the goal, and what must be so for that?"""

from __future__ import annotations

from collections.abc import Sequence

import clingo

from seewhy.knowledge.bounded_control import BoundedControl
from seewhy.knowledge.dynamics import transition_rules
from seewhy.knowledge.ground import fluent_of
from seewhy.knowledge.grounding_size import grounding_size
from seewhy.knowledge.language import Knowledge
from seewhy.knowledge.signature import PredicateKind
from seewhy.planning.diagnosis.belief_state import State
from seewhy.planning.goal import REACHED, Goal, with_goal


def reaches_goal(
    knowledge: Knowledge, goal: Goal, actions: Sequence[clingo.Symbol], *, start: State
) -> bool:
    """Whether the actions can be done one after the other from ``start``, and end in the goal.

    What is unknown at the start may be as it has to be.
    """
    aimed = with_goal(knowledge, goal)
    wanted = f":- not holds({REACHED}, {len(actions)})."
    return _solved(aimed, actions, start, wanted, cautious=False) is not None


def suppositions(
    knowledge: Knowledge, goal: Goal, actions: Sequence[clingo.Symbol], *, start: State
) -> tuple[clingo.Symbol, ...]:
    """Return what is unknown at the start and must be so for the actions to reach the goal.

    Where a fluent must hold of something, that it must not hold of other things is left out. Where
    there are several ways and none of it must be so, it is what holds in one with the least of it.

    Examples
    --------
    >>> from seewhy.knowledge.language import read_knowledge
    >>> from seewhy.planning.goal import read_goal
    >>> known = read_knowledge('''
    ... #fluent basic has_key. #fluent basic open. #action push.
    ... push causes open. impossible push if not has_key.
    ... ''')
    >>> closed, has_key = clingo.parse_term("-open"), clingo.Function("has_key")
    >>> start = State(frozenset({closed}), frozenset({has_key}))
    >>> push = [clingo.Function("push")]
    >>> supposed = suppositions(known, read_goal("open", known), push, start=start)
    >>> [str(literal) for literal in supposed]
    ['has_key']
    """
    aimed = with_goal(knowledge, goal)
    wanted = f":- not holds({REACHED}, {len(actions)})."
    model = _solved(aimed, actions, start, wanted, cautious=True) or []
    at_first = (atom.arguments[0] for atom in model if atom.arguments[1].number == 0)
    unknown = start.unknown
    needed = [
        literal
        for literal in at_first
        if fluent_of(literal) in unknown
        and knowledge.signature.kind(literal.name) is PredicateKind.FLUENT_BASIC
    ]
    if not needed:
        model = _solved(aimed, actions, start, wanted, cautious=False) or []
        at_first = (atom.arguments[0] for atom in model if atom.arguments[1].number == 0)
        needed = [literal for literal in at_first if literal in unknown]
    affirmed = {literal.name for literal in needed if literal.positive}
    return tuple(
        sorted(literal for literal in needed if literal.positive or literal.name not in affirmed)
    )


def _solved(
    knowledge: Knowledge,
    actions: Sequence[clingo.Symbol],
    start: State,
    wanted: str,
    *,
    cautious: bool,
) -> list[clingo.Symbol] | None:
    basic = [
        fluent
        for fluent in sorted(start.unknown)
        if knowledge.signature.kind(fluent.name) is PredicateKind.FLUENT_BASIC
    ]
    lines = [
        *transition_rules(knowledge, last=len(actions)),
        " ".join(f"holds({literal}, 0)." for literal in sorted(start.holds)),
        " ".join(f"1 {{ holds({fluent}, 0); holds(-{fluent}, 0) }} 1." for fluent in basic),
        " ".join(f"occurs({action}, {step})." for step, action in enumerate(actions)),
        wanted,
        "#show holds/2.",
    ]
    if not cautious:
        lines += [f":~ holds({fluent}, 0). [1, {fluent}]" for fluent in basic]
    size = grounding_size(knowledge).times(len(actions) + 1)
    control = BoundedControl("\n".join(lines), size=size)
    if cautious:
        control.configuration.enum_mode, control.configuration.models = "cautious", 0
    return control.last_model()


def state_after(
    knowledge: Knowledge, actions: Sequence[clingo.Symbol], *, start: State
) -> State | None:
    """Return what is known after the actions; None where they cannot be done one after the other.

    Examples
    --------
    >>> from seewhy.knowledge.language import read_knowledge
    >>> known = read_knowledge("#fluent basic lit. #action press. press causes lit. "
    ...     "impossible press if lit.")
    >>> press = clingo.Function("press")
    >>> dark = State(frozenset({clingo.parse_term("-lit")}))
    >>> [str(literal) for literal in state_after(known, [press], start=dark).holds]
    ['lit']
    >>> state_after(known, [press, press], start=dark) is None
    True
    """
    model = _solved(knowledge, actions, start, "", cautious=True)
    if model is None:
        return None
    last = len(actions)
    holds = frozenset(atom.arguments[0] for atom in model if atom.arguments[1].number == last)
    known = {fluent_of(literal) for literal in holds}
    before = {fluent_of(literal) for literal in start.holds} | start.unknown
    return State(holds, frozenset(before - known))
