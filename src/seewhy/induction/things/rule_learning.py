"""Learn rules about things from scenes of several classes: few, short, supported, no accident."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from math import ceil

import numpy as np

from seewhy.induction.axiom_learning import BY_CHANCE, Fate
from seewhy.induction.binomial import at_least
from seewhy.induction.candidate import Tally
from seewhy.induction.things.conditions import ThingRule
from seewhy.induction.things.coverage import spoken
from seewhy.induction.things.description_length import RuleBits
from seewhy.induction.things.pattern_search import Contrast, PatternSearch
from seewhy.induction.things.rule_search import Theory, best_theory
from seewhy.induction.things.thing_table import Bits, ThingTable, as_bits, count_bits

__all__ = ["JudgedRule", "ThingLearningOptions", "classified", "learn_thing_rules"]


@dataclass(frozen=True)
class ThingLearningOptions:
    """How much evidence a rule about things needs.

    Attributes
    ----------
    support : float, default 0.1
        The least share, of the scenes that are left open, that a rule must be right about; or
        twice that share of those of its class, where that is less.
    tolerance : float or None, default None
        The share of the annotation that is taken to be wrong. None leaves it to the scenes: what
        is otherwise costs as many bits as it takes to name it.
    seed : int, default 0
    """

    support: float = 0.1
    tolerance: float | None = None
    seed: int = 0


_DEFAULTS = ThingLearningOptions()


@dataclass(frozen=True)
class JudgedRule:
    """A rule, how the scenes bear it out, what became of it, and why."""

    rule: ThingRule
    tally: Tally
    fate: Fate
    reason: str = ""


def learn_thing_rules(
    table: ThingTable,
    labels: Sequence[str],
    *,
    classes: Sequence[str],
    left: Sequence[bool] | None = None,
    options: ThingLearningOptions = _DEFAULTS,
) -> tuple[JudgedRule, ...]:
    """Return the rules that tell the classes of scenes apart, those that are accepted first.

    Each class gets the rules that take the fewest bits. Then the class that takes most of them is
    left without: it is what nothing says otherwise of, if every other class has rules.

    Parameters
    ----------
    table : ThingTable
    labels : sequence of str
        The class of each scene.
    classes : sequence of str
        In the domain's order.
    left : sequence of bool, optional
        Whether each scene is left open, or wrong, by what is known; all are, where it is left out.
    options : ThingLearningOptions

    Examples
    --------
    >>> from seewhy.domain.domain import load_domain
    >>> from seewhy.induction.things.thing_table import thing_table
    >>> domain = load_domain("tabletop").with_most_things(2)
    >>> scenes = [domain.vector({"thing(thing1)": "yes", "colour(thing1)": colour})
    ...           for colour in ["red", "blue"] * 20]
    >>> table = thing_table(domain.things, domain.schema, scenes)
    >>> for judged in learn_thing_rules(table, ["yes", "no"] * 20, classes=["yes", "no"]):
    ...     print(judged.rule.label, judged.tally.right, judged.fate.value, judged.rule.unless)
    yes 20 accepted ()
    no 20 accepted ('yes',)
    """
    judge = _Judge(table, labels, classes, left, options)
    theories = judge.theories()
    if not theories:
        return ()
    # Of classes that take as many, the first is described.
    rest = max(reversed(theories), key=lambda label: theories[label].bits)
    judged = [
        judge.judged(rule)
        for label, theory in theories.items()
        if label != rest
        for rule in theory.rules
    ]
    accepted = [judgement.rule for judgement in judged if judgement.fate is Fate.ACCEPTED]
    if all(any(rule.label == label for rule in accepted) for label in theories if label != rest):
        unless = tuple(label for label in classes if label != rest)
        judged.append(judge.judged(ThingRule(rest, (), unless), beside=accepted))
    judged.sort(key=lambda judgement: judgement.fate is not Fate.ACCEPTED)
    return tuple(judged)


def classified(table: ThingTable, rules: Sequence[ThingRule]) -> list[str | None]:
    """Return the class of each scene by rules alone; None where none speaks, or several disagree.

    Examples
    --------
    >>> from seewhy.domain.domain import load_domain
    >>> from seewhy.induction.things.thing_table import thing_table
    >>> domain = load_domain("tabletop").with_most_things(1)
    >>> table = thing_table(domain.things, domain.schema, [domain.vector({})])
    >>> classified(table, [ThingRule("empty", ())])
    ['empty']
    """
    found: list[set[str]] = [set() for _ in range(table.scenes)]
    for rule, covered in zip(rules, spoken(table, rules), strict=True):
        for scene in np.flatnonzero(_scenes(covered, table.scenes)).tolist():
            found[scene].add(rule.label)
    return [next(iter(said)) if len(said) == 1 else None for said in found]


def _scenes(bits: Bits, count: int) -> np.ndarray[tuple[int], np.dtype[np.uint8]]:
    whole = np.unpackbits(bits.astype("<u8").view(np.uint8), bitorder="little")
    return whole[:count]


class _Judge:
    """Judges rules by the scenes."""

    def __init__(
        self,
        table: ThingTable,
        labels: Sequence[str],
        classes: Sequence[str],
        left: Sequence[bool] | None,
        options: ThingLearningOptions,
    ) -> None:
        self.table, self.options = table, options
        open_ = np.ones(table.scenes, dtype=bool) if left is None else np.array(left, dtype=bool)
        of = {label: np.array([found == label for found in labels]) for label in classes}
        self.of: Mapping[str, Bits] = {label: as_bits(holds) for label, holds in of.items()}
        self.left = {label: as_bits(holds & open_) for label, holds in of.items()}
        self.words = RuleBits.of(table)

    def theories(self) -> dict[str, Theory]:
        """The rules of each class of which scenes are left; nothing where there is one class."""
        some = [label for label, bits in self.of.items() if count_bits(bits)]
        if len(some) < 2:
            return {}
        search = PatternSearch(self.table)
        return {
            label: best_theory(
                self.table,
                label,
                Contrast(self.left[label], self.table.all_scenes & ~self.of[label]),
                search=search,
                strict=self.options.tolerance == 0.0,
            )
            for label in some
            if count_bits(self.left[label])
        }

    def judged(self, rule: ThingRule, beside: Sequence[ThingRule] = ()) -> JudgedRule:
        """A rule with what speaks for it, and whether that is enough."""
        covered = spoken(self.table, [*beside, rule])[-1]
        right = int(count_bits(covered & self.of[rule.label]))
        wrong = int(count_bits(covered)) - right
        left = int(count_bits(covered & self.left[rule.label]))
        judged = JudgedRule(rule, Tally(right, wrong, left), Fate.ACCEPTED)
        of_class = int(count_bits(self.left[rule.label]))
        total = sum(int(count_bits(bits)) for bits in self.left.values())
        needed = ceil(self.options.support * min(total, 2 * of_class))
        tolerance = self.options.tolerance
        if left < needed:
            reason = f"{left} scenes that are left open bear it out, {needed} are needed"
            return replace(judged, fate=Fate.DROPPED, reason=reason)
        if (
            tolerance is not None
            and wrong
            and at_least(wrong, right + wrong, tolerance) < BY_CHANCE
        ):
            reason = f"{wrong} scenes speak against it"
            return replace(judged, fate=Fate.REJECTED, reason=reason)
        if self._chance(rule, right, wrong) > BY_CHANCE:
            reason = "so few scenes could be alike by chance"
            return replace(judged, fate=Fate.DROPPED, reason=reason)
        return judged

    def _chance(self, rule: ThingRule, right: int, wrong: int) -> float:
        """How likely some rule of so many bits would fit so well if things said nothing.

        So many scenes spoken about, drawn from all of them, would have as many of the class
        (Fisher's exact test), times the rules of so many bits (Bonferroni).
        """
        from scipy.stats import hypergeom  # slow to import, and answering needs none of it

        of_class = int(count_bits(self.of[rule.label]))
        alone = float(hypergeom.sf(right - 1, self.table.scenes, of_class, right + wrong))
        tried = 2.0 ** self.words.rule(rule) if rule.conditions else 1.0
        return min(1.0, alone * tried)
