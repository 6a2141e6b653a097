"""Whether learned axioms go with what is known: with old beliefs, and with the recorded runs."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
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


def check_explained(domain: PlanningDomain, record: Mapping[str, History]) -> None:
    """Refuse a record with a run that nothing explains; the error names the run.

    Raises
    ------
    PlanningError
    """
    for name, run in record.items():
        if not explained(domain.knowledge, run, sensors_err=domain.sensors_err):
            raise PlanningError(f"{name}: {unexplained(domain.knowledge, run)}")


def at_first(domain: PlanningDomain) -> State | None:
    """Return what is believed at first; None where nothing can be."""
    try:
        return diagnose(domain.knowledge, domain.history).states[0]
    except PlanningError:
        return None


def validated(
    domain: PlanningDomain, record: Mapping[str, History], first: State, found: Sequence[Axiom]
) -> tuple[list[Axiom], list[Rejected]]:
    """Return the axioms that leave old beliefs as they are and the record explained, and the rest.

    Each is tried with those before it that were kept.
    """
    kept: list[Axiom] = []
    rejected: list[Rejected] = []
    for number, axiom in enumerate(found):
        numbered = replace(axiom, identifier=f"n{number}")
        with_it = domain.knowing([*kept, numbered])
        now = at_first(with_it)
        reason = next(_objections(with_it, now, record, first), None)
        if reason is None and now is not None:
            kept.append(numbered)
            first = now
        else:
            rejected.append(Rejected(axiom, reason or ""))
    return kept, rejected


def _objections(
    domain: PlanningDomain,
    now: State | None,
    record: Mapping[str, History],
    before: State,
) -> Iterator[str]:
    if now is None:
        yield "nothing can be believed with it"
        return
    if now.holds == before.holds:
        yield "others say the same"
    for literal in sorted(before.holds - now.holds):
        yield f"'{literal}' would no longer be believed at first"
    for name, run in record.items():
        if not explained(domain.knowledge, run, sensors_err=domain.sensors_err):
            yield f"{name} could not be explained with it"
