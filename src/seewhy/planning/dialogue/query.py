"""What a question about a run asks, without the wording."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum
from typing import Any

import clingo

Told = tuple[str, dict[str, Any]]
"""An answer in words, and what it rests on as values that JSON can hold."""


class Asks(StrEnum):
    """What a question about a run asks for."""

    IS = "is"
    WHERE = "where"
    CONTENTS = "contents"
    PLAN = "plan"
    DONE = "done"
    HOW_MANY_DONE = "how_many_done"
    GOAL = "goal"
    WHY_DID = "why_did"
    WHY_NOT = "why_not"
    WHY_BELIEVE = "why_believe"
    WHY_DISBELIEVE = "why_disbelieve"
    WHAT_IF = "what_if"
    WHY_CHANGED = "why_changed"
    WHICH = "which"
    DID = "did"
    ENDED = "ended"
    WHY_ENDED = "why_ended"
    EXPECTED = "expected"
    SCENE = "scene"


@dataclass(frozen=True)
class Query:
    """What a question asks, without the wording.

    Attributes
    ----------
    asks : Asks
    text : str
        The question as it was understood.
    predicate : str or None
        The static, fluent or action that it is about.
    arguments : tuple of (str or None)
        Its arguments, or the one thing that is asked for; None where the question leaves it open.
    positive : bool
    whose : int or None
        The argument that stands for the place of the thing: "Sally's location".
    step : int or None
    past : bool
        Whether it is asked what was so, of no step in particular.
    first : bool
        Whether the first of several times is meant: "why did you move the ball first?"
    foil : Query or None
        What it is contrasted with: "rather than on the table".
    """

    asks: Asks
    text: str
    predicate: str | None = None
    arguments: tuple[str | None, ...] = ()
    positive: bool = True
    whose: int | None = None
    step: int | None = None
    past: bool = False
    first: bool = False
    foil: Query | None = None

    def symbol(self) -> clingo.Symbol:
        """The literal or action that is asked about; what is left open is ``_``."""
        assert self.predicate is not None
        arguments = [clingo.parse_term(argument or '"_"') for argument in self.arguments]
        return clingo.Function(self.predicate, arguments, self.positive)

    def to_dict(self) -> dict[str, object]:
        """Return the query as values that JSON can hold."""
        return {
            "asks": self.asks.value,
            "text": self.text,
            "about": None if self.predicate is None else str(self.symbol()),
            "step": self.step,
            "past": self.past,
            "rather_than": None if self.foil is None else str(self.foil.symbol()),
        }
