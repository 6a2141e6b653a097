"""Whether an answer is right: by the paper's measure, and by the strict one."""

from __future__ import annotations

from seewhy.dialogue.answer import AnswerType
from seewhy.dialogue.question import Asks

__all__ = ["EXPLANATORY", "score_answer"]

EXPLANATORY = (
    Asks.WHY_CLASS, Asks.WHY_NOT_CLASS, Asks.CHANGE_TO_CLASS, Asks.DIFFERENCE_TO_CLASS
)  # fmt: skip


def score_answer(
    kind: AnswerType,
    gold: AnswerType,
    *,
    seen: dict[str, str | None],
    true: dict[str, str | None],
    right_class: bool,
) -> tuple[bool, bool]:
    """Return whether an answer is right by the paper's measure and by the strict one.

    Examples
    --------
    >>> kind = AnswerType("reasons", ("lean", "base"))
    >>> gold = AnswerType("reasons", ("lean",))
    >>> both = {"lean": "yes", "base": "wide"}
    >>> score_answer(kind, gold, seen=both, true=both, right_class=True)
    (True, False)
    """
    if kind.form != gold.form:
        return False, False
    if kind.form == "belief":
        # Two classes may have one response: what is believed counts, not from which class.
        same = set(kind.values) == set(gold.values)
        return same, same
    if kind.form in ("change", "difference"):
        proposed = [frozenset(change) for change in kind.changes]
        accepted = {frozenset(change) for change in gold.changes}
        some = any(change in accepted for change in proposed)
        return some, some and all(change in accepted for change in proposed)
    if kind.form in ("class", "no_class") and not right_class:
        return kind.form == "no_class", False
    mentioned = all(
        feature in kind.mentions and seen[feature] == true[feature] for feature in gold.mentions
    )
    return mentioned, mentioned and set(kind.mentions) == set(gold.mentions)
