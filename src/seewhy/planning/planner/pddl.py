"""Export a planning problem as PDDL, for other planners."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

import clingo

from seewhy.knowledge.language import Knowledge
from seewhy.planning.diagnosis.belief_state import State
from seewhy.planning.goal import Goal, with_goal
from seewhy.planning.planner.compilation import ground_problem
from seewhy.planning.planner.ground_problem import GroundProblem, Literals
from seewhy.planning.planner.relevance import relevant

_NEVER = "nothing_reaches_the_goal"


@dataclass(frozen=True)
class PddlProblem:
    """A planning problem as planners for PDDL read it: a domain and a problem, as text."""

    domain: str
    problem: str


def to_pddl(knowledge: Knowledge, goal: Goal, *, start: State) -> PddlProblem:
    """Return the problem as PDDL, without variables and without what cannot matter to the goal.

    A comment above every action says which action of the knowledge it is. An action that can be
    done in several situations has one PDDL action for each; every one counts as one step, so
    that shortest plans are as long as :func:`seewhy.planning.planner.planner.plan` makes them.

    Raises
    ------
    PlanningError
        If PDDL cannot say it: an axiom counts fluents or leaves open what happens, or something
        that matters is unknown at the start. The text names the axiom or the fluent.

    Examples
    --------
    >>> from seewhy.knowledge.history import read_history
    >>> from seewhy.knowledge.language import read_knowledge
    >>> from seewhy.planning.diagnosis.diagnosis import diagnose
    >>> from seewhy.planning.goal import read_goal
    >>> known = read_knowledge("#fluent basic lit. #action press. press causes lit.")
    >>> start = diagnose(known, read_history("observed -lit at 0.", known.signature)).now
    >>> print(to_pddl(known, read_goal("lit", known), start=start).problem)
    (define (problem knowledge-problem)
      (:domain knowledge)
      (:init)
      (:goal (and (lit)))
    )
    """
    problem = ground_problem(relevant(with_goal(knowledge, goal)), start)
    names = _names(problem.fluents)
    goals = [_conjunction(literals, names) for literals in problem.goals]
    wanted = goals[0] if len(goals) == 1 else f"(or {' '.join(goals)})"
    predicates = " ".join(f"({name})" for name in [*names, *([] if goals else [_NEVER])])
    domain = [
        "(define (domain knowledge)",
        f"  (:requirements {' '.join(_requirements(problem))})",
        f"  (:predicates {predicates})",
        *(
            f"  (:derived ({names[head - 1]}) {_conjunction(body, names)})"
            for stratum in problem.derivations
            for head, body in stratum
        ),
        *_actions(problem, names),
        ")",
    ]
    defined = {head for stratum in problem.derivations for head, _ in stratum}
    facts = "".join(f" ({names[fluent - 1]})" for fluent in sorted(problem.start - defined))
    text = [
        "(define (problem knowledge-problem)",
        "  (:domain knowledge)",
        f"  (:init{facts})",
        f"  (:goal {wanted if goals else f'(and ({_NEVER}))'})",
        ")",
    ]
    return PddlProblem("\n".join(domain), "\n".join(text))


def _requirements(problem: GroundProblem) -> Iterator[str]:
    conditions = [operator.condition for operator in problem.operators]
    whens = [body for operator in problem.operators for body, _ in operator.effects if body]
    bodies = [body for stratum in problem.derivations for _, body in stratum]
    yield ":strips"
    if any(
        literal < 0 for part in (*conditions, *whens, *bodies, *problem.goals) for literal in part
    ):
        yield ":negative-preconditions"
    if whens:
        yield ":conditional-effects"
    if bodies:
        yield ":derived-predicates"
    if len(problem.goals) > 1:
        yield ":disjunctive-preconditions"


def _actions(problem: GroundProblem, names: Sequence[str]) -> Iterator[str]:
    titles = _names([operator.action for operator in problem.operators])
    for operator, title in zip(problem.operators, titles, strict=True):
        effects = [
            f"(when {_conjunction(body, names)} {_literal(head, names)})"
            if body
            else _literal(head, names)
            for body, head in operator.effects
        ]
        yield f"  ; {operator.action}"
        yield f"  (:action {title}"
        yield "    :parameters ()"
        yield f"    :precondition {_conjunction(operator.condition, names)}"
        yield f"    :effect (and {' '.join(effects)}))"


def _conjunction(literals: Literals, names: Sequence[str]) -> str:
    parts = [
        _literal(literal, names)
        for literal in sorted(literals, key=lambda literal: (literal < 0, abs(literal)))
    ]
    return f"(and{''.join(f' {part}' for part in parts)})"


def _literal(literal: int, names: Sequence[str]) -> str:
    name = f"({names[abs(literal) - 1]})"
    return name if literal > 0 else f"(not {name})"


def _names(symbols: Iterable[clingo.Symbol]) -> list[str]:
    """Names that PDDL allows, each once: ``move(rob1,kitchen)`` becomes ``move_rob1_kitchen``."""
    taken: set[str] = set()
    names = []
    for symbol in symbols:
        plain = re.sub(r"[^a-z0-9]+", "_", str(symbol).lower()).strip("_") or "it"
        plain = plain if plain[0].isalpha() else f"n_{plain}"
        number, name = 1, plain
        while name in taken:
            number += 1
            name = f"{plain}_{number}"
        taken.add(name)
        names.append(name)
    return names
