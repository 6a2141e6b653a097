"""The evaluation's numbers, against numbers counted by hand."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from conftest import KNOWLEDGE, seen, write_domain, write_tiles
from seewhy.agent.agent import Agent
from seewhy.data.dataset import Dataset
from seewhy.dialogue.answer import AnswerType
from seewhy.dialogue.reply import Classification
from seewhy.domain.domain import Domain, load_domain
from seewhy.evaluation import (
    AxiomRecord,
    Misreading,
    axiom_records,
    evaluate,
    score_answer,
)


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
    assert AxiomRecord("a", "", "", 0, 0).accuracy is None


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


def test_figures_are_counted_by_hand(tiles: Domain, four: Dataset) -> None:
    agent = Stub(tiles)
    agent.told = [("red", "yes"), ("blue", "no"), ("red", "yes"), ("green", "no")]
    result = evaluate(agent, four)
    classes = result.class_recognition.confusion
    assert classes.values == ("good", "bad")
    assert classes.counts == ((2, 1), (0, 0))
    assert classes.undecided == (0, 1)
    assert classes.pictures == {"good": 3, "bad": 1}
    assert (classes.majority, classes.majority_share.value) == ("good", 0.75)
    assert classes.balanced_accuracy == pytest.approx((2 / 3 + 0) / 2)
    assert classes.share.interval == pytest.approx((0.15, 0.85), abs=0.001)
    assert classes.confused == (("good", "bad", 1), ("bad", None, 1))
    colours = result.feature_recognition["colour"]
    assert colours.confusion.values == ("red", "green", "blue")
    assert colours.confusion.counts == ((1, 0, 1), (1, 1, 0), (0, 0, 0))
    assert colours.confusion.pictures == {"red": 2, "green": 2}
    # All four were said with 0.9, two are right.
    assert (colours.calibration.said, colours.calibration.share.value) == (0.9, 0.5)
    assert colours.calibration.error == pytest.approx(0.4)
    assert result.class_recognition.calibration.share.of == 0  # no probability was said
    assert result.feature_recognition["round"].confusion.share.of == 3
    assert (result.groups, result.has_splits) == (4, False)


def test_wrong_pictures_are_listed(tiles: Domain, four: Dataset) -> None:
    agent = Stub(tiles)
    agent.told = [("red", "no"), ("blue", "no"), ("red", "yes"), ("green", "no")]
    result = evaluate(agent, four)
    listed = [
        (one.image, one.label, one.said, one.wrong_class, one.not_annotated) for one in result.wrong
    ]
    assert listed == [
        ("images/001.png", "good", "bad", True, ()),
        ("images/003.png", "bad", None, True, ()),
        ("images/000.png", "good", "good", False, ()),
        ("images/002.png", "good", "good", False, ("round",)),
    ]
    assert [one.misread for one in result.wrong] == [
        (Misreading("colour", "blue", 0.9, "red"),),
        (),
        (Misreading("round", "no", 0.9, "yes"),),
        (Misreading("colour", "red", 0.9, "green"),),
    ]
    record = json.loads(json.dumps(result.to_dict()))
    assert record["wrong"][0]["misread"] == [
        {
            "feature": "colour",
            "seen": "blue",
            "probability": 0.9,
            "annotated": "red",
            "overruled": None,
        }
    ]


def test_classes_are_decided_again_with_what_is_annotated(tiles: Domain, four: Dataset) -> None:
    """A blue cornered tile is bad, a red one good, a green one undecided."""
    agent = Stub(tiles)
    # red seen as blue: mended by the colour; green seen as red, good by luck: spoilt by it;
    # bad green: nothing decides it, however it is read.
    agent.told = [("red", "yes"), ("blue", "no"), ("red", "yes"), ("green", "yes")]
    found = evaluate(agent, four).redecided
    assert (found.wrong, found.not_known) == (2, 0)
    assert found.mended == {"colour": 1, "round": 0}
    assert found.spoilt == {"colour": 1, "round": 0}
    assert found.mended_by_all == 1


def test_what_classes_depend_on(tiles: Domain, four: Dataset, tmp_path: Path) -> None:
    agent = Stub(tiles)
    agent.told = [("red", "yes"), ("red", "no"), ("green", "yes"), ("green", "no")]
    result = evaluate(agent, four)
    assert result.depended_on == {"colour": True, "round": False}  # no tile here is blue
    assert result.asked_by_axioms == {"colour": True, "round": True}
    short = KNOWLEDGE[: KNOWLEDGE.index("%% a blue")]
    agent.told = [("blue", "no"), ("red", "no"), ("green", "yes"), ("green", "no")]
    assert evaluate(agent, four).depended_on == {"colour": True, "round": True}
    agent = Stub(load_domain(write_domain(tmp_path / "short", knowledge=short)))
    agent.told = [("red", "yes"), ("red", "no"), ("green", "yes"), ("green", "no")]
    result = evaluate(agent, four)
    assert result.depended_on == {"colour": True, "round": False}
    assert result.asked_by_axioms == {"colour": True, "round": False}
    assert result.advice()[-1].startswith("No class of these pictures depends on 'round'")


def test_pictures_to_train_on_are_counted(agent: Agent, dataset: Dataset) -> None:
    """Those of the dataset, or, where it has none, those that the model remembers."""
    split = evaluate(agent, dataset, questions_per_scene=1)
    assert split.has_splits
    assert sum(split.training_pictures["class"].values()) == 40
    assert split.training_pictures["colour"] == {"red": 14, "green": 13, "blue": 13}
    scenes = tuple(replace(scene, split="") for scene in dataset.of_split("test").scenes)
    alone = evaluate(agent, dataset.of_scenes(scenes), questions_per_scene=1)
    assert not alone.has_splits
    assert alone.training_pictures == split.training_pictures


def test_pictures_are_looked_at_some_at_a_time(
    agent: Agent, dataset: Dataset, monkeypatch: pytest.MonkeyPatch
) -> None:
    sizes = []
    real = Agent.classify_all

    def classify_all(self: Agent, pictures: np.ndarray) -> list[Classification]:
        sizes.append(len(pictures))
        return real(self, pictures)

    monkeypatch.setattr(Agent, "classify_all", classify_all)
    many = dataset.take([n % len(dataset) for n in range(150)])
    scenes = tuple(replace(scene, split="") for scene in many.scenes)
    assert evaluate(agent, dataset.of_scenes(scenes), questions_per_scene=1).scenes == 150
    assert sizes == [64, 64, 22]


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
