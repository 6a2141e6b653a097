"""Which way of seeing is asked."""

from __future__ import annotations

import numpy as np
import pytest

from seewhy.perception.stacking import fit_stack

TARGETS = np.zeros(300, dtype=int)


def table(wrong: int) -> np.ndarray:
    """Logarithms of probabilities for 300 pictures, so many of them misread."""
    right = np.full(300, 0.99)
    right[:wrong] = 0.2
    return np.log(np.stack([right, 1 - right], axis=1))


@pytest.mark.parametrize(
    ("wrong", "clearly", "asked"),
    [
        (1, True, "region"),  # by chance it may be as much better
        (1, False, "box"),
        (3, False, "region"),
        (40, True, "region"),
    ],
)
def test_a_little_better_is_clearly_better_only_where_nothing_is_preferred(
    wrong: int, clearly: bool, asked: str
) -> None:
    tables = {"region": table(3 if wrong != 3 else 2), "box": table(wrong)}
    assert fit_stack(tables, TARGETS, preferred="region", clearly=clearly).asked == (asked,)
