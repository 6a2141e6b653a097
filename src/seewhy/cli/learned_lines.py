"""What was learned from pictures, in lines and as JSON."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from seewhy.cli.axiom_lines import axiom_dict, rests, withdrawn_dict, withdrawn_line
from seewhy.cli.screen import say
from seewhy.text.percentage import percent

if TYPE_CHECKING:
    from seewhy.evaluation.held_back import Judged, JudgedLearning, Proposal

__all__ = ["judgement_lines", "learning_dict", "print_learning"]


def judgement_lines(proposal: Proposal) -> list[str]:
    """Return what a proposal does to the accuracy on the pictures held back."""
    before, after = proposal.before, proposal.after
    if before is None or after is None:
        return []
    shares = f"{percent(before.right.value)} before, {percent(after.right.value)} with this"
    said = f"of {before.right.of} pictures held back, classified rightly: {shares}"
    if not proposal.falls:
        return [said]
    points = 100 * (before.right.value - after.right.value)
    pictures = "1 picture" if proposal.lost == 1 else f"{proposal.lost} pictures"
    return [said, f"ACCURACY WOULD FALL by {points:.1f} points ({pictures})"]


def learning_dict(found: JudgedLearning, *, only_shown: bool) -> dict[str, Any]:
    """What was learned, as values that JSON can hold.

    What is only shown is judged as if all were accepted that lowers no accuracy; nothing is.
    """
    from seewhy.induction.sentence import say_rule
    from seewhy.knowledge.learned_file import Withdrawn

    agent, learning = found.agent, found.learning
    return {
        "found": [str(axiom) for axiom in learning.found],
        "added": [axiom_dict(axiom) for axiom in learning.added if not only_shown],
        "withdrawn": [withdrawn_dict(agent, gone) for gone in learning.withdrawn if not only_shown],
        "candidates": [
            {
                "text": say_rule(
                    agent.domain, judgement.candidate.conditions, judgement.candidate.label
                ),
                "fate": judgement.fate.value,
                "reason": judgement.reason,
                "right": judgement.tally.right,
                "wrong": judgement.tally.wrong,
                "left_open": judgement.tally.left,
            }
            for judgement in learning.judgements
        ],
        "held_back": found.held_back,
        "learned_from": found.learned_from,
        "judged": [
            {
                "statement": proposal.statement,
                "set_aside": isinstance(proposal.proposed, Withdrawn),
                "falls": proposal.falls,
                "accepted": accepted and not only_shown,
                "before": _shares(proposal.before),
                "after": _shares(proposal.after),
            }
            for proposal, accepted in found.judged
        ],
        "before": _shares(found.before),
        "after": _shares(found.after),
    }


_RIGHT = "annotated features classified rightly"
_BY_KNOWLEDGE = "annotated features that the knowledge decides rightly"


def _shares(judged: Judged | None) -> dict[str, float] | None:
    if judged is None:
        return None
    return {_BY_KNOWLEDGE: judged.by_knowledge.value, _RIGHT: judged.right.value}


def print_learning(found: JudgedLearning) -> None:
    """Print every candidate with its verdict, what was added and withdrawn, and what it did."""
    from seewhy.induction.axiom_learning import Fate
    from seewhy.induction.sentence import say_rule, things

    agent, learning = found.agent, found.learning
    for judgement in learning.judgements:
        text = say_rule(agent.domain, judgement.candidate.conditions, judgement.candidate.label)
        why = f": {judgement.reason}" if judgement.reason else ""
        fate = "proposed" if judgement.fate is Fate.ACCEPTED else judgement.fate.value
        say(f"{fate}: {text} ({judgement.tally.right} {things(agent.domain)} for it{why})")
    for gone in learning.withdrawn:
        say(withdrawn_line(agent, gone))
    if not learning.found:
        say("no axiom is to be learned from these pictures")
    for axiom in learning.added:
        say(f"added {axiom.identifier}: {axiom}  ({rests(axiom)})")
    for proposal, accepted in found.judged:
        if proposal.falls:
            say(f"{'agreed to all the same' if accepted else 'left out'}: {proposal.statement}")
            for line in judgement_lines(proposal):
                say(f"  {line}")
    before, after = _shares(found.before), _shares(found.after)
    for name in before or {}:
        if before is not None and after is not None:
            say(
                f"{name}, of {found.held_back} held back: {percent(before[name])} before, "
                f"{percent(after[name])} now"
            )
