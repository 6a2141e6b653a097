"""The evaluation's numbers, against numbers counted by hand."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

from conftest import seen, write_tiles
from seewhy.agent import Agent
from seewhy.data.dataset import Dataset
from seewhy.dialogue.answer import AnswerType
from seewhy.domain import Domain
from seewhy.evaluation import AxiomRecord, axiom_records, evaluate, score_answer
from seewhy.reply import Classification


@pytest.mark.parametrize(
    ("given", "gold", "expected"),
    [
        ("reasons(lean)", "reasons(lean)", (True, True)),
        ("reasons(base,lean)", "reasons(lean)", (True, False)),
        ("reasons(base)", "reasons(lean)", (False, False)),
        ("reasons()", "reasons(lean)", (False, False)),
        ("reasons(lean)", "reasons()", (True, False)),
        ("false_premise(lean)", "reasons(lean)", (False, False)),
        ("value(base)", "value(base)", (False, False)),  # the base is seen wrongly below
        ("yes_class()", "yes_class()", (True, True)),
        ("yes_class()", "no_class()", (False, False)),
        ("already()", "already()", (True, True)),
        ("change()[lean=no]", "change()[lean=no]", (True, True)),
        ("change()[lean=no][base=wide]", "change()[lean=no]", (True, False)),
        ("change()[lean=no]", "change()[base=wide][lean=no]", (True, True)),
        ("change()[lean=no&base=wide]", "change()[base=wide&lean=no]", (True, True)),
        ("change()[lean=no&base=wide]", "change()[lean=no]", (False, False)),
        ("change()[base=wide]", "change()[lean=no]", (False, False)),
        ("no_change()", "no_change()", (True, True)),
    ],
)
def test_an_answer_is_scored(given: str, gold: str, expected: tuple[bool, bool]) -> None:
    scored = score_answer(
        AnswerType.parse(given),
        AnswerType.parse(gold),
        seen={"lean": "yes", "base": "wide"},
        true={"lean": "yes", "base": "narrow"},
        right_class=True,
    )
    assert scored == expected


def test_an_answer_that_names_the_wrong_class() -> None:
    values: dict[str, str | None] = {"lean": "yes"}
    for form, expected in (("class", (False, False)), ("no_class", (True, False))):
        kind = AnswerType(form)
        scored = score_answer(kind, kind, seen=values, true=values, right_class=False)
        assert scored == expected


def test_axioms_are_counted_by_hand(tiles: Domain) -> None:
    vectors = [("red", "yes"), ("red", "no"), ("red", None), ("blue", "no"), ("green", "no")]
    records = axiom_records(Agent(tiles).reasoner, vectors, ["good", "bad", "good", "bad", "bad"])
    assert records == (
        AxiomRecord("a1", "good(T) if colour(T, red).", "a red tile is good", 3, 2),
        AxiomRecord(
            "a2",
            "-good(T) if colour(T, blue), not round(T).",
            "a blue tile with corners is bad",
            1,
            1,
        ),
    )
    assert [record.accuracy for record in records] == [2 / 3, 1.0]
    assert AxiomRecord("a", "", "", 0, 0).accuracy == 1.0


class Stub(Agent):
    """Sees what it is told to see."""

    told: list[tuple[str, str]]

    def classify_all(self, pictures: np.ndarray) -> list[Classification]:
        assert len(pictures) == len(self.told)
        return [seen(self, *values) for values in self.told]


@pytest.fixture
def four(tiles: Domain, tmp_path: Path) -> Dataset:
    """Four scenes: round red good, cornered red good, green good, green bad."""
    folder = write_tiles(tmp_path / "four", count=4)
    (folder / "scenes.csv").write_text(
        "image,class,colour,round\n"
        "images/000.png,good,red,yes\n"
        "images/001.png,good,red,no\n"
        "images/002.png,good,green,\n"
        "images/003.png,bad,green,no\n"
    )
    return Dataset.load(folder, tiles)


def test_shares_are_counted_by_hand(tiles: Domain, four: Dataset) -> None:
    agent = Stub(tiles)
    agent.told = [("red", "yes"), ("blue", "no"), ("red", "yes"), ("green", "no")]
    asked: list[int] = []
    result = evaluate(agent, four, on_progress=asked.append)
    assert asked == [1, 2, 3, 4]
    assert result.scenes == 4
    assert result.seen_in_training == 0
    # good as good, good as bad, good (green seen as red) as good, bad undecided
    assert result.classification_accuracy == 0.5
    assert result.feature_accuracy == {"colour": 0.5, "round": 1.0}  # round is known of three
    assert result.decided_by_knowledge == 0.75
    assert result.accuracy_by_method == {"knowledge": pytest.approx(2 / 3), "none": 0.0}
    assert result.determined == 1.0
    assert 0.0 < result.answer_accuracy < 1.0
    assert result.answer_accuracy_strict <= result.answer_accuracy
    assert result.explanation_accuracy_strict <= result.explanation_accuracy


def test_answers_of_the_knowledge_about_what_is_seen_rightly_are_right(
    tiles: Domain, four: Dataset
) -> None:
    agent = Stub(tiles)
    agent.told = [("red", "yes"), ("red", "no")]
    result = evaluate(agent, four.take([0, 1]), questions_per_scene=99)
    assert result.answer_accuracy == result.answer_accuracy_strict == 1.0
    assert result.explanation_accuracy == result.explanation_accuracy_strict == 1.0


def test_answers_are_counted_by_hand(tiles: Domain, four: Dataset) -> None:
    """A round red tile is seen as one with corners: its class and the reasons stay right.

    Of eleven queries, two are answered wrongly: whether it is round, and what would make it bad
    (painting it blue is enough only where there are corners). Six queries are explanatory.
    """
    agent = Stub(tiles)
    agent.told = [("red", "no")]
    result = evaluate(agent, four.take([0]), questions_per_scene=99)
    assert result.classification_accuracy == 1.0
    assert result.answer_accuracy == result.answer_accuracy_strict == pytest.approx(9 / 11)
    assert result.explanation_accuracy == pytest.approx(5 / 6)
    assert result.explanation_accuracy_strict == pytest.approx(5 / 6)


def test_nothing_is_right_about_a_scene_that_is_seen_wrongly(tiles: Domain, four: Dataset) -> None:
    agent = Stub(tiles)
    agent.told = [("blue", "no")]
    result = evaluate(agent, four.take([0]), questions_per_scene=99)
    assert result.answer_accuracy == result.explanation_accuracy == 0.0


def test_the_same_seed_asks_the_same(tiles: Domain, four: Dataset) -> None:
    agent = Stub(tiles)
    agent.told = [("red", "yes"), ("blue", "no"), ("red", "yes"), ("green", "no")]
    first = evaluate(agent, four, questions_per_scene=2, seed=1)
    assert first == evaluate(agent, four, questions_per_scene=2, seed=1)


def test_the_keys_that_programs_read(agent: Agent, dataset: Dataset) -> None:
    result = evaluate(agent, dataset, questions_per_scene=2)
    record = json.loads(json.dumps(result.to_dict()))
    assert {
        "classification_accuracy",
        "answer_accuracy",
        "answer_accuracy_strict",
        "feature_accuracy",
        "decided_by_knowledge",
        "scenes",
    } <= set(record)
    assert set(record["feature_accuracy"]) == {"colour", "round"}
    assert record["scenes"] == 20
    assert record["seen_in_training"] == 0
    assert record["axioms"][0] == {
        "identifier": "a1",
        "statement": "good(T) if colour(T, red).",
        "text": "a red tile is good",
        "decided": 6,
        "right": 6,
        "accuracy": 1.0,
    }


def test_pictures_that_were_trained_on_are_counted(agent: Agent, dataset: Dataset) -> None:
    everything = dataset.take(range(len(dataset)))
    without_splits = Dataset(
        scenes=tuple(
            type(scene)(scene.picture, scene.vector, scene.label) for scene in everything.scenes
        ),
        domain=dataset.domain,
        folder=dataset.folder,
    )
    assert evaluate(agent, without_splits, questions_per_scene=1).seen_in_training >= 40
