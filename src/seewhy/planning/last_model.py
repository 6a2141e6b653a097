"""The last model of a solver: the best one, or what all have in common."""

from __future__ import annotations

import clingo


def last_model(control: clingo.Control) -> list[clingo.Symbol] | None:
    """Return what the last model shows; None where there is none.

    Examples
    --------
    >>> control = clingo.Control()
    >>> control.add("1 { a; b } 1. :~ a. [1]")
    >>> control.ground()
    >>> [str(own) for own in last_model(control)]
    ['b']
    """
    with control.solve(yield_=True) as solving:
        # Reading a model takes longer than finding the next.
        for _ in solving:
            pass
        last = solving.last()
        return None if last is None else list(last.symbols(shown=True))
