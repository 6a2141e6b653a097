"""What a robot tried in earlier runs: what was to come of it, and what was seen to."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

import clingo

from seewhy.knowledge.axiom import Axiom, AxiomKind
from seewhy.knowledge.bounded_control import BoundedControl
from seewhy.knowledge.dynamics import body_at, fixed_rules, rule
from seewhy.knowledge.ground import complement_of, key_of
from seewhy.knowledge.grounding_size import grounding_size
from seewhy.knowledge.history import History
from seewhy.knowledge.language import Knowledge
from seewhy.planning.diagnosis.belief_state import State
from seewhy.planning.diagnosis.diagnosis import diagnose
from seewhy.planning.domain import PlanningDomain
from seewhy.planning.execution.plan_monitoring import state_after
from seewhy.planning.learning.cases import Run

__all__ = ["Attempt", "attempts_of", "spoken_about"]


@dataclass(frozen=True)
class Attempt:
    """An action that was tried, of whose effects something was seen.

    Attributes
    ----------
    action : clingo.Symbol
    missed : tuple of clingo.Symbol
        What should have changed by it, and was seen not to.
    run : int
        The place of the run in the record.
    before : State
        What is believed, of the whole run, about how things were when it was tried.
    """

    action: clingo.Symbol
    missed: tuple[clingo.Symbol, ...]
    run: Run
    before: State


def attempts_of(domain: PlanningDomain, history: History, run: Run) -> Iterator[Attempt]:
    """Yield what was tried in a run and seen to come of it, equal ones once.

    Counted is what the knowledge holds possible, and would have changed something that was then
    seen. To have tried the same fifty times with the same end is to have tried it once: what is
    done again and again in one run is done to the same things.

    Examples
    --------
    >>> from dataclasses import replace
    >>> from seewhy.knowledge.history import read_history
    >>> from seewhy.planning.domain import load_planning_domain
    >>> table = load_planning_domain("tabletop")
    >>> robot = table.without("impossible put_on(R, X, Y) if shape(Y, sphere).")
    >>> robot = robot.without("falls(X) if on(X, Y), shape(Y, sphere).")
    >>> run = read_history('''
    ... observed holding(hand, thing1) at 0. attempted put_on(hand, thing1, thing6) at 0.
    ... observed -on(thing1, thing6) at 1. observed -holding(hand, thing1) at 1.
    ... ''', table.knowledge.signature)
    >>> for attempt in attempts_of(robot, run, 0):
    ...     print(attempt.action, *attempt.missed)
    put_on(hand,thing1,thing6) on(thing1,thing6)
    """
    known = domain.knowledge
    states = diagnose(known, history, sensors_err=domain.sensors_err).states
    seen: dict[int, set[clingo.Symbol]] = {}
    for observation in history.observations:
        literal = clingo.parse_term(key_of(observation.literal))
        seen.setdefault(observation.step, set()).add(literal)
    found: set[tuple[clingo.Symbol, bool]] = set()
    for occurrence in history.occurrences:
        action, before = clingo.parse_term(key_of(occurrence.action)), states[occurrence.step]
        if known.signature.kind(action.name).value != "action":
            continue
        after = state_after(known, [action], start=before)
        changed = frozenset[clingo.Symbol]() if after is None else after.holds - before.holds
        then = seen.get(occurrence.step + 1, set())
        missed = tuple(sorted(effect for effect in changed if complement_of(effect) in then))
        outcome = action, bool(missed)
        if (missed or changed & then) and outcome not in found:
            found.add(outcome)
            yield Attempt(action, missed, run, before)


def spoken_about(
    knowledge: Knowledge, axioms: Sequence[Axiom], attempt: Attempt
) -> tuple[Axiom, ...]:
    """Return the executability conditions by which what was tried is impossible.

    Examples
    --------
    >>> from seewhy.knowledge.language import read_knowledge
    >>> known = read_knowledge('''
    ... #sort lamp = {desk, hall}. #fluent basic lit(lamp). #action press(lamp).
    ... impossible press(L) if lit(L). impossible press(hall).
    ... ''')
    >>> lit = State(frozenset({clingo.parse_term("lit(desk)")}))
    >>> attempt = Attempt(clingo.parse_term("press(desk)"), (), 0, lit)
    >>> [str(axiom) for axiom in spoken_about(known, known.axioms, attempt)]
    ['impossible press(L) if lit(L).']
    """
    about = {
        f"a{number}": axiom
        for number, axiom in enumerate(axioms)
        if axiom.kind is AxiomKind.EXECUTABILITY_CONDITION
        and axiom.action is not None
        and axiom.action.predicate == attempt.action.name
    }
    if not about:
        return ()
    lines = [
        *fixed_rules(knowledge),
        f"occurs({attempt.action}, 0). at(0, 0). #defined holds/2.",
        " ".join(f"holds({literal}, 0)." for literal in sorted(attempt.before.holds)),
        *_spoken(about, knowledge),
    ]
    control = BoundedControl("\n".join(lines), size=grounding_size(knowledge))
    named = {str(atom.symbol.arguments[0]) for atom in control.by_signature("spoken", 1)}
    return tuple(axiom for name, axiom in about.items() if name in named)


def _spoken(about: Mapping[str, Axiom], knowledge: Knowledge) -> Iterator[str]:
    for name, axiom in about.items():
        body = body_at(axiom, knowledge.signature, "0")
        yield rule(f"spoken({name})", [f"occurs({axiom.action}, 0)", *body])
