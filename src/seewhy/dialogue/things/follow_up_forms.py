"""What questions about an answer come to: why, why not, what change, what if, how sure."""

from __future__ import annotations

from dataclasses import dataclass

from seewhy.dialogue.grammar import Binding
from seewhy.dialogue.things.chart import Fold
from seewhy.dialogue.things.phrases import Bindings, all_of, meanings
from seewhy.dialogue.things.query import (
    ClassIs,
    Condition,
    Description,
    HasValue,
    Query,
    Reference,
    WhichClass,
)
from seewhy.dialogue.things.question_forms import as_held, conditions_of, references_of

__all__ = ["FOLLOW_UPS", "FollowUp", "Wanted"]

Wanted = bool | int | HasValue | None
"""An answer that a question speaks of: yes or no, a number, a value."""


@dataclass(frozen=True)
class FollowUp:
    """A question about the answer before: why, why not, what change, what if, and of others.

    ``wanted`` is the other answer; ``instead`` what is to be put in the place of what the question
    before asked about. With ``query`` it names the answer itself: "why is there no red cube?".
    """

    asks: str
    wanted: Wanted = None
    instead: Description | Reference | None = None
    query: Query | None = None
    supposed: Condition | None = None
    """What is supposed of ``instead``, in "what if the ball were red?"; None: that it is gone."""


def _follow(asks: str) -> Fold:
    def fold(bindings: Bindings) -> Bindings:
        wanted = meanings(bindings, "wanted")
        other: list[Description | Reference] = [*references_of(bindings)]
        other += [
            described
            for described in meanings(bindings, "described")
            if isinstance(described, Description)
        ]
        follow_up = FollowUp(
            asks,
            wanted=wanted[-1] if wanted else None,  # type: ignore[arg-type]
            instead=other[0] if other else None,
        )
        return (Binding("follow_up", follow_up),)

    return fold


def _supposing(bindings: Bindings) -> Bindings:
    if meanings(bindings, "follow_up"):
        return bindings
    conditions = conditions_of(bindings)
    follow_up = FollowUp(
        "what_if",
        instead=references_of(bindings)[0],
        supposed=all_of(conditions) if conditions else None,
    )
    return (Binding("follow_up", follow_up),)


def _why_no_class(bindings: Bindings) -> Bindings:
    label = str(meanings(bindings, "class")[-1])
    return (Binding("follow_up", FollowUp("why", query=ClassIs(label, denied=True))),)


def _change_to(bindings: Bindings) -> Bindings | None:
    """What would make something so that the question names."""
    query = meanings(bindings, "query")
    if query:
        wanted: Query = query[0]  # type: ignore[assignment]
    else:
        held = as_held(bindings)
        if held is None:
            return None
        wanted = held[0].meaning  # type: ignore[assignment]
    return (Binding("follow_up", FollowUp("change", wanted=True, query=wanted)),)


def _supposed(bindings: Bindings) -> Bindings | None:
    """What is supposed, of which it is asked later what would be."""
    if meanings(bindings, "follow_up"):
        return bindings
    ones = references_of(bindings)
    return _supposing(bindings) if len(ones) == 1 else None


def _wanted(bindings: Bindings) -> Bindings | None:
    for role in ("wanted", "number", "condition"):
        if found := meanings(bindings, role):
            return (Binding("wanted", found[0]),)
    return None


def _so(wanted: bool) -> Fold:
    return lambda _: (Binding("wanted", wanted),)


FOLLOW_UPS: dict[str, Fold] = {
    "why_no_class": _why_no_class,
    "why_class": lambda _: (Binding("follow_up", FollowUp("why", query=WhichClass())),),
    "how_sure": _follow("how_sure"),
    "change_to": _change_to,
    "supposition": _supposed,
    "supposed_gone": _supposing,
    "contrast": _follow("contrast"),
    "why": _follow("why"),
    "why_not": _follow("why_not"),
    "change": _follow("change"),
    "instead": _follow("instead"),
    "what_if": _supposing,
    "without_it": _supposing,
    "wanted": _wanted,
    "yes": _so(True),
    "no": _so(False),
    "class_instead": lambda _: (),
    "one_instead": lambda _: (),
}
"""Question about an answer → what its bindings come to."""
