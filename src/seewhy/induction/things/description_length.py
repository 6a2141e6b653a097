"""How many bits say rules, and the scenes that are otherwise: what errors do not make longer.

Source: the principle of the minimum description length, as in J. R. Quinlan, "MDL and Categorical
Theories (Continued)", ICML 1995. A rule is worth its bits only where it saves more of them in the
list of exceptions; so that errors of annotation, which nothing short explains, stay exceptions.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import factorial, log2

import numpy as np
from numpy.typing import ArrayLike, NDArray

from seewhy.induction.things.conditions import Condition, There, ThingRule
from seewhy.induction.things.thing_table import ThingTable

__all__ = ["RuleBits", "exception_bits"]

_RULE = 1.0
_HOLDS, _DENIED = 1.0, 1.6
"""A rule says rather what there is than what there is not."""


def exception_bits(
    right: ArrayLike, wrong: ArrayLike, *, positives: int, negatives: int
) -> NDArray[np.float64]:
    """Return the bits that name the exceptions among scenes spoken about, and among the others.

    Parameters
    ----------
    right, wrong : array_like of int
        Scenes spoken about, of the class and of others.
    positives, negatives : int
        All scenes of the class and of others.

    Examples
    --------
    >>> exception_bits([0, 5], [0, 0], positives=5, negatives=5).round(1).tolist()
    [11.4, 5.2]
    """
    right, wrong = np.asarray(right), np.asarray(wrong)
    missed = positives - right
    return _named(wrong, right + wrong) + _named(missed, missed + negatives - wrong)


def _named(exceptions: NDArray[np.int64], among: NDArray[np.int64]) -> NDArray[np.float64]:
    """The bits that name so many exceptions among so many scenes.

    More exceptions than half of them take more bits, not fewer: they are what the rule says.
    """
    few = np.minimum(exceptions, among // 2)
    bits: NDArray[np.float64] = np.log2(among + 1.0) + _log2_choose(among, few)
    return bits + 2.0 * (exceptions - few)


def _log2_choose(total: NDArray[np.int64], chosen: NDArray[np.int64]) -> NDArray[np.float64]:
    from scipy.special import gammaln  # slow to import, and answering needs none of it

    found: NDArray[np.float64] = (
        gammaln(total + 1.0) - gammaln(chosen + 1.0) - gammaln(total - chosen + 1.0)
    ) / np.log(2.0)
    return found


@dataclass(frozen=True)
class RuleBits:
    """How many bits say a condition or a rule about the scenes of a table.

    Attributes
    ----------
    atom : float
        The bits of an atom: it is one of so many.
    most : int
        The most things of a scene.
    """

    atom: float
    most: int

    @staticmethod
    def of(table: ThingTable) -> RuleBits:
        """The bits, where rules speak of what there is in a table."""
        values = sum(len(values) for values in table.features.values())
        more_than_two = sum(len(v) for v in table.features.values() if len(v) > 2)
        alone, alike = 2 * len(table.relations), 2 * len(table.compared)
        kinds = values + more_than_two + alone + alike + alone + len(table.groups)
        return RuleBits(log2(max(2, kinds)), max(2, table.things))

    def condition(self, condition: Condition) -> float:
        """Return the bits of a condition."""
        sign = _HOLDS if condition.holds else _DENIED
        if not isinstance(condition, There):
            return sign + self.atom
        pattern = condition.pattern
        atoms = len(pattern.atoms)
        counted = log2(self.most) if condition.least > 1 else 0.0
        # In what order atoms and things are named says nothing.
        alike = log2(factorial(atoms)) + log2(factorial(pattern.things))
        places = atoms * log2(pattern.things)
        return sign + max(1.0, atoms * self.atom + places + pattern.things - alike) + counted

    def rule(self, rule: ThingRule) -> float:
        """Return the bits of a rule."""
        several = log2(factorial(len(rule.conditions)))
        return _RULE + sum(map(self.condition, rule.conditions)) - several
