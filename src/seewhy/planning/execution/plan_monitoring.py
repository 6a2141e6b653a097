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


def follow(
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
    >>> [str(own) for own in suppositions(known, read_goal("open", known), push, start=start)]
    ['has_key']
    """
    aimed = with_goal(knowledge, goal)
    wanted = f":- not holds({REACHED}, {len(actions)})."
    model = _solved(aimed, actions, start, wanted, cautious=True) or []
    at_first = (own.arguments[0] for own in model if own.arguments[1].number == 0)
    unknown = start.unknown
    needed = [
        own
        for own in at_first
        if fluent_of(own) in unknown
        and knowledge.signature.kind(own.name) is PredicateKind.FLUENT_BASIC
    ]
    if not needed:
        model = _solved(aimed, actions, start, wanted, cautious=False) or []
        at_first = (own.arguments[0] for own in model if own.arguments[1].number == 0)
        needed = [own for own in at_first if own in unknown]
    affirmed = {own.name for own in needed if own.positive}
    return tuple(sorted(own for own in needed if own.positive or own.name not in affirmed))


def _solved(
    knowledge: Knowledge,
    actions: Sequence[clingo.Symbol],
    start: State,
    wanted: str,
    *,
    cautious: bool,
) -> list[clingo.Symbol] | None:
    basic = [
        own
        for own in sorted(start.unknown)
        if knowledge.signature.kind(own.name) is PredicateKind.FLUENT_BASIC
    ]
    lines = [
        *transition_rules(knowledge, last=len(actions)),
        " ".join(f"holds({own}, 0)." for own in sorted(start.holds)),
        " ".join(f"1 {{ holds({own}, 0); holds(-{own}, 0) }} 1." for own in basic),
        " ".join(f"occurs({own}, {step})." for step, own in enumerate(actions)),
        wanted,
        "#show holds/2.",
    ]
    if not cautious:
        lines += [f":~ holds({own}, 0). [1, {own}]" for own in basic]
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
    >>> [str(own) for own in state_after(known, [press], start=dark).holds]
    ['lit']
    >>> state_after(known, [press, press], start=dark) is None
    True
    """
    model = _solved(knowledge, actions, start, "", cautious=True)
    if model is None:
        return None
    last = len(actions)
    holds = frozenset(own.arguments[0] for own in model if own.arguments[1].number == last)
    known = {fluent_of(own) for own in holds}
    before = {fluent_of(own) for own in start.holds} | start.unknown
    return State(holds, frozenset(before - known))
