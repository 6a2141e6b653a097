"""Instances of an axiom that say the same, with things exchanged."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable
from itertools import permutations

from seewhy.knowledge.axiom import Condition, Literal, substitute
from seewhy.knowledge.ground import key_of
from seewhy.knowledge.possible import Instance

__all__ = ["without_exchanged"]

_EITHER_WAY = re.compile(r"\s*([^\s{}()!=<>]+)\s*(!=|=)\s*([^\s{}()!=<>]+)\s*")
"""A comparison that is the same the other way round."""


def without_exchanged(instances: Iterable[Instance], holds: Collection[str]) -> list[Instance]:
    """Leave out instances of an axiom that rest on what another one rests on.

    "There are two red things" is so of the first and the second, and of the second and the first.
    What holds of things in all of their orders, as that they touch, does not tell these apart.

    Parameters
    ----------
    instances : iterable of Instance
        That conclude the same.
    holds : collection of str
        The literals that are believed, as clingo prints them.

    Examples
    --------
    >>> from seewhy.knowledge.language import read_knowledge
    >>> known = read_knowledge("#sort s. #sort t = {a, b}. #static red(t). #static two(s). "
    ...                        "two(S) if s(S), red(X), red(Y), X != Y.")
    >>> axiom, = known.axioms
    >>> pairs = [Instance(axiom, ("s", *pair)) for pair in (("a", "b"), ("b", "a"))]
    >>> [instance.binding["X"] for instance in without_exchanged(pairs, {"red(a)", "red(b)"})]
    ['a']
    """
    found: dict[tuple[str, frozenset[object]], Instance] = {}
    for instance in instances:
        rests_on = frozenset(
            _rested_on(condition, instance, holds) for condition in instance.axiom.body
        )
        found.setdefault((instance.axiom.identifier, rests_on), instance)
    return list(found.values())


def _rested_on(condition: Condition, instance: Instance, holds: Collection[str]) -> object:
    if condition.literal is not None:
        literal = condition.literal.substitute(instance.binding)
        return condition.absent, _apart_from_order(literal, holds)
    text = substitute(condition.text, instance.binding)
    compared = _EITHER_WAY.fullmatch(text)
    if compared is None:
        return text
    return compared[2], frozenset((compared[1], compared[3]))


def _apart_from_order(literal: Literal, holds: Collection[str]) -> object:
    """A literal, without the order of its arguments where it holds in all of them."""
    arguments = literal.arguments
    if len(set(arguments)) == len(arguments) > 1 and all(
        key_of(Literal(literal.predicate, order, literal.positive)) in holds
        for order in permutations(arguments)
    ):
        return literal.predicate, literal.positive, frozenset(arguments)
    return str(literal)
