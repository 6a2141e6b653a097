"""One preferred answer set of a scene, read off the atoms that are true in it."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass
from functools import lru_cache

import clingo

from seewhy.knowledge.ground import text_of

__all__ = ["AnswerSet", "answer_set_of"]

_PLAIN_INSTANCE = re.compile(r"(fires|exception)\((\w+),\(([-\w]+(?:,[-\w]+)*,?)\)\)")
"""An axiom with values that are names or numbers, with a comma behind one alone."""


@dataclass(frozen=True)
class AnswerSet:
    """One preferred answer set, or the conflicting beliefs where there is none.

    Attributes
    ----------
    holds : frozenset of clingo.Symbol
        The literals believed; a negative symbol is believed false.
    firings : mapping of str to list
        Axiom identifier → the values of its variables, for every instance that fires.
    exceptions : tuple
        (axiom identifier, values) of the defaults that were given up for consistency.
    conflict : bool
        True if the answer set holds contradictory literals (there is no consistent one).
    """

    holds: frozenset[clingo.Symbol]
    firings: dict[str, list[tuple[str, ...]]]
    exceptions: tuple[tuple[str, tuple[str, ...]], ...]
    conflict: bool


@lru_cache(maxsize=65_536)
def _read_atom(
    atom: clingo.Symbol,
) -> tuple[str, clingo.Symbol | None, tuple[str, tuple[str, ...]] | None]:
    """The predicate of an atom, the literal that it says is believed, the instance that it names.

    The same atoms come again in one answer set after another.
    """
    # As text it is one call of clingo, where its name and every argument would be two or three.
    text = str(atom)
    if text.startswith("holds("):
        arguments = atom.arguments
        return "holds", arguments[0] if len(arguments) == 1 else None, None
    plain = _PLAIN_INSTANCE.fullmatch(text)
    if plain is not None:
        kind, identifier, values = plain.groups()
        return kind, None, (identifier, tuple(values.removesuffix(",").split(",")))
    name = atom.name
    if name in ("fires", "exception"):
        axiom, terms = atom.arguments
        return name, None, (axiom.name, tuple(map(text_of, terms.arguments)))
    return name, None, None


def answer_set_of(symbols: Iterable[clingo.Symbol]) -> AnswerSet:
    """Return the answer set of the atoms that are true."""
    holds: set[clingo.Symbol] = set()
    firings: dict[str, list[tuple[str, ...]]] = {}
    exceptions: list[tuple[str, tuple[str, ...]]] = []
    conflict = False
    for kind, literal, instance in map(_read_atom, symbols):
        if literal is not None:
            holds.add(literal)
        elif instance is None:
            conflict = conflict or kind == "conflict"
        elif kind == "fires":
            firings.setdefault(instance[0], []).append(instance[1])
        else:
            exceptions.append(instance)
    for instances in firings.values():
        instances.sort()
    return AnswerSet(frozenset(holds), firings, tuple(sorted(exceptions)), conflict)
