"""Tell a run step by step: what surprised the robot, what it decides, what it does."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import clingo

from seewhy.planning.execution.execution import Decision, Outcome, Run, Step
from seewhy.planning.words import PlanningWords, in_sequence


def narrate_step(words: PlanningWords, step: Step) -> list[str]:
    """Return what the robot says at a step, a sentence each.

    Examples
    --------
    >>> from seewhy.planning.diagnosis.belief_state import State
    >>> step = Step(0, (), State(frozenset()), (), Decision.PLAN, (clingo.Function("jump"),),
    ...     action=clingo.Function("jump"))
    >>> narrate_step(PlanningWords({}, {}, {}), step)
    ['I plan to jump.', 'I jump.']
    """
    return [_sentence(text) for text in _clauses(words, step)]


def narrate_end(run: Run) -> str:
    """Return how a run ended, in a sentence."""
    count = f"{len(run.actions)} action{'s' * (len(run.actions) != 1)}"
    plans = f"{len(run.plans)} plan{'s' * (len(run.plans) != 1)}"
    ended = {
        Outcome.ACHIEVED: "The robot believes that the goal is reached",
        Outcome.IMPOSSIBLE: "The robot gave up",
        Outcome.OUT_OF_STEPS: "The robot was stopped before it reached the goal",
        None: "The run was interrupted",
    }[run.outcome]
    return f"{ended}, after {count} and {plans}."


def _clauses(words: PlanningWords, step: Step) -> Iterator[str]:
    if step.surprises:
        found = [words.surprise(surprise) for surprise in step.surprises]
        yield f"I did not expect what I see; it must be that {in_sequence(found)}"
    if step.decision is Decision.STOP:
        if step.skipped:
            yield f"I need not {_all(words, step.skipped)} any more"
        yield "the goal is reached"
        return
    if step.decision is Decision.GIVE_UP:
        because = in_sequence(map(words.say, step.because))
        yield "I give up: no plan leads to the goal" + (f", because {because}" if because else "")
        return
    if step.decision is Decision.PLAN:
        yield f"I plan to {_all(words, step.plan)}"
    elif step.decision is Decision.REPLAN:
        yield f"my plan no longer works; I now plan to {_all(words, step.plan)}"
    elif step.decision is Decision.SKIP:
        yield f"I need not {_all(words, step.skipped)}; I go on with the rest of my plan"
    if step.supposed:
        yield f"this supposes that {in_sequence(map(words.say, step.supposed))}"
    if step.action is not None:
        yield f"I {words.do(step.action)}"


def _all(words: PlanningWords, actions: Sequence[clingo.Symbol]) -> str:
    return in_sequence(map(words.do, actions))


def _sentence(clause: str) -> str:
    return f"{clause[:1].upper()}{clause[1:]}."
