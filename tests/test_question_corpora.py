"""Wordings that were written without sight of the grammar are understood as they were meant."""

from __future__ import annotations

from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path
from types import ModuleType

import pytest

HERE = Path(__file__).parent
CORPORA = HERE / "questions"
LEAST_RIGHT = {"structure_stability": 0.97, "traffic_signs": 0.96, "robot_assistant": 0.96}
MOST_MISREAD = 0.01


@pytest.fixture(scope="module")
def measuring() -> ModuleType:
    path = HERE.parent / "experiments" / "questions_understood.py"
    spec = spec_from_file_location("questions_understood", path)
    assert spec is not None
    assert spec.loader is not None
    module = module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.mark.parametrize("domain", LEAST_RIGHT)
def test_the_development_half_is_understood(measuring: ModuleType, domain: str) -> None:
    counted, wrong = measuring.judge(CORPORA / f"development_{domain}.csv")
    total = sum(counted.values())
    assert total > 450
    assert counted["right"] / total >= LEAST_RIGHT[domain], wrong
    assert counted["misread"] / total <= MOST_MISREAD, wrong
