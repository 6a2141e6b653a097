"""What is proposed is judged on training pictures of which nothing was learned."""

from __future__ import annotations

import json
import shutil
from dataclasses import replace
from pathlib import Path

import pytest

from conftest import Run
from seewhy.agent.agent import Agent
from seewhy.data.dataset import Dataset
from seewhy.domain.domain import Domain
from seewhy.errors import DatasetError
from seewhy.evaluation.held_back import Proposal, hold_back, learn_judged
from seewhy.evaluation.other_knowledge import with_axioms

CORNERS = "-good(S) if -round(S)."
"""What pictures suggest in which no red tile with corners, which is good, was seen."""


def names(dataset: Dataset) -> set[str]:
    return {scene.picture.name for scene in dataset.scenes}


@pytest.fixture(scope="module")
def misleading(tiles: Domain, tiles_data: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Tiles among which those with corners are bad, but for the red ones that are held back."""
    folder = tmp_path_factory.mktemp("data") / "misleading"
    shutil.copytree(tiles_data, folder)
    _, held = hold_back(Dataset.load(folder, tiles).of_split("train"))
    head, *rows = (folder / "scenes.csv").read_text().splitlines()
    written = [head]
    for row in rows:
        image, label, colour, is_round, split = row.split(",")
        if label == "good":
            judges = Path(image).name in names(held)
            colour, is_round = ("red", "no") if judges else (colour, "yes")
        else:
            colour, is_round = ("green" if colour == "red" else colour), "no"
        written.append(",".join((image, label, colour, is_round, split)))
    (folder / "scenes.csv").write_text("\n".join(written) + "\n")
    return folder


@pytest.fixture
def naive(tiles: Domain, model_folder: Path) -> Agent:
    """An agent with networks that remembers no pictures."""
    agent = Agent(tiles)
    agent.extractor = Agent.load(model_folder).extractor
    return agent


def test_a_fifth_is_held_back_of_every_class_with_whole_groups(dataset: Dataset) -> None:
    train = dataset.of_split("train")
    kept, held = hold_back(train)
    assert (len(kept), len(held)) == (32, 8)
    assert set(held.labels) == set(kept.labels) == {"good", "bad"}
    assert not names(kept) & names(held)
    assert names(hold_back(train)[1]) == names(held)
    assert names(hold_back(train, seed=1)[1]) != names(held)
    pairs = train.of_scenes(
        tuple(
            replace(scene, group=f"{scene.label} {number // 2}")
            for number, scene in enumerate(train.scenes)
        )
    )
    kept, held = hold_back(pairs)
    assert held.groups
    assert not set(kept.groups) & set(held.groups)


def test_what_lowers_accuracy_is_not_accepted(
    naive: Agent, tiles: Domain, misleading: Path
) -> None:
    data = Dataset.load(misleading, tiles)
    asked: list[Proposal] = []

    def note(proposal: Proposal) -> bool:
        asked.append(proposal)
        return not proposal.falls

    found = learn_judged(naive, data, accept=note, answers=False)
    (falling,) = [proposal for proposal in asked if proposal.falls]
    assert falling.statement == CORNERS
    good = sum(label == "good" for label in hold_back(data.of_split("train"))[1].classes)
    assert falling.lost == good
    assert CORNERS not in [str(axiom) for axiom in found.agent.learned]
    assert found.after is not None
    assert found.after.right.value == 1.0
    worse = learn_judged(naive, data, accept=lambda _: True, answers=False)
    assert CORNERS in [str(axiom) for axiom in worse.agent.learned]
    assert worse.before is not None
    assert worse.after is not None
    assert worse.before.right.right - worse.after.right.right == good


def test_what_is_held_back_teaches_nothing(naive: Agent, tiles: Domain, misleading: Path) -> None:
    """Were the red tiles with corners among what is learned from, nothing would be wrong."""
    data = Dataset.load(misleading, tiles)
    found = learn_judged(naive, data, answers=False)
    assert CORNERS in [str(axiom) for axiom in found.learning.found]
    assert CORNERS not in [str(axiom) for axiom in naive.learn(data, answers=False).found]


def test_what_an_agent_remembers_of_pictures_held_back_is_not_learned_from_either(
    naive: Agent, tiles: Domain, misleading: Path
) -> None:
    """Such as the model was trained on: it has counted their annotation."""
    data = Dataset.load(misleading, tiles)
    train = data.of_split("train")
    naive.fit_induction(train.vectors, train.classes, answers=False)
    naive.trained_on = frozenset(train.picture_digests())
    found = learn_judged(naive, data, answers=False)
    assert CORNERS in [str(axiom) for axiom in found.learning.found]


def test_everything_trains_the_tree_in_the_end(model_folder: Path, dataset: Dataset) -> None:
    agent = Agent.load(model_folder)
    before = (agent.learned, agent.experience, agent.tree.paths())
    found = learn_judged(agent, dataset, answers=False)
    assert found.learning.added
    assert found.agent.learned == found.learning.added
    assert found.agent.experience == agent.experience  # all were counted, and none twice
    assert (found.learned_from, found.held_back) == (32, 8)
    assert all(axiom.origin.support <= 32 for axiom in found.agent.learned)
    assert (agent.learned, agent.experience, agent.tree.paths()) == before


def test_pictures_to_test_on_are_not_looked_at(
    naive: Agent, dataset: Dataset, tmp_path: Path
) -> None:
    scenes = tuple(
        scene if scene.split == "train" else replace(scene, picture=tmp_path / "gone.png")
        for scene in dataset.scenes
    )
    found = learn_judged(naive, dataset.of_scenes(scenes), answers=False)
    assert found.held_back == 8


def test_a_dataset_of_another_domain(structures: Domain, dataset: Dataset) -> None:
    with pytest.raises(DatasetError) as problem:
        learn_judged(Agent(structures), dataset)
    assert str(problem.value) == (
        f"{dataset.folder}: the dataset is of the domain 'tiles', the agent of "
        "'structure_stability'; load it with the agent's domain"
    )


def test_an_agent_with_other_axioms(model_folder: Path, dataset: Dataset) -> None:
    agent = Agent.load(model_folder)
    (axiom, *_) = Agent.load(model_folder).learn(dataset, answers=False).added
    other = with_axioms(agent, [axiom], ())
    assert other.extractor is agent.extractor
    assert [str(one) for one in other.learned] == [str(axiom)]
    assert len(other.domain.knowledge.axioms) == len(agent.domain.knowledge.axioms) + 1
    other.fit_induction(dataset.vectors, dataset.classes, answers=False)
    assert agent.learned == ()
    assert agent.tree.paths() == Agent.load(model_folder).tree.paths()


# The command line -----------------------------------------------------------------------------


@pytest.fixture
def naive_model(naive: Agent, tiles: Domain, misleading: Path, tmp_path: Path) -> Path:
    kept, _ = hold_back(Dataset.load(misleading, tiles).of_split("train"))
    naive.fit_induction(kept.vectors, kept.classes, answers=False)
    naive.trained_on = frozenset(kept.picture_digests())
    naive.save(tmp_path / "model")
    return tmp_path / "model"


def test_the_fall_is_said_before_it_is_asked(run: Run, naive_model: Path, misleading: Path) -> None:
    result = run("learn", naive_model, "--data", misleading, stdin="\n" * 9)
    lines = result.out.splitlines()
    start = next(n for n, line in enumerate(lines) if CORNERS in line)
    assert lines[start + 1].startswith("  of 8 pictures held back, classified rightly: 100.0 % be")
    assert lines[start + 2].startswith("  ACCURACY WOULD FALL by ")
    assert lines[start + 3].startswith("  add this axiom? [y/N]: ")
    # Who only presses return does not accept it.
    assert CORNERS not in [str(axiom) for axiom in Agent.load(naive_model).learned]
    assert f"left out: {CORNERS}" in lines


def test_yes_does_not_accept_a_fall(run: Run, naive_model: Path, misleading: Path) -> None:
    files = {path: path.read_bytes() for path in naive_model.rglob("*") if path.is_file()}
    shown = json.loads(run("learn", naive_model, "--data", misleading, "--json").out)
    assert {path: path.read_bytes() for path in files} == files  # it was only shown
    assert (shown["added"], shown["held_back"], shown["learned_from"]) == ([], 8, 32)
    falls = {row["statement"]: row for row in shown["judged"]}[CORNERS]
    assert falls["falls"]
    assert not falls["accepted"]
    assert not any(row["accepted"] for row in shown["judged"])
    assert [row["falls"] for row in shown["judged"]].count(False) == len(shown["judged"]) - 1
    assert not falls["set_aside"]
    key = "annotated features classified rightly"
    assert falls["after"][key] < falls["before"][key] == 1.0
    result = run("learn", naive_model, "--data", misleading, "--yes")
    assert f"left out: {CORNERS}" in result.out.splitlines()
    assert CORNERS not in [str(axiom) for axiom in Agent.load(naive_model).learned]
    result = run("learn", naive_model, "--data", misleading, "--yes", "--even-if-worse")
    assert result.code == 0
    # All pictures are remembered by now, and those held back are left out of what is learned.
    assert f"agreed to all the same: {CORNERS}" in result.out.splitlines()
    assert CORNERS in [str(axiom) for axiom in Agent.load(naive_model).learned]


def test_even_if_worse_goes_with_yes(run: Run, model_folder: Path, tiles_data: Path) -> None:
    result = run("learn", model_folder, "--data", tiles_data, "--even-if-worse")
    assert (result.code, result.out) == (2, "")
    assert result.err == "seewhy: --even-if-worse goes with --yes; without it you are asked\n"
