"""Choose few short rules for a class: conjunctions of conditions, and a cover of the scenes."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from seewhy.induction.things.conditions import Condition, There, ThingRule, is_expressible
from seewhy.induction.things.coverage import spoken
from seewhy.induction.things.description_length import RuleBits, exception_bits
from seewhy.induction.things.pattern_search import Contrast, Found, PatternSearch
from seewhy.induction.things.thing_table import Bits, ThingTable, count_bits, either

__all__ = ["Theory", "best_theory"]

_MOST_CONDITIONS = 3
_MOST_RULES = 4
_KEPT = 120
"""So many conjunctions are kept, of which the rules of a class are chosen."""

_NEVER = 1e9
"""The bits of what is not to be."""

_ROUNDS = 3
"""How often conditions are looked for: in all scenes, then where the best rules are wrong."""


@dataclass(frozen=True)
class Theory:
    """Rules of one class, and how many bits say them and the scenes that are otherwise."""

    rules: tuple[ThingRule, ...]
    bits: float


@dataclass(frozen=True, eq=False)
class _Conjunction:
    """Conditions that hold together, the scenes in which they do, and the bits that say them."""

    conditions: tuple[Condition, ...]
    covered: Bits
    bits: float


def best_theory(
    table: ThingTable,
    label: str,
    contrast: Contrast,
    *,
    search: PatternSearch | None = None,
    strict: bool = False,
) -> Theory:
    """Return the rules for a class that say most in the fewest bits; none where none is worth it.

    Parameters
    ----------
    table : ThingTable
    label : str
    contrast : Contrast
        The scenes of the class that are to be spoken about, and those of others.
    search : PatternSearch, optional
        How thoroughly conditions are looked for.
    strict : bool, default False
        Whether no scene may speak against a rule.

    Notes
    -----
    Conditions are looked for in all scenes; then, with the best rules so far, among the scenes
    that these miss (for what is another case of the class) and among those that they speak about
    (for what is an exception). All pairs of conjunctions are tried as a cover, then a further one
    is added as long as that saves bits; then what says nothing is left out.
    """
    chooser = _Chooser(table, label, contrast, strict)
    search = search or PatternSearch(table)
    pool = search.conditions(contrast)
    theory = chooser.choose(pool)
    for _ in range(_ROUNDS - 1):
        covered = either([np.zeros_like(contrast.positive), *theory.covers])
        parts = [Contrast(contrast.positive & ~covered, contrast.negative & ~covered)]
        parts += [
            Contrast(contrast.positive & cover, contrast.negative & cover)
            for cover in theory.covers
        ]
        more = [
            found
            for part in parts
            if count_bits(part.positive) and count_bits(part.negative)
            for found in search.conditions(part)
        ]
        pool = list({found.condition: found for found in (*pool, *more)}.values())
        better = chooser.choose(pool)
        if better.bits >= theory.bits:
            break
        theory = better
    return chooser.simplified(theory)


@dataclass(frozen=True, eq=False)
class _Chosen:
    conjunctions: tuple[_Conjunction, ...]
    bits: float

    @property
    def covers(self) -> list[Bits]:
        return [conjunction.covered for conjunction in self.conjunctions]


class _Chooser:
    """Chooses conjunctions, and sets of them, by the bits that they take."""

    def __init__(self, table: ThingTable, label: str, contrast: Contrast, strict: bool) -> None:
        self.table, self.label, self.contrast, self.strict = table, label, contrast, strict
        self.words = RuleBits.of(table)
        self.positives = int(count_bits(contrast.positive))
        self.negatives = int(count_bits(contrast.negative))

    def exceptions(self, covered: Bits) -> NDArray[np.float64]:
        wrong = count_bits(covered & self.contrast.negative)
        bits = exception_bits(
            count_bits(covered & self.contrast.positive),
            wrong,
            positives=self.positives,
            negatives=self.negatives,
        )
        return bits + np.where(self.strict & (wrong > 0), _NEVER, 0.0)

    def choose(self, pool: Sequence[Found]) -> _Chosen:
        nothing = _Chosen((), float(self.exceptions(np.zeros_like(self.contrast.positive))))
        conjunctions = self._conjunctions(self._signed(pool))
        if not conjunctions:
            return nothing
        covers = np.array([conjunction.covered for conjunction in conjunctions])
        costs = np.array([conjunction.bits for conjunction in conjunctions])
        alone = costs + self.exceptions(covers)
        first = int(np.argmin(alone))
        best = min(
            nothing,
            _Chosen((conjunctions[first],), float(alone[first])),
            key=lambda theory: theory.bits,
        )
        both = covers[:, None] | covers[None]
        pairs = costs[:, None] + costs[None] + self.exceptions(both)
        first_of_two, second = divmod(int(np.argmin(pairs)), len(conjunctions))
        if pairs[first_of_two, second] < best.bits:
            best = _Chosen(
                (conjunctions[first_of_two], conjunctions[second]),
                float(pairs[first_of_two, second]),
            )
        while 2 <= len(best.conjunctions) < _MOST_RULES:
            covered = either(best.covers)
            spent = sum(conjunction.bits for conjunction in best.conjunctions)
            further = spent + costs + self.exceptions(covers | covered)
            next_place = int(np.argmin(further))
            if further[next_place] >= best.bits:
                break
            best = _Chosen(
                (*best.conjunctions, conjunctions[next_place]), float(further[next_place])
            )
        return best

    def _signed(self, pool: Sequence[Found]) -> list[_Conjunction]:
        """Conditions and their opposites as conjunctions of one."""
        everything = self.table.all_scenes
        return [
            _Conjunction((condition,), covered, self._bits((condition,)))
            for found in pool
            for condition, covered in (
                (found.condition, found.covered),
                (found.condition.denied, everything & ~found.covered),
            )
            if is_expressible([condition])
        ]

    def _bits(self, conditions: tuple[Condition, ...]) -> float:
        return self.words.rule(ThingRule(self.label, conditions))

    def _conjunctions(self, single: list[_Conjunction]) -> list[_Conjunction]:
        """The best conjunctions of up to three conditions, the best first."""
        kept = self._best(single)
        longer = kept
        for _ in range(_MOST_CONDITIONS - 1):
            longer = self._best(
                [
                    joint
                    for conjunction in longer[: _KEPT // 3]
                    for joint in self._joined(conjunction, single)
                ]
            )
            kept = self._best([*kept, *longer])
        return kept

    def _joined(self, conjunction: _Conjunction, single: list[_Conjunction]) -> list[_Conjunction]:
        """A conjunction with the further conditions that go best with it."""
        covers = np.array([other.covered for other in single]) & conjunction.covered
        costs = np.array([other.bits for other in single]) + self.exceptions(covers)
        joint = []
        for place in np.argsort(costs, kind="stable")[:_MOST_CONDITIONS].tolist():
            conditions = (*conjunction.conditions, *single[place].conditions)
            if len(set(conditions)) == len(conditions) and is_expressible(conditions):
                joint.append(_Conjunction(conditions, covers[place], self._bits(conditions)))
        return joint

    def _best(self, conjunctions: list[_Conjunction]) -> list[_Conjunction]:
        """Those that save most bits; of those in the same scenes the shortest."""
        if not conjunctions:
            return []
        shortest: dict[bytes, _Conjunction] = {}
        for conjunction in conjunctions:
            key = conjunction.covered.tobytes()
            if key not in shortest or conjunction.bits < shortest[key].bits:
                shortest[key] = conjunction
        found = list(shortest.values())
        bits = self.exceptions(np.array([kept.covered for kept in found]))
        costs = bits + np.array([kept.bits for kept in found])
        return [found[place] for place in np.argsort(costs, kind="stable")[:_KEPT].tolist()]

    def simplified(self, chosen: _Chosen) -> Theory:
        """The rules without the conditions and the atoms that save no bits."""
        rules = [ThingRule(self.label, found.conditions) for found in chosen.conjunctions]
        theory = Theory(tuple(rules), chosen.bits)
        while True:
            shorter = [self._theory(rules) for rules in _shortened(theory.rules)]
            best = min(shorter, key=lambda theory: theory.bits, default=theory)
            if best.bits >= theory.bits:
                return theory
            theory = best

    def _theory(self, rules: tuple[ThingRule, ...]) -> Theory:
        covers = spoken(self.table, rules)
        covered = either([np.zeros_like(self.contrast.positive), *covers])
        spent = sum(map(self.words.rule, rules))
        return Theory(rules, spent + float(self.exceptions(covered)))


def _shortened(rules: tuple[ThingRule, ...]) -> list[tuple[ThingRule, ...]]:
    """The rules with one rule, one condition or one atom less."""
    found = []
    for place, rule in enumerate(rules):
        before, behind = rules[:place], rules[place + 1 :]
        found.append((*before, *behind))
        for conditions in _without_one(rule.conditions):
            found.append((*before, ThingRule(rule.label, conditions), *behind))
    return found


def _without_one(conditions: tuple[Condition, ...]) -> list[tuple[Condition, ...]]:
    found = []
    for place, condition in enumerate(conditions):
        before, behind = conditions[:place], conditions[place + 1 :]
        if len(conditions) > 1:
            found.append((*before, *behind))
        if isinstance(condition, There):
            for atom in condition.pattern.atoms:
                shorter = condition.pattern.without(atom)
                if shorter is not None and (condition.least == 1 or shorter.things == 1):
                    less = There(shorter, condition.least, condition.holds)
                    found.append((*before, less, *behind))
    return found
