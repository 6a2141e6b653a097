"""What is believed about the fluents at one step: true, false, or unknown."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import clingo


@dataclass(frozen=True)
class State:
    """Beliefs about every fluent at one step.

    Attributes
    ----------
    holds : frozenset of clingo.Symbol
        The literals believed; a negative symbol is believed false.
    unknown : frozenset of clingo.Symbol
        The fluents of which neither is believed.

    Examples
    --------
    >>> state = State(frozenset(map(clingo.parse_term, ("at(hall)", "-at(attic)", "lit"))))
    >>> [[str(fluent) for fluent in found] for found in (state.positive(), state.positive("at"))]
    [['lit', 'at(hall)'], ['at(hall)']]
    """

    holds: frozenset[clingo.Symbol]
    unknown: frozenset[clingo.Symbol] = frozenset()

    def positive(self, predicate: str | None = None) -> list[clingo.Symbol]:
        """The literals believed that are not denials, of one predicate or all, sorted."""
        return sorted(
            literal
            for literal in self.holds
            if literal.positive and predicate in (None, literal.name)
        )


def facts(predicate: str, symbols: Iterable[clingo.Symbol]) -> str:
    """Return facts of a predicate, one for each symbol, sorted."""
    return " ".join(f"{predicate}({symbol})." for symbol in sorted(map(str, symbols)))
