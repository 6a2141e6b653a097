"""Look for conditions that tell one class from others: from short patterns to longer ones."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import combinations

import numpy as np
from numpy.typing import NDArray

from seewhy.induction.things.conditions import (
    MOST_THINGS,
    Alike,
    Alone,
    Atom,
    Condition,
    Grouped,
    HasValue,
    Pattern,
    Related,
    There,
    Whole,
)
from seewhy.induction.things.coverage import counted, matches, where
from seewhy.induction.things.thing_table import Bits, ThingTable, count_bits, either

__all__ = ["Contrast", "Found", "PatternSearch"]

_MOST_COUNTED = 5
_GROUPED = 3
_TRIED = 5
"""So many times more patterns of each length are kept as conditions than are made longer."""
_SAME = 2
"""Of patterns that are in the same scenes, so many are made longer: they may go on otherwise."""


@dataclass(frozen=True, eq=False)
class Contrast:
    """The scenes that are to be told apart: those of a class, and others."""

    positive: Bits
    negative: Bits

    def bits_told(self, covered: Bits) -> NDArray[np.float64]:
        """Return how many bits of the classes sets of scenes tell, (…) of (…, words).

        The information that being in the set gives about the class, of all scenes together.
        """
        right, wrong = count_bits(covered & self.positive), count_bits(covered & self.negative)
        positives, negatives = count_bits(self.positive), count_bits(self.negative)
        inside, outside = right + wrong, positives + negatives - right - wrong
        within = _disorder(right, inside) + _disorder(positives - right, outside)
        told: NDArray[np.float64] = _disorder(positives, positives + negatives) - within
        return told


def _disorder(some: NDArray[np.int64], of: NDArray[np.int64]) -> NDArray[np.float64]:
    """The bits that say of so many scenes which are of the class, if so many are."""
    total = np.maximum(of, 1)
    shares = [some / total, (of - some) / total]
    entropy: NDArray[np.float64] = -sum(
        (share * np.log2(np.where(share > 0, share, 1.0)) for share in shares),
        start=np.zeros(np.shape(some)),
    )
    return of * entropy


@dataclass(frozen=True, eq=False)
class Found:
    """A condition, and the scenes in which it holds."""

    condition: Condition
    covered: Bits


@dataclass(frozen=True, eq=False)
class _Grown:
    """A pattern, and where it is: a combination of things of a scene."""

    pattern: Pattern
    matches: Bits


@dataclass(frozen=True)
class PatternSearch:
    """Looks for conditions in a table; ``width`` patterns of each length are made longer.

    Attributes
    ----------
    table : ThingTable
    width : int
    longest : int
        The most atoms of a pattern.
    kept : int
        So many conditions are returned.
    """

    table: ThingTable
    width: int = 24
    longest: int = 5
    kept: int = 120

    def conditions(self, contrast: Contrast) -> list[Found]:
        """Return the conditions that tell most of the classes, the best first.

        Of those that hold in the same scenes, the shortest is returned. A condition, and that it
        does not hold, tell the same: only what there is, is returned.
        """
        # What tells a class from another tells that from it, too.
        asked = frozenset((contrast.positive.tobytes(), contrast.negative.tobytes()))
        if asked not in self._known:
            self._known[asked] = self._looked_for(contrast)
        return self._known[asked]

    @cached_property
    def _known(self) -> dict[frozenset[bytes], list[Found]]:
        return {}

    def _looked_for(self, contrast: Contrast) -> list[Found]:
        pool = _Pool(contrast)
        for feature, by_value in self.table.whole.items():
            for value in by_value:
                condition = Whole(feature, value)
                pool.add(condition, where(self.table, condition))
        beam = [_Grown(Pattern(1, ()), self.table.combinations(1))]
        for length in range(self.longest + 1):
            for grown in beam:
                self._count(grown, pool)
            if length == self.longest:
                break
            beam = self._longer(beam, pool)
        return pool.best(self.kept)

    def _count(self, grown: _Grown, pool: _Pool) -> None:
        """What there is at least so often."""
        if grown.pattern.things > 1:
            return
        for least in range(1, min(_MOST_COUNTED, self.table.things) + 1):
            covered = counted(self.table, grown.matches, least)
            pool.add(There(grown.pattern, least), covered)

    def _longer(self, beam: list[_Grown], pool: _Pool) -> list[_Grown]:
        """The best patterns of one atom more."""
        blocks = [block for grown in beam for block in self._refined(grown)]
        if not blocks:
            return []
        covers = np.concatenate([block.covered for block in blocks])
        begins = np.cumsum([0, *(len(block.covered) for block in blocks)])
        told = pool.contrast.bits_told(covers)
        chosen: dict[Pattern, Bits] = {}
        # Of equal ones the first in the order of the table's features goes before.
        for place in np.argsort(-told, kind="stable").tolist():
            number = int(np.searchsorted(begins, place, side="right")) - 1
            pattern = blocks[number].pattern(place - int(begins[number]))
            if pattern is not None and pattern not in chosen:
                chosen[pattern] = covers[place]
                pool.add(There(pattern), covers[place])
            if len(chosen) == _TRIED * self.width:
                break
        return [
            _Grown(pattern, matches(self.table, pattern)) for pattern in self._different(chosen)
        ]

    def _different(self, patterns: Mapping[Pattern, Bits]) -> Iterator[Pattern]:
        """So many patterns as are made longer; of those in the same scenes at most two."""
        same: Counter[bytes] = Counter()
        taken = 0
        for pattern, covered in patterns.items():
            same[covered.tobytes()] += 1
            if same[covered.tobytes()] <= _SAME and taken < self.width:
                taken += 1
                yield pattern

    def _refined(self, grown: _Grown) -> Iterator[_Block]:
        """Atoms that a pattern may ask, too, and the scenes that are then left."""
        things = grown.pattern.things
        for thing in range(things):
            yield _block(grown, self._of_one, (thing,), _projected(grown.matches, (thing,)))
        for pair in combinations(range(things), 2):
            yield _block(grown, self._of_two, pair, _projected(grown.matches, pair))
        if things < MOST_THINGS:
            for thing in range(things):
                found = self._with_another(grown, thing)
                yield _block(grown, self._of_two, (thing, things), found)
        if self.table.groups:
            found = grown.matches
            for _ in range(_GROUPED - things):
                found = found[..., None, :]
            found = found & self.table.combinations(_GROUPED)
            yield _block(grown, self._of_three, (0, 1, 2), found)

    def _with_another(self, grown: _Grown, thing: int) -> Bits:
        """A thing of a pattern, and another that is none of the pattern's."""
        found = self.table.combinations(grown.pattern.things + 1)
        found = found & grown.matches[..., None, :]
        return _projected(found, (thing, grown.pattern.things))

    @cached_property
    def _of_one(self) -> _Atoms:
        atoms: list[Atom] = []
        for key, values in self.table.features.items():
            atoms += [HasValue(0, key, value) for value in values]
            # Of two values, not to have one is to have the other.
            atoms += [HasValue(0, key, value, False) for value in values if len(values) > 2]
        for relation in self.table.relations:
            atoms += [Alone(0, relation), Alone(0, relation, inverse=True)]
        return self._holding(atoms, (0,))

    @cached_property
    def _of_two(self) -> _Atoms:
        atoms: list[Atom] = []
        for relation in self.table.relations:
            atoms += [Related(0, 1, relation), Related(1, 0, relation)]
        for key in self.table.compared:
            atoms += [Alike(0, 1, key), Alike(0, 1, key, holds=False)]
        return self._holding(atoms, (0, 1))

    @cached_property
    def _of_three(self) -> _Atoms:
        return self._holding([Grouped((0, 1, 2), group) for group in self.table.groups], (0, 1, 2))

    def _holding(self, atoms: list[Atom], things: tuple[int, ...]) -> _Atoms:
        holding = [
            self.table.holding(atom).transpose(*np.argsort(atom.things), len(things))
            for atom in atoms
        ]
        shape = (0, *(self.table.things for _ in things), self.table.present.shape[-1])
        return atoms, np.array(holding) if holding else np.zeros(shape, dtype=np.uint64)


_Atoms = tuple[list[Atom], Bits]
"""Atoms of the things 0, 1, …, and of which things each holds, (atoms, things, …, words)."""


@dataclass(frozen=True, eq=False)
class _Block:
    """A pattern, atoms about some of its things, and where each holds with it, (atoms, words)."""

    grown: _Grown
    atoms: list[Atom]
    places: tuple[int, ...]
    covered: Bits

    def pattern(self, number: int) -> Pattern | None:
        """The pattern with one of the atoms; None where that says nothing, or nothing can be so."""
        known = self.grown.pattern
        atom = self.atoms[number].renamed(dict(enumerate(self.places)))
        if atom in known.atoms or _settled(atom, known.atoms):
            return None
        things = max(known.things, *(place + 1 for place in self.places))
        return Pattern.of(things, [*known.atoms, atom])


def _block(grown: _Grown, kinds: _Atoms, places: tuple[int, ...], found: Bits) -> _Block:
    """Where atoms hold of some of a pattern's things, which are in the combinations found."""
    atoms, holding = kinds
    things = tuple(range(1, holding.ndim - 1))
    return _Block(grown, atoms, places, either(holding & found, axis=things))


def _projected(found: Bits, things: tuple[int, ...]) -> Bits:
    """Of which of some things a combination is left, in their order."""
    others = tuple(axis for axis in range(found.ndim - 1) if axis not in things)
    return either(found, axis=others) if others else found


def _settled(atom: Atom, known: Sequence[Atom]) -> bool:
    """Whether a pattern's atoms say already that an atom holds, or that it does not."""
    if isinstance(atom, HasValue):
        return any(
            isinstance(other, HasValue)
            and (other.thing, other.feature) == (atom.thing, atom.feature)
            and (other.holds or other.value == atom.value)
            for other in known
        )
    if isinstance(atom, Alike):
        return any(
            isinstance(other, Alike)
            and (other.things, other.feature) == (atom.things, atom.feature)
            for other in known
        )
    return False


class _Pool:
    """Conditions that were met with, the shortest of those that hold in the same scenes."""

    def __init__(self, contrast: Contrast) -> None:
        self.contrast = contrast
        self._found: dict[bytes, Found] = {}

    def add(self, condition: Condition, covered: Bits) -> None:
        key = covered.tobytes()
        known = self._found.get(key)
        if known is None or condition.literals < known.condition.literals:
            self._found[key] = Found(condition, covered)

    def best(self, count: int) -> list[Found]:
        found = list(self._found.values())
        told = self.contrast.bits_told(np.array([condition.covered for condition in found]))
        order = np.argsort(-told, kind="stable")[:count].tolist()
        return [found[place] for place in order if told[place] > 0]
