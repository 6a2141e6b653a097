"""Whether learned axioms go with what is known: with old beliefs, and with the recorded runs."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

from seewhy.errors import PlanningError
from seewhy.knowledge.axiom import Axiom
from seewhy.knowledge.history import History
from seewhy.planning.diagnosis.belief_state import State
from seewhy.planning.diagnosis.diagnosis import diagnose, explained, unexplained
from seewhy.planning.domain import PlanningDomain


@dataclass(frozen=True)
class Rejected:
    """An axiom that fits the record and is not learned all the same, and why."""

    axiom: Axiom
    reason: str


RecordedRun = tuple[str, PlanningDomain, History]
"""What errors call a run, the domain with the things that it is about, and what it shows."""


def check_explained(runs: Sequence[RecordedRun]) -> None:
    """Refuse a record with a run that nothing explains; the error names the run.

    Raises
    ------
    PlanningError
    """
    for name, domain, history in runs:
        if not explained(domain.knowledge, history, sensors_err=domain.sensors_err):
            raise PlanningError(f"{name}: {unexplained(domain.knowledge, history)}")


def at_first(domain: PlanningDomain) -> State | None:
    """Return what is believed at first; None where nothing can be."""
    try:
        return diagnose(domain.knowledge, domain.history).states[0]
    except PlanningError:
        return None


def validated(
    domain: PlanningDomain, runs: Sequence[RecordedRun], first: State, found: Sequence[Axiom]
) -> tuple[list[Axiom], list[Rejected]]:
    """Return the axioms that leave old beliefs as they are and the record explained, and the rest.

    Each is tried with those before it that were kept.
    """
    kept: list[Axiom] = []
    rejected: list[Rejected] = []
    for number, axiom in enumerate(found):
        numbered = replace(axiom, identifier=f"n{number}")
        learned = [*kept, numbered]
        now = at_first(domain.knowing(learned))
        reason = next(_objections(now, runs, first, learned), None)
        if reason is None and now is not None:
            kept.append(numbered)
            first = now
        else:
            rejected.append(Rejected(axiom, reason or ""))
    return kept, rejected


def validated_by_runs(
    runs: Sequence[RecordedRun], known: Sequence[Axiom], found: Sequence[Axiom]
) -> tuple[list[Axiom], list[Rejected]]:
    """Return the axioms about actions that leave every run explained, and the rest.

    Each is tried with what was learned besides, and with those before it that were kept.
    """
    kept: list[Axiom] = []
    rejected: list[Rejected] = []
    for number, axiom in enumerate(found):
        numbered = replace(axiom, identifier=f"m{number}")
        reason = next(unexplained_runs(runs, [*known, *kept, numbered]), None)
        if reason is None:
            kept.append(numbered)
        else:
            rejected.append(Rejected(axiom, reason))
    return kept, rejected


def unexplained_runs(runs: Sequence[RecordedRun], axioms: Sequence[Axiom]) -> Iterator[str]:
    """Yield which runs could not be explained with further axioms."""
    for name, domain, history in runs:
        known = domain.knowing(axioms).knowledge
        if not explained(known, history, sensors_err=domain.sensors_err):
            yield f"{name} could not be explained with it"


def _objections(
    now: State | None, runs: Sequence[RecordedRun], before: State, learned: Sequence[Axiom]
) -> Iterator[str]:
    if now is None:
        yield "nothing can be believed with it"
        return
    if now.holds == before.holds:
        yield "others say the same"
    for literal in sorted(before.holds - now.holds):
        yield f"'{literal}' would no longer be believed at first"
    yield from unexplained_runs(runs, learned)
