"""The statistics of experiments, against brute force and numbers worked out by hand."""

from __future__ import annotations

import math
from itertools import product

import numpy as np
import pytest
from scipy import stats

from seewhy_lab.experiments.statistics import Interval, compare, holm, interval

OURS = [0.81, 0.84, 0.79, 0.88, 0.83, 0.86, 0.80]
THEIRS = [0.78, 0.85, 0.74, 0.81, 0.82, 0.80, 0.74]


def test_the_t_test_is_its_formula() -> None:
    found = compare(OURS, THEIRS)
    apart = [a - b for a, b in zip(OURS, THEIRS, strict=True)]
    mean = sum(apart) / 7
    deviation = math.sqrt(sum((difference - mean) ** 2 for difference in apart) / 6)
    t = mean / (deviation / math.sqrt(7))
    assert found.p_t == pytest.approx(2 * stats.t.sf(t, df=6))
    assert found.difference.mean == pytest.approx(mean)
    assert found.effect == pytest.approx(mean / deviation)
    assert (found.trials, found.deviation) == (7, pytest.approx(deviation))
    assert compare(THEIRS, OURS).effect == pytest.approx(-found.effect)


def test_wilcoxon_is_the_share_of_all_signs() -> None:
    ours = [0.03, -0.01, 0.05, 0.07, 0.02, 0.06, 0.045]
    ranks = stats.rankdata(np.abs(ours))
    observed = sum(rank for rank, difference in zip(ranks, ours, strict=True) if difference > 0)
    sums = [
        sum(rank for rank, up in zip(ranks, signs, strict=True) if up)
        for signs in product((False, True), repeat=7)
    ]
    above = sum(total >= observed for total in sums) / len(sums)
    found = compare(ours, [0.0] * 7)
    assert found.p_wilcoxon == pytest.approx(2 * above)


def test_differences_that_are_the_same_but_for_rounding_are_ties() -> None:
    # 0.3 - 0.2 and 0.8 - 0.7 are not the same number.
    found = compare([0.3, 0.8, 0.5, 0.4], [0.2, 0.7, 0.4, 0.5])
    assert found.p_wilcoxon == stats.wilcoxon([1, 1, 1, -1]).pvalue


@pytest.mark.parametrize("count", [2, 3, 8, 14])
def test_ties_and_zeros_count_as_in_scipy(count: int) -> None:
    rng = np.random.default_rng(count)
    for most in (1, 2, 4):
        ours = rng.integers(-most, most + 1, size=count).astype(float)
        ours[0] = most
        found = compare(ours.tolist(), [0.0] * count)
        assert found.p_wilcoxon == pytest.approx(stats.wilcoxon(ours).pvalue, abs=1e-12)


def test_holm_by_hand() -> None:
    # 0.01·4, then 0.02·3, then 0.03·2 = 0.06 at least as large as the one before, then 0.2.
    assert holm([0.02, 0.2, 0.01, 0.03]) == pytest.approx([0.06, 0.2, 0.04, 0.06])
    assert holm([0.9, 0.8]) == [1.0, 1.0]
    assert holm([]) == []
    corrected = holm([0.01, math.nan, 0.04])
    assert corrected[0] == pytest.approx(0.02)
    assert math.isnan(corrected[1])


def test_the_interval_is_that_of_many_resamples() -> None:
    rng = np.random.default_rng(1)
    values = rng.normal(0.8, 0.05, size=40)
    means = rng.choice(values, size=(20_000, 40)).mean(axis=1)
    low, high = np.quantile(means, [0.025, 0.975])
    found = interval(values.tolist())
    assert found.mean == pytest.approx(values.mean())
    assert (found.low, found.high) == (
        pytest.approx(low, abs=0.002),
        pytest.approx(high, abs=0.002),
    )
    assert found == interval(values.tolist())


def test_where_nothing_varies() -> None:
    assert interval([0.7]) == Interval(0.7, 0.7, 0.7)
    same = compare([0.5, 0.6], [0.5, 0.6])
    assert (same.p_t, same.p_wilcoxon, same.effect) == (1.0, 1.0, 0.0)
    always = compare([0.6, 0.7, 0.8], [0.5, 0.6, 0.7])
    assert (always.p_t, always.effect) == (0.0, math.inf)
    one = compare([0.6], [0.5])
    assert math.isnan(one.p_t)
    assert math.isnan(one.effect)
    with pytest.raises(ValueError, match="paired"):
        compare([0.1], [0.1, 0.2])
