"""Say actions, what stood in their way and how a run ended, and give them as values for JSON."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from typing import Any

import clingo

from seewhy.domain.wording import join_words
from seewhy.knowledge.axiom import Literal
from seewhy.knowledge.ground import complement_of, key_of
from seewhy.knowledge.signature import PredicateKind
from seewhy.planning.dialogue.action_reason import Failing
from seewhy.planning.dialogue.belief_answers import instead_of
from seewhy.planning.dialogue.instances import Applied
from seewhy.planning.dialogue.query import Query
from seewhy.planning.dialogue.run_view import RunView
from seewhy.planning.dialogue.surface_realisation import Speech
from seewhy.planning.execution.execution import Decision, Outcome, Run, Step
from seewhy.planning.execution.plan_monitoring import suppositions


def say_actions(actions: Iterable[clingo.Symbol], speech: Speech) -> str:
    """Actions as what is to be done: "move to the kitchen and print the first message"."""
    return join_words([speech.do(action) for action in actions])


def count_actions(actions: int) -> str:
    """A number of actions in words.

    Examples
    --------
    >>> count_actions(1), count_actions(2)
    ('1 action', '2 actions')
    """
    return f"{actions} action{'s' * (actions != 1)}"


def say_obstacle(obstacles: Sequence[Applied], speech: Speech, *, past: bool = True) -> str:
    """The first obstacle as a clause, those with a sentence before the others.

    ``past`` says whether it is told of what was done; else of what is to be done.
    """
    ranked = sorted(obstacles, key=lambda applied: not applied.axiom.has_sentence)
    if not ranked:
        return ""
    first = ranked[0]
    literals = [*first.holds, *first.counted]
    literals += [complement_of(absent) for absent in first.absent]
    literals += [*first.statics, *map(complement_of, first.absent_statics)]
    said = speech.every_past(literals) if past else speech.every(literals)
    text = f'"{first.axiom.text}"' if first.axiom.has_sentence else ""
    return ", and ".join(filter(None, [text, said]))


def obstacle_values(applied: Applied) -> dict[str, Any]:
    """An obstacle as values that JSON can hold."""
    return {
        "axiom": applied.axiom.text,
        "holds": [str(literal) for literal in applied.holds],
        "counted": [str(literal) for literal in applied.counted],
        "absent": [str(literal) for literal in applied.absent],
        "statics": [str(literal) for literal in applied.statics],
        "absent_statics": [str(literal) for literal in applied.absent_statics],
    }


def needs_values(needs: Sequence[Failing], run: Run) -> list[dict[str, Any]]:
    """What needed an action, up to the goal, as values that JSON can hold."""
    return [
        {
            "action": None if need.action is None else str(need.action),
            "goal": run.goal.text if need.action is None else None,
            "obstacles": [obstacle_values(applied) for applied in need.obstacles],
        }
        for need in needs
    ]


def say_gave_up(step: Step, speech: Speech) -> str:
    """That the robot gave up at a step, and since what was so."""
    since = speech.every_past(step.because)
    return f"I gave up: the goal could not be reached{', since ' if since else ''}{since}"


def say_no_way(step: Step, speech: Speech) -> str:
    """That the goal cannot be reached from a step on, and since what is so."""
    since = speech.every(step.because)
    return f"the goal cannot be reached{', since ' if since else ''}{since}"


def say_end(run: Run, speech: Speech) -> str:
    """How a run ended; nothing where it goes on."""
    if run.outcome is Outcome.ACHIEVED:
        return "the goal is reached"
    if run.outcome is Outcome.IMPOSSIBLE:
        return say_gave_up(run.steps[-1], speech)
    if run.outcome is Outcome.OUT_OF_STEPS:
        return "I stopped because I had no more steps"
    return ""


def say_supposed(view: RunView, step: Step) -> str:
    """What is not known and must be so for a step's plan."""
    start = view.intentions.start(step)
    knowledge = view.domain.knowledge
    needed = [
        literal
        for literal in suppositions(knowledge, view.run.goal, step.plan, start=start)
        if knowledge.signature.kind(literal.name) is PredicateKind.FLUENT_BASIC
        and literal not in step.believed.holds
    ]
    return view.speech.every([literal for literal in needed if literal.positive] or needed)


def say_hoped(view: RunView, step: Step) -> str:
    """What the plan of a step only supposed: it was not known, or believed to be otherwise."""
    made = [
        earlier
        for earlier in view.run.steps
        if earlier.number <= step.number and earlier.decision in (Decision.PLAN, Decision.REPLAN)
    ]
    kind = view.domain.knowledge.signature.kind
    open_then = [
        literal
        for literal in (made[-1].supposed if made else ())
        if kind(literal.name) is PredicateKind.FLUENT_BASIC and literal not in step.believed.holds
    ]
    hoped = [literal for literal in open_then if literal.positive] or open_then
    if not hoped:
        return ""
    said = f"my plan only supposed that {view.speech.every_past(hoped)}"
    denied = [complement_of(literal) for literal in hoped]
    if not step.believed.holds.issuperset(denied):
        return f"{said}, which I did not know"
    believed = [instead_of(view.domain, literal, step.believed) for literal in denied]
    return f"{said}: what I believed, that {view.speech.every_past(believed)}, might have changed"


def say_not_done(view: RunView, query: Query, *, have: bool = False) -> str:
    """That an action was not done, and which other robot did it where one did."""
    terms = [clingo.parse_term(argument or '"anything"') for argument in query.arguments]
    action = clingo.Function(query.predicate or "", terms)
    said = f"{view.speech.subject(action)} {_negated(view, query, action, have=have)}"
    others = view.done_by_others(query)
    if not others or query.step is not None:
        return said
    last = others[-1]
    assert last.action is not None
    return f"{said}; {view.speech.subject(last.action)} did at step {last.number}"


def _negated(view: RunView, query: Query, action: clingo.Symbol, *, have: bool) -> str:
    third = "has" if view.speech.subject(action) != "I" else "have"
    if re.match(r"(why )?(did|do|have) you ", query.text) and None in query.arguments:
        # Of "have you delivered the message", what was named alone.
        named = re.sub(r"^(why )?(did|do|have) you (not )?", "", query.text)
        named = re.sub(r" at step \d+$", "", named)
    elif have:
        named = view.speech.did(action)
    else:
        named = view.speech.act(action)
    return f"{third if have else 'did'} not {named}"


def actions_asked(view: RunView, query: Query) -> list[clingo.Symbol]:
    """The actions that a question may be about, sorted."""
    signature = view.domain.knowledge.signature
    found: list[tuple[str, ...]] = [()]
    sorts = signature.predicates[query.predicate or ""].sorts
    for argument, sort in zip(query.arguments, sorts, strict=True):
        values = [argument] if argument is not None else signature.members(sort)
        found = [(*before, value) for before in found for value in values]
    return sorted(
        clingo.parse_term(key_of(Literal(query.predicate or "", arguments))) for arguments in found
    )
