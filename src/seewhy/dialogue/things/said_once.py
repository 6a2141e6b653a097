"""What holds of things in every order, to be said once."""

from __future__ import annotations

from collections.abc import Iterable
from itertools import permutations

from seewhy.knowledge.things import things_of

__all__ = ["said_once"]


def said_once(literals: Iterable[str]) -> list[str]:
    """Leave out literals that say of the same things what another one has said.

    Which they are is read off: a predicate that holds of some things in all of their orders does
    not tell these apart. Of such literals the first one stays.

    Examples
    --------
    >>> said_once(["near(a,b)", "near(b,a)", "on(a,b)", "near(b,c)"])
    ['near(a,b)', 'on(a,b)', 'near(b,c)']
    """
    literals = list(literals)
    parted = [(predicate, tuple(map(str.strip, of))) for predicate, of in map(things_of, literals)]
    known = set(parted)
    said: set[tuple[str, frozenset[str]]] = set()
    found = []
    for literal, (predicate, arguments) in zip(literals, parted, strict=True):
        if (predicate, frozenset(arguments)) in said:
            continue
        if len(arguments) == len(set(arguments)) > 1 and all(
            (predicate, order) in known for order in permutations(arguments)
        ):
            said.add((predicate, frozenset(arguments)))
        found.append(literal)
    return found
