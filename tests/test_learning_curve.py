"""Models trained on growing parts of the pictures: which pictures, what is kept, what is said."""

from __future__ import annotations

import json
import re
import shutil
from collections.abc import Callable
from dataclasses import replace
from itertools import pairwise
from pathlib import Path
from typing import Any

import pytest

from conftest import Run
from seewhy.agent.agent import Agent
from seewhy.data.dataset import Dataset
from seewhy.errors import DatasetError
from seewhy.evaluation.curve import growing_parts, learning_curve


def names(dataset: Dataset) -> set[str]:
    return {scene.picture.name for scene in dataset.scenes}


def test_parts_double_and_lie_within_each_other(dataset: Dataset) -> None:
    parts = growing_parts(dataset.of_split("train"), seed=1)
    assert [len(part) for part in parts] == [4, 9, 19, 40]
    for less, more in pairwise(parts):
        assert names(less) < names(more)
        assert set(less.labels) == set(more.labels)
    assert names(parts[0]) != names(growing_parts(dataset.of_split("train"), seed=2)[0])


def test_groups_stay_whole(dataset: Dataset) -> None:
    train = dataset.of_split("train")
    scenes = tuple(
        replace(scene, group=f"{scene.label} {number // 8}")
        for number, scene in enumerate(train.scenes)
    )
    grouped = train.of_scenes(scenes)
    whole = {group: grouped.groups.count(group) for group in grouped.groups}
    for part in growing_parts(grouped):
        assert {group: part.groups.count(group) for group in part.groups}.items() <= whole.items()


def test_what_cannot_be_halved_is_not(dataset: Dataset) -> None:
    train = dataset.of_split("train")
    two = train.of_scenes(tuple(replace(s, group=str(s.label)) for s in train.scenes))
    assert [len(part) for part in growing_parts(two)] == [40]


@pytest.fixture
def trainings(monkeypatch: pytest.MonkeyPatch) -> list[int]:
    """The numbers of pictures that models are trained on from now on."""
    numbers: list[int] = []
    real: Callable[..., Agent] = Agent.fit

    def fit(self: Agent, dataset: Dataset, **options: Any) -> Agent:
        numbers.append(len(dataset))
        return real(self, dataset, **options)

    monkeypatch.setattr(Agent, "fit", fit)
    return numbers


@pytest.mark.usefixtures("in_one_process")
def test_a_curve_is_kept_and_goes_on(
    run: Run, model_folder: Path, tiles_data: Path, tmp_path: Path, trainings: list[int]
) -> None:
    """Interrupted after one model, it trains the others; asked again, none."""
    model, page = tmp_path / "model", tmp_path / "page.html"
    shutil.copytree(model_folder, model)
    command = ("evaluate", model, "--data", tiles_data, "--curve", "--page", page)
    agent = Agent.load(model)
    dataset = Dataset.load(tiles_data, agent.domain)

    def interrupt(_: object) -> None:
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        learning_curve(agent, dataset, tmp_path / "model.curve", on_point=interrupt)
    assert trainings == [4]
    first = run(*command)
    assert first.code == 0, first.err
    assert trainings == [4, 9, 19, 40]
    again = run(*command)
    assert len(trainings) == 4
    assert again.out == first.out
    table = first.out[first.out.index("trained on") :].splitlines()
    assert table[0].split() == ["trained", "on", "class", "95", "%", "interval", "colour", "round"]
    last = table[[line.split()[0] for line in table].index("40")].split()
    assert last[1:3] == ["100.0", "%"]
    assert "what the curve says:" in table
    text = page.read_text(encoding="utf-8")
    assert "<h2>Learning curve</h2>" in text
    record = json.loads(run(*command[:-2], "--json").out)
    assert record["curve"]["held_out"] == 20
    assert record["curve"]["points"][-1]["pictures"] == 40
    assert record["curve"]["points"][-1]["classification_accuracy"] == 1.0
    assert len(trainings) == 4


@pytest.mark.usefixtures("in_one_process")
def test_models_of_a_curve_answer_every_picture(
    agent: Agent, dataset: Dataset, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Only with many pictures a model knows when it does not know; that is not to seem worse."""
    monkeypatch.setattr(agent, "known_share", 0.9)

    def stop(_: object) -> None:
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        learning_curve(agent, dataset, tmp_path, on_point=stop)
    (kept,) = tmp_path.iterdir()
    assert Agent.load(kept).known_share == 1.0
    assert agent.known_share == 0.9


def test_other_annotation_is_another_training(
    agent: Agent, dataset: Dataset, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A kept model is not taken for one of other labels, domains or options."""
    from seewhy.evaluation import curve

    part = dataset.of_split("train")
    other = part.of_scenes((replace(part.scenes[0], label="bad"), *part.scenes[1:]))
    plain = curve._identity(agent, part)
    assert curve._identity(agent, other) != plain
    assert curve._identity(agent, part.take(range(39))) != plain
    monkeypatch.setattr(agent, "gate", 0.5)
    assert curve._identity(agent, part) != plain
    monkeypatch.undo()
    assert curve._identity(agent, part) == plain


def test_parts_that_teach_nothing_are_left_out(
    agent: Agent, dataset: Dataset, tmp_path: Path
) -> None:
    """A part in which no tile has a shape is passed over: nothing could be trained on it."""
    train = dataset.of_split("train")
    scenes = [scene for scene in train.scenes if scene.label == "good"][:6]
    bad = [scene for scene in train.scenes if scene.label == "bad"][:1]
    kept = growing_parts(train.of_scenes((*scenes, *bad)), seed=agent.seed)[0]
    rare = next(scene for scene in scenes if scene.picture.name not in names(kept))
    blurred = tuple(
        scene if scene is rare else replace(scene, vector=(scene.vector[0], None))
        for scene in (*scenes, *bad)
    )
    asked: list[int] = []

    def stop(number: int) -> None:
        asked.append(number)
        raise KeyboardInterrupt

    test = dataset.of_split("test").scenes
    with pytest.raises(KeyboardInterrupt):
        learning_curve(agent, dataset.of_scenes((*blurred, *test)), tmp_path, on_part=stop)
    sizes = [len(part) for part in growing_parts(train.of_scenes(blurred), seed=agent.seed)]
    assert len(sizes) > 1
    assert asked[0] > sizes[0]


def test_a_curve_needs_splits(
    run: Run, model_folder: Path, tiles_data: Path, agent: Agent, tmp_path: Path
) -> None:
    folder = tmp_path / "data"
    shutil.copytree(tiles_data, folder)
    table = folder / "scenes.csv"
    table.write_text(re.sub(r",(train|test|split)\n", "\n", table.read_text()))
    said = (
        f"{table}: a learning curve needs pictures that are kept for evaluation; add a column "
        "split, with train and test"
    )
    result = run("evaluate", model_folder, "--data", folder, "--curve")
    assert (result.code, result.out) == (2, "")
    assert result.err.splitlines()[-1] == f"seewhy: {said}"
    with pytest.raises(DatasetError) as problem:
        learning_curve(agent, Dataset.load(folder, agent.domain), tmp_path / "kept")
    assert str(problem.value) == said
