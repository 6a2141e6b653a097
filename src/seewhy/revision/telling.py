"""Proposals, and what they would change, in words."""

from __future__ import annotations

from collections.abc import Sequence

from seewhy.domain.domain import Domain
from seewhy.domain.wording import join_words, sentence
from seewhy.knowledge.reasoner import Decision, Verdict
from seewhy.revision.consequences import ChangedScene, Consequences, Standing
from seewhy.revision.proposal import Cause, Proposal

__all__ = ["say_consequences", "say_decision", "say_offer", "say_proposal"]

_NAMED = 3
"""So many pictures are named; of more, the number is said."""

_MOVES = (
    (Standing.RIGHT, Standing.WRONG),
    (Standing.RIGHT, Standing.OPEN),
    (Standing.WRONG, Standing.RIGHT),
    (Standing.WRONG, Standing.OPEN),
    (Standing.WRONG, Standing.WRONG),
    (Standing.OPEN, Standing.RIGHT),
    (Standing.OPEN, Standing.WRONG),
)

_UNDECIDED = {
    Verdict.SILENT: "no rule would say of which class {it} is",
    Verdict.SEVERAL: "the rules would give {it} several classes",
    Verdict.CONTRADICTION: "the rules would contradict each other about {it}",
    Verdict.NO_ANSWER_SET: "the rules would leave no answer about {it}",
}


def say_proposal(domain: Domain, proposal: Proposal) -> str:
    """Return what is proposed, of which class the scene would be, and what else would change.

    Examples
    --------
    >>> from seewhy.domain.domain import load_domain
    >>> rule = Proposal(Cause.MISSING, "if it leans, then it is unstable", (),
    ...                 Decision("unstable", Verdict.BELIEVED), label="unstable")
    >>> print(say_proposal(load_domain("structure_stability"), rule))
    A new rule: "if it leans, then it is unstable". By the rules, the structure would be unstable. \
There are no annotated pictures at hand, so that I cannot say which others would change.
    """
    if proposal.cause is Cause.MISREAD:
        feature, _ = proposal.reading or ("", "")
        parts = [f"I misread the {domain.features[feature].name}: {proposal.sentence}"]
    elif proposal.cause is Cause.MISSING:
        parts = [f'A new rule: "{proposal.sentence}"']
        parts += [f'To give way to it, a rule would read: "{each}"' for each in proposal.exceptions]
    else:
        kind = "An exception" if proposal.cause is Cause.EXCEPTION else "One more condition"
        parts = [f'{kind}; the rule would read: "{proposal.sentence}"']
    if proposal.cause is not Cause.MISREAD:
        parts.append(say_decision(domain, proposal.decision))
        parts.append(say_consequences(proposal.consequences))
    return " ".join(map(sentence, parts))


def say_offer(told: Sequence[str], *said: str) -> str:
    """Return proposals in words with the question which one to take; ``said`` stands before.

    Examples
    --------
    >>> print(say_offer(["A new rule."]))
    A new rule.
    Shall I take it? Say yes or no.
    """
    if len(told) == 1:
        return "\n".join([*said, told[0], "Shall I take it? Say yes or no."])
    numbered = [f"{number}. {each}" for number, each in enumerate(told, start=1)]
    which = f"Which one shall I take? Say 1 to {len(told)}, or no."
    return "\n".join([*said, *numbered, which])


def say_decision(domain: Domain, decision: Decision) -> str:
    """Return of which class a scene would be by the rules, or why of none.

    Examples
    --------
    >>> from seewhy.domain.domain import load_domain
    >>> say_decision(load_domain("structure_stability"), Decision(None, Verdict.SILENT))
    'no rule would say of which class the structure is'
    """
    if decision.label is not None:
        return f"by the rules, {domain.subject} would be {domain.classes[decision.label].say}"
    return _UNDECIDED[decision.verdict].replace("{it}", domain.subject)


def say_consequences(found: Consequences | None) -> str:
    """Return which annotated pictures would change, and how.

    Examples
    --------
    >>> changed = ChangedScene("a.png", "stable", "unstable", "stable")
    >>> say_consequences(Consequences(40, (changed,)))
    'of 40 annotated pictures, 1 that is wrong now would be right (a.png); all others stay'
    """
    if found is None:
        return (
            "there are no annotated pictures at hand, so that I cannot say which others would "
            "change"
        )
    many = f"{found.scenes} annotated picture{'' if found.scenes == 1 else 's'}"
    parts = [
        _moved(scenes, was, becomes)
        for was, becomes in _MOVES
        if (scenes := found.moved(was, becomes))
    ]
    if found.contradictions:
        parts.append(f"the rules would contradict each other on {_named(found.contradictions)}")
    if not parts:
        return f"none of {many} would change" if found.scenes > 1 else f"the {many} stays"
    rest = "all others stay" if len(found.changed) < found.scenes else "no other is left"
    return f"of {many}, {'; '.join(parts)}; {rest}"


def _moved(scenes: Sequence[ChangedScene], was: Standing, becomes: Standing) -> str:
    one = len(scenes) == 1
    now = "is left open" if was is Standing.OPEN else f"is {was.value}"
    now = now if one else now.replace("is ", "are ", 1)
    then = "be otherwise wrong" if was is becomes else f"be {becomes.value}"
    return f"{len(scenes)} that {now} now would {then}{_parenthesis(scenes)}"


def _parenthesis(scenes: Sequence[ChangedScene]) -> str:
    names = [scene.picture for scene in scenes if scene.picture]
    if not names:
        return ""
    more = ["…"] if len(names) > _NAMED else []
    return f" ({', '.join(names[:_NAMED] + more)})"


def _named(scenes: Sequence[ChangedScene]) -> str:
    names = [scene.picture for scene in scenes if scene.picture]
    if 0 < len(names) == len(scenes) <= _NAMED:
        return join_words(names)
    return f"{len(scenes)} of them"
