"""In which scenes a condition, or a rule, holds."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from seewhy.induction.things.conditions import Atom, Condition, Pattern, There, ThingRule
from seewhy.induction.things.thing_table import Bits, ThingTable, as_bits, either

__all__ = ["counted", "joined", "matches", "spoken", "where"]


def joined(found: Bits, atom: Atom, holding: Bits) -> Bits:
    """Return those of some combinations of things, (things, …, words), of which an atom holds."""
    count = found.ndim - 1
    order = np.argsort(atom.things)
    axes = [atom.things[place] for place in order]
    placed = holding.transpose(*order, len(order))
    shape = [found.shape[axis] if axis in axes else 1 for axis in range(count)]
    return found & placed.reshape(*shape, found.shape[-1])


def matches(table: ThingTable, pattern: Pattern) -> Bits:
    """Return which things make up a pattern, (things, …, words)."""
    found = table.combinations(pattern.things)
    for atom in pattern.atoms:
        found = joined(found, atom, table.holding(atom))
    return found


def counted(table: ThingTable, of_one: Bits, least: int) -> Bits:
    """Return the scenes with at least so many of some things, given as (things, words)."""
    by_scene = np.unpackbits(of_one.astype("<u8").view(np.uint8), axis=-1, bitorder="little")
    numbers = by_scene[:, : table.scenes].sum(axis=0)
    return as_bits(numbers >= least)


def where(table: ThingTable, condition: Condition) -> Bits:
    """Return the scenes in which a condition holds.

    Examples
    --------
    >>> from seewhy.domain.domain import load_domain
    >>> from seewhy.induction.things.conditions import HasValue
    >>> from seewhy.induction.things.thing_table import thing_table
    >>> domain = load_domain("tabletop").with_most_things(2)
    >>> shown = {"thing(thing1)": "yes", "colour(thing1)": "red"}
    >>> scenes = [domain.vector(shown), domain.vector({})]
    >>> table = thing_table(domain.things, domain.schema, scenes)
    >>> red = There(Pattern.of(1, [HasValue(0, "colour", "red")]))
    >>> where(table, red).tolist(), where(table, red.denied).tolist()
    ([1], [2])
    """
    if isinstance(condition, There):
        found = matches(table, condition.pattern)
        if condition.least > 1:
            holds = counted(table, found, condition.least)
        else:
            holds = either(found.reshape(-1, found.shape[-1]))
        return holds if condition.holds else table.all_scenes & ~holds
    by_value = table.whole[condition.feature]
    if condition.holds:
        return by_value[condition.value]
    others = [bits for value, bits in by_value.items() if value != condition.value]
    return either([np.zeros_like(table.all_scenes), *others])


def spoken(table: ThingTable, rules: Sequence[ThingRule]) -> list[Bits]:
    """Return the scenes that each rule speaks about, where they are all that is known."""
    alone = []
    for rule in rules:
        holds = table.all_scenes
        for condition in rule.conditions:
            holds = holds & where(table, condition)
        alone.append(holds)
    found = []
    for rule, holds in zip(rules, alone, strict=True):
        for other, others in zip(rules, alone, strict=True):
            if other.label in rule.unless and not other.unless:
                holds = holds & ~others
        found.append(holds)
    return found
