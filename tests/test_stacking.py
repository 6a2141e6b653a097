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
    ("region_wrong", "box_wrong", "clearly", "asked"),
    [
        (3, 1, True, "region"),  # by chance it may be as much better
        (3, 1, False, "box"),
        (2, 3, False, "region"),
        (40, 1, True, "box"),
    ],
)
def test_a_way_that_is_a_little_better_is_asked_where_it_need_not_be_clearly_so(
    region_wrong: int, box_wrong: int, clearly: bool, asked: str
) -> None:
    tables = {"region": table(region_wrong), "box": table(box_wrong)}
    assert fit_stack(tables, TARGETS, preferred="region", clearly=clearly).asked == (asked,)
