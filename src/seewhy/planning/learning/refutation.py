"""What was learned before, judged by later runs: what they refute is withdrawn."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from seewhy.induction.binomial import at_least
from seewhy.induction.candidate import Tally
from seewhy.knowledge.axiom import Axiom, AxiomKind
from seewhy.knowledge.learned_file import Withdrawn
from seewhy.planning.learning.attempts import Attempt, spoken_about
from seewhy.planning.learning.candidates import AS_OFTEN_WRONG
from seewhy.planning.learning.validation import RecordedRun, unexplained_runs

__all__ = ["judged_again"]


def judged_again(
    learned: Sequence[Axiom], runs: Sequence[RecordedRun], attempts: Sequence[Attempt]
) -> tuple[list[Axiom], list[Withdrawn]]:
    """Return what was learned before and stays, and what runs refute.

    An executability condition is refuted by attempts of what it holds impossible: where more of
    the new ones succeed than fail, beyond chance; and where of all, the earlier ones included, it
    is no longer right more often than wrong. Of one that stays the attempts are counted to those
    that it rests on. Any axiom is refuted by a run that cannot be explained with it.
    """
    kept: list[Axiom] = []
    withdrawn: list[Withdrawn] = []
    for axiom in learned:
        found = _tally(axiom, runs, attempts)
        reason = _refuted(axiom, found)
        unexplained = next(unexplained_runs(runs, [*kept, axiom]), None)
        if reason is None and unexplained is not None:
            reason = unexplained
        if reason is not None:
            withdrawn.append(Withdrawn(str(axiom), reason))
        else:
            kept.append(_counted(axiom, found))
    return kept, withdrawn


def _tally(axiom: Axiom, runs: Sequence[RecordedRun], attempts: Sequence[Attempt]) -> Tally:
    """How attempts bear out that something is impossible: those that failed, and that succeeded."""
    if axiom.kind is not AxiomKind.EXECUTABILITY_CONDITION:
        return Tally(0, 0, 0)
    missed = [
        bool(attempt.missed)
        for attempt in attempts
        if spoken_about(runs[attempt.run][1].knowledge, [axiom], attempt)
    ]
    return Tally(sum(missed), len(missed) - sum(missed), 0)


def _refuted(axiom: Axiom, found: Tally) -> str | None:
    """Why an axiom is refuted by attempts; None where it is not."""
    new = found.right + found.wrong
    if not found.wrong:
        return None
    of_all = _counted(axiom, found).origin
    right = round(of_all.precision * of_all.support)
    now_otherwise = at_least(found.wrong, new, 0.5) <= AS_OFTEN_WRONG
    no_longer_usual = at_least(right, of_all.support, 0.5) > AS_OFTEN_WRONG
    if not (now_otherwise or no_longer_usual):
        return None
    return f"{found.wrong} of {new} attempts of it in later runs succeeded"


def _counted(axiom: Axiom, found: Tally) -> Axiom:
    """An axiom with the attempts that bear it out, or do not, among those that it rests on."""
    before, new = axiom.origin, found.right + found.wrong
    if not new:
        return axiom
    right = round(before.precision * before.support) + found.right
    support = before.support + new
    return replace(axiom, origin=replace(before, support=support, precision=right / support))
