"""Paired comparisons of two systems over trials: tests, effect size, interval, correction."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

__all__ = [
    "LEVEL",
    "Interval",
    "Paired",
    "can_tell",
    "compare",
    "holm",
    "interval",
    "ratio_interval",
]

LEVEL = 0.05
"""Level of significance."""

_RESAMPLES = 4999
_FEW = 13  # differences have fewer than 10,000 combinations of signs
_EQUAL, _DIGITS = 1e-12, 12  # of differences between shares: beyond is nothing but rounding


@dataclass(frozen=True)
class Interval:
    """A mean with its 95 % interval by bootstrap."""

    mean: float
    low: float
    high: float


@dataclass(frozen=True)
class Paired:
    """Two systems on the same trials.

    Attributes
    ----------
    trials : int
    mean, against : float
        Of the system and of the one it is compared with.
    difference : Interval
        Of the paired differences.
    deviation : float
        Standard deviation of the differences.
    effect : float
        Cohen's dz: the mean difference in standard deviations of the differences.
    p_t, p_wilcoxon : float
        Two-sided, of the paired t-test and of Wilcoxon's signed-rank test; nan below two trials.
    """

    trials: int
    mean: float
    against: float
    difference: Interval
    deviation: float
    effect: float
    p_t: float
    p_wilcoxon: float


def interval(values: Sequence[float], *, seed: int = 0) -> Interval:
    """Return the mean with a 95 % interval by bootstrap (bias-corrected and accelerated).

    Examples
    --------
    >>> interval([0.5, 0.5])
    Interval(mean=0.5, low=0.5, high=0.5)
    """
    from scipy.stats import bootstrap

    sample = np.asarray(values, dtype=np.float64)
    mean = float(sample.mean())
    if len(sample) < 2 or float(np.ptp(sample)) < _EQUAL:
        return Interval(mean, mean, mean)
    found = bootstrap(
        (sample,), np.mean, n_resamples=_RESAMPLES, rng=np.random.default_rng(seed), method="BCa"
    ).confidence_interval
    return Interval(mean, float(found.low), float(found.high))


def ratio_interval(values: Sequence[float], others: Sequence[float]) -> Interval:
    """Return the ratio of the means of paired values with its 95 % interval by bootstrap.

    Examples
    --------
    >>> ratio_interval([2.0, 4.0], [1.0, 2.0])
    Interval(mean=2.0, low=2.0, high=2.0)
    """
    from scipy.stats import bootstrap

    one, other = np.asarray(values, np.float64), np.asarray(others, np.float64)
    ratio = float(one.mean() / other.mean())
    if len(one) < 2 or float(np.ptp(one / other)) < _EQUAL:
        return Interval(ratio, ratio, ratio)

    def of_means(first: Any, second: Any, axis: int) -> Any:
        return np.mean(first, axis=axis) / np.mean(second, axis=axis)

    found = bootstrap(
        (one, other),
        of_means,
        paired=True,
        n_resamples=_RESAMPLES,
        rng=np.random.default_rng(0),
        method="BCa",
    ).confidence_interval
    return Interval(ratio, float(found.low), float(found.high))


def compare(system: Sequence[float], against: Sequence[float], *, seed: int = 0) -> Paired:
    """Compare two systems trial by trial.

    Parameters
    ----------
    system, against : sequence of float
        The measure in each trial, in the same order of trials.
    seed : int, default 0
        Of the bootstrap.

    Examples
    --------
    >>> found = compare([0.8, 0.9, 0.7], [0.7, 0.7, 0.7])
    >>> round(found.difference.mean, 3), round(found.effect, 3), round(found.p_t, 3)
    (0.1, 1.0, 0.225)
    """
    from scipy.stats import ttest_rel

    one, other = np.asarray(system, np.float64), np.asarray(against, np.float64)
    if len(one) != len(other):
        raise ValueError(f"trials must be paired, got {len(one)} and {len(other)}")
    apart = one - other
    apart[np.abs(apart) < _EQUAL] = 0.0
    count, mean = len(apart), float(apart.mean())
    deviation = float(apart.std(ddof=1)) if count > 1 else math.nan
    p_t = p_wilcoxon = math.nan
    if count > 1:
        constant = deviation < _EQUAL
        # Of differences that are all alike, a t-test knows no error to compare them with.
        p_t = (0.0 if mean else 1.0) if constant else float(ttest_rel(one, other).pvalue)
        # Two differences that are the same but for rounding are a tie.
        p_wilcoxon = _wilcoxon(np.round(apart, _DIGITS)) if apart.any() else 1.0
    return Paired(
        trials=count,
        mean=float(one.mean()),
        against=float(other.mean()),
        difference=interval(apart.tolist(), seed=seed),
        deviation=deviation,
        effect=_effect(mean, deviation),
        p_t=p_t,
        p_wilcoxon=p_wilcoxon,
    )


def _wilcoxon(apart: NDArray[np.float64]) -> float:
    """The two-sided p-value of Wilcoxon's signed-rank test, exact for few differences."""
    from scipy.stats import permutation_test, rankdata, wilcoxon

    differing = apart[apart != 0.0]
    if len(differing) == 1:
        return 1.0  # one sign tells nothing, and is no sample to permute
    if len(apart) > _FEW or len(np.unique(np.abs(differing))) == len(apart):
        return float(wilcoxon(apart).pvalue)

    # With ties, wilcoxon() looks at all signs, too, and ranks anew for each: that takes seconds.
    def above(ranks: Any, axis: int) -> Any:
        return np.where(ranks > 0, ranks, 0.0).sum(axis=axis)

    signed = rankdata(np.abs(differing)) * np.sign(differing)
    found = permutation_test((signed,), above, permutation_type="samples", vectorized=True)
    return float(found.pvalue)


def can_tell(trials: Sequence[int]) -> list[bool]:
    """Whether each of some comparisons, of so many trials, could be significant after correction.

    Were one system better in every trial, the p-value of Wilcoxon's two-sided test would be as
    small as it can be; one trial is no test.

    Examples
    --------
    >>> can_tell([6, 1]), can_tell([6, 6])
    ([True, False], [False, False])
    """
    least = [2.0 ** (1 - number) if number > 1 else math.nan for number in trials]
    return [p_value < LEVEL for p_value in holm(least)]


def _effect(mean: float, deviation: float) -> float:
    if math.isnan(deviation) or (mean == 0.0 and deviation < _EQUAL):
        return 0.0 if mean == 0.0 else math.nan
    return mean / deviation if deviation >= _EQUAL else math.copysign(math.inf, mean)


def holm(p_values: Sequence[float]) -> list[float]:
    """Correct p-values for their number (Holm 1979); nan stays nan and is not counted.

    Examples
    --------
    >>> holm([0.01, 0.04, 0.03])
    [0.03, 0.06, 0.06]
    """
    corrected = [math.nan] * len(p_values)
    known = [n for n, p_value in enumerate(p_values) if not math.isnan(p_value)]
    largest = 0.0
    for rank, number in enumerate(sorted(known, key=lambda position: p_values[position])):
        largest = max(largest, min(1.0, (len(known) - rank) * p_values[number]))
        corrected[number] = largest
    return corrected
