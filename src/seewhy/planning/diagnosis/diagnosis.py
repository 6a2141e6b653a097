"""Diagnose a history: the fewest exceptions and unseen events under which it makes sense.

The program of a history is that of the paper (section 3.2, statement (6)): inertia for basic
fluents, closed world for defined fluents and actions, reality checks that compare observations
with what is predicted, awareness (every basic fluent is true or false at first), and
consistency-restoring rules for defaults, for exogenous actions and for attempts that fail.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from enum import StrEnum
from functools import lru_cache

import clingo

from seewhy.errors import PlanningError
from seewhy.knowledge.axiom import Axiom, AxiomKind, predicates_in
from seewhy.knowledge.bounded_control import BoundedControl
from seewhy.knowledge.dynamics import (
    body_at,
    constraints,
    gives_way,
    instance,
    of_kind,
    rule,
    transition_rules,
)
from seewhy.knowledge.ground import complement_of, key_of
from seewhy.knowledge.grounding_size import grounding_size
from seewhy.knowledge.history import History, Observation, Occurrence
from seewhy.knowledge.language import Knowledge
from seewhy.knowledge.signature import Signature
from seewhy.planning.diagnosis.belief_state import State

# Few surprises explain most histories: raising the bound from below proves that soonest.
_OPTIONS = ["--opt-strategy=usc", "--restart-on-model"]
_PROGRAM = """
1 { holds(F, 0); holds(-F, 0) } 1 :- fluent(basic, F).
occurs(A, T) :- happened(A, T).
1 { occurs(A, T); failed(A, T) } 1 :- attempted(A, T).
{ occurs(A, T) } :- exogenous(A), step(T), step(T+1).
event(A, T) :- occurs(A, T), exogenous(A), not happened(A, T).
:- observed(L, T), not holds(L, T), not misread(L, T).
#minimize { 1@2, exception(I, V) : exception(I, V); 1@2, event(A, T) : event(A, T);
            1@2, failed(A, T) : failed(A, T); 1@2, misread(L, T) : misread(L, T) }.
#minimize { 1@1, event(A, T) : event(A, T); 1@1, failed(A, T) : failed(A, T);
            2@1, misread(L, T) : misread(L, T) }.
#minimize { N-T@0, A, T : event(A, T), last(N) }.
at(seen, seen).
holds(L, seen) :- observed(L, 0), not misread(L, 0).
evident(L) :- holds(L, seen).
#defined misread/2. #defined observed/2.
#show evident/1. #show holds/2. #show exception/2. #show event/2. #show failed/2. #show misread/2.
"""


class SurpriseKind(StrEnum):
    """What a diagnosis may assume."""

    EXCEPTION = "exception"
    EVENT = "event"
    FAILURE = "failed"
    MISREADING = "misread"


@dataclass(frozen=True, order=True)
class Surprise:
    """One thing that a diagnosis assumes.

    Attributes
    ----------
    step : int
    kind : SurpriseKind
    what : clingo.Symbol
        The conclusion that a default would have had, the event, the action that failed, or the
        observation that was wrong.
    axiom : Axiom or None
        The default that does not apply.
    certain : bool
        Whether every preferred explanation assumes it; others may differ in where somebody went.
    """

    step: int
    kind: SurpriseKind
    what: clingo.Symbol
    axiom: Axiom | None = field(default=None, compare=False)
    certain: bool = field(default=True, compare=False)


@dataclass(frozen=True)
class Diagnosis:
    """What a history means: the states that it went through, and what must be assumed for it.

    Attributes
    ----------
    states : tuple of State
        One a step, from 0 to the last; believed is what holds under every preferred explanation.
    surprises : tuple of Surprise
        Of one preferred explanation, in the order of the steps; empty where all went as believed.
    """

    states: tuple[State, ...]
    surprises: tuple[Surprise, ...]

    @property
    def now(self) -> State:
        """The state that the history ends in."""
        return self.states[-1]


def diagnose(
    knowledge: Knowledge, history: History, *, last: int | None = None, sensors_err: bool = False
) -> Diagnosis:
    """Return what is believed after a history, and the surprises that explain it.

    The fewest surprises are preferred; of as few, exceptions to what is usual at first, then
    unseen events and failures (the latest that explain what was seen), then wrong observations.

    Parameters
    ----------
    knowledge : Knowledge
    history : History
    last : int, optional
        The step to look at; default the last one of the history.
    sensors_err : bool
        Whether an observation may be assumed wrong.

    Raises
    ------
    PlanningError
        If nothing that may be assumed explains the history; the text names the observations or
        actions that do not go together.

    Examples
    --------
    >>> from seewhy.knowledge.history import read_history
    >>> from seewhy.knowledge.language import read_knowledge
    >>> known = read_knowledge('''
    ... #sort place = {library, office}. #fluent basic sally_in(place).
    ... -sally_in(L2) if sally_in(L1), L1 != L2.
    ... default sally_in(office).
    ... ''')
    >>> usual = diagnose(known, read_history("", known.signature))
    >>> [str(fluent) for fluent in usual.now.positive()]
    ['sally_in(office)']
    >>> seen = read_history("observed sally_in(library) at 1.", known.signature)
    >>> [(surprise.kind.value, str(surprise.what))
    ...     for surprise in diagnose(known, seen).surprises]
    [('exception', 'sally_in(office)')]
    """
    last = history.last_step if last is None else max(last, history.last_step)
    text = diagnosis_program(knowledge, last=last, sensors_err=sensors_err) + "\n".join(
        history_facts(history)
    )
    # The same history is looked at again by who answers questions about it.
    key = (text, last, knowledge.axioms)
    known = _DIAGNOSED.get(key)
    if known is not None:
        return known
    size = grounding_size(knowledge).times(last + 1)
    found = _diagnosed(knowledge, BoundedControl(text, size=size, arguments=_OPTIONS), last)
    if found is None:
        raise PlanningError(unexplained(knowledge, history))
    if len(_DIAGNOSED) >= _MOST_KEPT:
        _DIAGNOSED.pop(next(iter(_DIAGNOSED)), None)
    _DIAGNOSED[key] = found
    return found


_MOST_KEPT = 64
_DIAGNOSED: dict[tuple[str, int, tuple[Axiom, ...]], Diagnosis] = {}
"""The latest diagnoses, by the program that they come from and the sentences of its axioms."""


def _diagnosed(knowledge: Knowledge, control: BoundedControl, last: int) -> Diagnosis | None:
    """What the preferred answer sets of a diagnosis program say; None where there is none."""
    best = control.last_model()
    if best is None:
        return None
    solve = control.configuration
    solve.opt_mode, solve.enum_mode, solve.models = "optN", "cautious", 0
    sure = control.last_model() or []
    fluents = [atom.symbol.arguments[1] for atom in control.by_signature("fluent", 2)]
    return Diagnosis(
        states=tuple(_states(sure, fluents, last)),
        surprises=tuple(sorted(_surprises(knowledge, best, frozenset(sure)))),
    )


def explained(knowledge: Knowledge, history: History, *, sensors_err: bool = False) -> bool:
    """Whether anything that may be assumed explains a history, by however many surprises.

    Examples
    --------
    >>> from seewhy.knowledge.history import read_history
    >>> from seewhy.knowledge.language import read_knowledge
    >>> known = read_knowledge("#fluent basic dark. #fluent basic lit. -lit if dark.")
    >>> both = read_history("observed dark at 0. observed lit at 0.", known.signature)
    >>> explained(known, both)
    False
    """
    lines = [
        diagnosis_program(knowledge, last=history.last_step, sensors_err=sensors_err),
        *history_facts(history),
    ]
    control = BoundedControl(
        "\n".join(lines),
        size=grounding_size(knowledge).times(history.last_step + 1),
        arguments=["--opt-mode=ignore"],
    )
    return control.satisfiable()


def diagnosis_program(knowledge: Knowledge, *, last: int, sensors_err: bool = False) -> str:
    """Return the program whose preferred answer sets explain a history of steps 0 to ``last``."""
    signature = knowledge.signature
    lines = list(transition_rules(knowledge, last=last))
    for axiom in constraints(knowledge):
        if not gives_way(axiom, signature):
            lines += _evident(axiom, signature)
            continue
        # At first a constraint that gives way is a default like any other.
        usual = [
            condition for condition in axiom.body if condition.literal != axiom.head.complement
        ]
        body = body_at(replace(axiom, body=tuple(usual)), signature, "0")
        lines.append(
            rule(f"exception({instance(axiom)})", [*body, f"holds({axiom.head.complement}, 0)"])
        )
    for axiom in of_kind(knowledge, AxiomKind.DEFAULT):
        body = body_at(axiom, signature, "0")
        lines.append(rule(f"{{ exception({instance(axiom)}) }}", body))
        lines.append(rule(f"holds({axiom.head.complement}, 0)", [f"exception({instance(axiom)})"]))
        lines.append(rule(f"holds({axiom.head}, 0)", [*body, f"not exception({instance(axiom)})"]))
    if sensors_err:
        lines.append("{ misread(L, T) } :- observed(L, T).")
    return "\n".join(lines) + _PROGRAM


def _evident(axiom: Axiom, signature: Signature) -> Iterator[str]:
    """Yield what follows by a constraint from what was seen at first, and from nothing else."""
    fluents = [
        condition
        for condition in axiom.body
        if any(map(signature.changes, predicates_in(condition.text)))
    ]
    if all(condition.literal and not condition.absent for condition in fluents):
        yield rule(f"holds({axiom.head}, seen)", body_at(axiom, signature, "seen"))


def history_facts(history: History) -> Iterator[str]:
    """Yield a history as facts."""
    for seen in history.observations:
        yield f"observed({seen.literal}, {seen.step})."
    for done in history.occurrences:
        yield f"{'attempted' if done.attempted else 'happened'}({done.action}, {done.step})."


def _states(sure: list[clingo.Symbol], fluents: list[clingo.Symbol], last: int) -> Iterator[State]:
    holds: list[set[clingo.Symbol]] = [set() for _ in range(last + 1)]
    for literal, step in filter(None, map(_held, sure)):
        holds[step].add(literal)
    denials = [(fluent, complement_of(fluent)) for fluent in fluents]
    for believed in holds:
        unknown = (
            fluent
            for fluent, denial in denials
            if fluent not in believed and denial not in believed
        )
        yield State(frozenset(believed), frozenset(unknown))


@lru_cache(maxsize=65_536)
def _held(atom: clingo.Symbol) -> tuple[clingo.Symbol, int] | None:
    """A literal and the step at which an atom says that it holds; None where it says otherwise."""
    if atom.name != "holds":
        return None
    literal, step = atom.arguments
    return (literal, step.number) if step.type is clingo.SymbolType.Number else None


def _surprises(
    knowledge: Knowledge,
    model: list[clingo.Symbol],
    sure: frozenset[clingo.Symbol],
) -> Iterator[Surprise]:
    named = [(atom.name, atom) for atom in model]
    evident = {str(atom.arguments[0]) for name, atom in named if name == "evident"}
    axioms = {axiom.identifier: axiom for axiom in knowledge.axioms}
    for name, atom in named:
        if name == SurpriseKind.EXCEPTION:
            axiom = axioms[str(atom.arguments[0])]
            binding = dict(zip(axiom.variables, map(str, atom.arguments[1].arguments), strict=True))
            head = axiom.head.substitute(binding)
            if key_of(head.complement) in evident:
                continue  # seen, or clear from what was seen, and not assumed
            usual = clingo.parse_term(str(head))
            yield Surprise(0, SurpriseKind.EXCEPTION, usual, axiom, atom in sure)
        elif name in (SurpriseKind.EVENT, SurpriseKind.FAILURE, SurpriseKind.MISREADING):
            yield Surprise(
                step=atom.arguments[1].number,
                kind=SurpriseKind(name),
                what=atom.arguments[0],
                certain=atom in sure,
            )


def smallest_correction_set(
    knowledge: Knowledge, history: History
) -> tuple[Observation | Occurrence, ...] | None:
    """Return what a history that nothing explains should not say, as few entries as possible.

    None where no history at all could be explained.

    Examples
    --------
    >>> from seewhy.knowledge.history import read_history
    >>> from seewhy.knowledge.language import read_knowledge
    >>> known = read_knowledge("#fluent basic dark. #fluent basic lit. -lit if dark.")
    >>> both = read_history("observed dark at 0. observed lit at 0. observed lit at 1.",
    ...     known.signature)
    >>> [str(entry) for entry in smallest_correction_set(known, both)]
    ['observed dark at 0.']
    """
    entries: list[Observation | Occurrence] = [*history.observations, *history.occurrences]
    lines = [
        diagnosis_program(knowledge, last=history.last_step),
        "#minimize { 1@3, E : wrong(E) }.",
    ]
    for number, fact in enumerate(history_facts(history)):
        lines.append(f"{{ wrong({number}) }}. {fact.rstrip('.')} :- not wrong({number}).")
    control = BoundedControl(
        "\n".join([*lines, "#show wrong/1."]),
        size=grounding_size(knowledge).times(history.last_step + 1),
        arguments=_OPTIONS,
    )
    best = control.last_model()
    if best is None:
        return None
    wrong = sorted(atom.arguments[0].number for atom in best if atom.name == "wrong")
    return tuple(entries[number] for number in wrong)


def unexplained(knowledge: Knowledge, history: History) -> str:
    """Say which entries of a history that nothing explains would have to be otherwise."""
    wrong = smallest_correction_set(knowledge, history)
    if wrong is None:
        return (
            f"{knowledge.file}: no state satisfies the axioms, whatever is observed; look for "
            "defaults or constraints that contradict each other"
        )
    said = " and ".join(f"'{str(entry).rstrip('.')}'" for entry in wrong)
    return (
        f"nothing that may be assumed explains this history as long as it says {said}; correct "
        f"{'it' if len(wrong) == 1 else 'them'}, or add to the knowledge what could have happened"
    )
