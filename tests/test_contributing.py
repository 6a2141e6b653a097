"""What contributors and those who watch a training are told: the code runs, the files exist."""

from __future__ import annotations

import re
import sys
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest

from conftest import write_tiles
from seewhy.agent.agent import Agent
from seewhy.data.dataset import Dataset
from seewhy.domain.domain import Domain
from seewhy.perception.backbones import registry
from seewhy.perception.events import EyesEvent
from seewhy.planning.planner import a_star

ROOT = Path(__file__).parents[1]
PAGES = sorted((ROOT / "docs" / "contributing").glob("*.md"))


def programs(page: str) -> list[str]:
    text = (ROOT / "docs" / page).read_text(encoding="utf-8")
    return re.findall(r"^```python\n(.*?)^```$", text, flags=re.MULTILINE | re.DOTALL)


@pytest.mark.parametrize("page", [ROOT / "CONTRIBUTING.md", *PAGES], ids=lambda page: page.stem)
def test_the_files_that_are_named_exist(page: Path) -> None:
    text = page.read_text(encoding="utf-8")
    named = re.findall(r"`((?:src|tests|docs|benchmarks)/[\w/.]+)`", text)
    linked = re.findall(r"\]\(([\w/.]+)\)", text)
    assert named + linked
    for name in named:
        if "NAME" not in name:
            assert (ROOT / name).exists(), name
    for name in linked:
        assert (page.parent / name).exists(), name


def test_every_page_is_linked_from_the_first() -> None:
    text = (ROOT / "CONTRIBUTING.md").read_text(encoding="utf-8")
    for page in PAGES:
        assert f"(docs/contributing/{page.name})" in text


def test_the_heuristic_finds_plans_as_short(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(a_star, "LandmarkHeuristic", a_star.LandmarkHeuristic)
    (program,) = programs("contributing/planner_heuristic.md")
    exec(program, {"__name__": "heuristic"})
    assert a_star.LandmarkHeuristic.__name__ == "GoalHolds"


def test_the_backbone_embeds_pictures(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(registry, "FAMILIES", {**registry.FAMILIES})
    (program,) = programs("contributing/backbone.md")
    exec(program, {"__name__": "backbone"})
    assert registry.load_backbone("colours", device="cpu").side == 64


def test_the_importer_is_a_reader() -> None:
    (program,) = programs("contributing/importer.md")
    known: dict[str, Any] = {"__name__": "importer"}
    exec(program, known)
    assert known["list_files"](_NoFiles()) == []


class _NoFiles:
    def named(self, *_: str) -> list[str]:
        return []


@pytest.fixture
def logged(monkeypatch: pytest.MonkeyPatch) -> list[tuple[str, float, int]]:
    """What callbacks log; MLflow and TensorBoard are stand-ins with the calls that are used."""
    rows: list[tuple[str, float, int]] = []

    class SummaryWriter:
        def __init__(self, folder: str) -> None:
            assert folder == "runs/tensorboard"

        def add_scalar(self, tag: str, scalar_value: float, global_step: int) -> None:
            rows.append((tag, scalar_value, global_step))

    tensorboard = ModuleType("torch.utils.tensorboard")
    tensorboard.SummaryWriter = SummaryWriter  # type: ignore[attr-defined]
    mlflow = ModuleType("mlflow")
    mlflow.log_metric = lambda key, value, step: rows.append((key, value, step))  # type: ignore[attr-defined]
    monkeypatch.setitem(sys.modules, "torch.utils.tensorboard", tensorboard)
    monkeypatch.setitem(sys.modules, "mlflow", mlflow)
    return rows


def test_a_training_is_watched(
    tiles: Domain, tmp_path: Path, logged: list[tuple[str, float, int]]
) -> None:
    write_tiles(tmp_path / "data", count=24)
    dataset = Dataset.load(tmp_path / "data", tiles)
    callbacks: dict[str, Any] = {}
    for program in programs("howto/watch_training.md"):
        exec(program, callbacks)

    def both(event: Any) -> None:
        callbacks["to_tensorboard"](event)
        callbacks["to_mlflow"](event)

    Agent(tiles).fit(dataset, on_progress=both, workers=1)
    names = {name for name, _, _ in logged}
    assert names >= {"colour", "round", "validation_accuracy_colour", "validation_accuracy_round"}
    for name in names:
        steps = [step for logged_name, _, step in logged if logged_name == name]
        assert steps == list(range(len(steps)))
    assert all(0.0 <= value <= 1.0 for _, value, _ in logged)
    logged.clear()
    both(EyesEvent("looking", 3, 12))
    assert logged == [("looking", 0.25, 0)]
