"""Wordings that were written without sight of the grammar are understood as they were meant."""

from __future__ import annotations

from pathlib import Path

import pytest

from seewhy_lab.commands.questions_understood import judge

HERE = Path(__file__).parent
CORPORA = HERE / "questions"
LEAST_RIGHT = {"structure_stability": 0.97, "traffic_signs": 0.96, "robot_assistant": 0.96}
MOST_MISREAD = 0.01


@pytest.mark.parametrize("domain", LEAST_RIGHT)
def test_the_development_half_is_understood(domain: str) -> None:
    counted, wrong = judge(CORPORA / f"development_{domain}.csv")
    total = counted["right"] + counted["missed"] + counted["misread"]
    assert total > 450
    assert counted["right"] / total >= LEAST_RIGHT[domain], wrong
    assert counted["misread"] / total <= MOST_MISREAD, wrong
