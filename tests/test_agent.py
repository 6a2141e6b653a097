"""The agent: pictures become features, features a class, questions answers with reasons."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image

import seewhy
from conftest import TRUTH, draw_tile, seen
from seewhy.agent.agent import Agent
from seewhy.data.dataset import Dataset
from seewhy.dialogue.answer import AnswerType
from seewhy.dialogue.question import Asks
from seewhy.domain.domain import Domain
from seewhy.errors import NotFittedError, PictureError, QuestionError
from seewhy.induction.tree import DecisionTree
from seewhy.knowledge.justification import Basis


def test_the_model_of_the_tests_sees_and_decides(agent: Agent) -> None:
    """What the other tests of this file rest on."""
    for (colour, is_round), label in TRUTH.items():
        scene = agent.classify(draw_tile(colour, is_round, 3))
        assert (scene.vector, scene.label) == ((colour, is_round), label)


def test_a_reply_from_the_knowledge(agent: Agent) -> None:
    reply = agent.ask(draw_tile("blue", "no", 1), "why is it bad?")
    assert reply.text == "The tile is blue, and it has corners."
    assert (reply.method, reply.label) == ("knowledge", "bad")
    assert reply.kind == AnswerType("reasons", ("colour", "round"))
    node = reply.justification
    assert node.axiom is not None
    assert (node.axiom.text, node.axiom.location.line) == ("a blue tile with corners is bad", 11)
    assert node.axiom.location.file.endswith("knowledge.al")
    assert [child.probability for child in node.children] == [
        reply.features["colour"].probability,
        reply.features["round"].probability,
    ]


def test_a_reply_from_the_tree(agent: Agent) -> None:
    reply = agent.ask(draw_tile("green", "yes", 1), "is it good?")
    assert (reply.text, reply.method, reply.label) == ("Yes, the tile is good.", "tree", "good")
    assert reply.justification.basis is Basis.TREE
    path, undecided, answer = (
        next(n for n in reply.justification.children if n.basis is basis)
        for basis in (Basis.PATH, Basis.ABSENCE, Basis.RECURRENT)
    )
    assert undecided.text == "the knowledge does not decide: no axiom concludes a class"
    assert path.text == (
        "of the tiles that no rule decides, if the tile is round, then it is good "
        "(1 of 2 features tested, 100 % of 13 tiles)"
    )
    assert [child.feature for child in path.children] == ["round"]
    assert answer.text.startswith("the answer was chosen by the recurrent network (p = ")


def test_an_explanation_of_the_tree(agent: Agent) -> None:
    picture = draw_tile("green", "no", 1)
    reply = agent.ask(picture, "please explain this answer")
    start, _, end = reply.text.partition("(each with a probability of at least ")
    assert start == "I see that the tile is green, and it has corners "
    assert end[4:] == (
        "). The knowledge does not decide: no axiom concludes a class. So the decision tree is "
        "asked: of the tiles that no rule decides, if the tile has corners, then it is bad "
        "(1 of 2 features tested, 100 % of 9 "
        "tiles). The answer was chosen by the recurrent network (p = 1.00 among the answers that "
        "fit)."
    )


def test_every_reply_has_what_a_reply_has(agent: Agent) -> None:
    for (colour, is_round), label in TRUTH.items():
        picture = draw_tile(colour, is_round, 2)
        scene = agent.classify(picture)
        for question in agent.questions.one_of_each():
            reply = agent.answer(scene, question)
            assert reply.text.endswith(".")
            assert reply.text[0].isupper()
            assert "{" not in reply.text
            assert reply.method in ("knowledge", "tree")
            assert reply.label == label
            assert set(reply.features) == {"colour", "round"}
            for reading in reply.features.values():
                assert 0.0 <= reading.probability <= 1.0
            for node in reply.justification.walk():
                assert node.text
                assert node.probability is None or 0.0 <= node.probability <= 1.0
                assert node.axiom is None or node.axiom.location.line > 0


def test_answers_about_open_scenes_agree_with_the_class_and_the_features(agent: Agent) -> None:
    for colour, is_round in (("green", "yes"), ("green", "no"), ("blue", "yes")):
        label = TRUTH[colour, is_round]
        scene = agent.classify(draw_tile(colour, is_round, 4))
        ask = agent.questions.understand
        yes = agent.answer(scene, ask(f"is it {label}?"))
        assert yes.text == f"Yes, the tile is {label}."
        assert agent.answer(scene, ask("what colour is it?")).text == f"The tile is {colour}."
        already = agent.answer(scene, ask(f"what would make it {label}?"))
        assert already.text == f"The tile is {label} already."


# Pictures -------------------------------------------------------------------------------------


def test_paths_images_and_arrays_are_the_same(agent: Agent, tmp_path: Path) -> None:
    image = draw_tile("blue", "yes", 0)
    image.save(tmp_path / "tile.png")
    forms: list[Any] = [
        tmp_path / "tile.png",
        str(tmp_path / "tile.png"),
        image,
        np.asarray(image),
        np.asarray(image).astype(float) / 255,
        image.convert("RGBA"),
    ]
    replies = [agent.ask(form, "why is it good?") for form in forms]
    assert {reply.text for reply in replies} == {replies[0].text}
    assert len({str(reply.features) for reply in replies}) == 1


def test_what_is_no_picture(agent: Agent, tmp_path: Path) -> None:
    (tmp_path / "text.png").write_text("hello")
    with pytest.raises(PictureError, match=r"text\.png is not a picture of a known type"):
        agent.ask(tmp_path / "text.png", "is it good?")
    with pytest.raises(PictureError, match="must be a path, a Pillow image or a NumPy array"):
        agent.ask(3, "is it good?")  # type: ignore[arg-type]


def test_the_question_is_read_before_the_picture(agent: Agent) -> None:
    with pytest.raises(QuestionError):
        agent.ask("no_such_picture.png", "what is the meaning of life?")


def test_a_batch_is_classified_like_single_pictures(agent: Agent, dataset: Dataset) -> None:
    batch = agent.classify_all(dataset.pictures(16))
    for scene, classified in list(zip(dataset.scenes, batch, strict=True))[:8]:
        single = agent.classify(scene.picture)
        assert (single.label, single.vector, single.method) == (
            classified.label,
            classified.vector,
            classified.method,
        )
        for key, reading in single.features.items():
            assert reading.probability == pytest.approx(
                classified.features[key].probability, abs=1e-5
            )
    assert agent.classify_all(np.empty((0, 16, 16, 3), dtype=np.uint8)) == []


# Training -------------------------------------------------------------------------------------


def test_many_answers_at_once_are_those_one_by_one(agent: Agent, dataset: Dataset) -> None:
    scenes = agent.classify_all(dataset.pictures(agent.domain.pictures.size)[:12])
    questions = [q for q in agent.questions.one_of_each() if q.asks is not Asks.EXPLAIN]
    asked = [(scene, question) for scene in scenes for question in questions]
    assert {"tree", "knowledge"} <= {scene.method for scene in scenes}
    assert agent.answer_all(asked) == [agent.answer(*pair) for pair in asked]
    assert agent.answer_all([]) == []


def test_the_tree_learns_from_what_the_knowledge_leaves_open_or_gets_wrong(
    tiles: Domain, dataset: Dataset, monkeypatch: pytest.MonkeyPatch
) -> None:
    agent = Agent(tiles)
    given: dict[str, list[Any]] = {}
    fit = DecisionTree.fit

    def spy(tree: DecisionTree, vectors: list[Any], labels: list[str], *, seed: int) -> Any:
        given["tree"] = list(zip(vectors, labels, strict=True))
        return fit(tree, vectors, labels, seed=seed)

    def answers(*args: Any, **_: Any) -> None:
        given["answers"] = list(zip(args[3], args[4], strict=True))

    monkeypatch.setattr(DecisionTree, "fit", spy)
    monkeypatch.setattr("seewhy.dialogue.learned.fit_learned_answers", answers)
    train = dataset.of_split("train")
    agent.fit_induction(train.vectors, train.labels)
    scenes = list(zip(train.vectors, train.labels, strict=True))
    expected = [
        (vector, label)
        for vector, label in scenes
        if vector[0] == "green"
        or vector == ("blue", "yes")
        or (vector[0] == "red" and label == "bad")
    ]
    assert given["tree"] == given["answers"] == expected
    assert ("red", "no") in [vector for vector, _ in expected]
    assert sum(sum(counts.values()) for counts in agent.experience.values()) == len(train)


def test_where_the_knowledge_decides_all_there_is_no_tree(tiles: Domain) -> None:
    agent = Agent(tiles).fit_induction([("red", "yes"), ("blue", "no")], ["good", "bad"])
    assert not agent.tree.fitted
    assert agent.answerer is None
    assert agent.decide({"colour": "green", "round": "yes"}) is None
    scene = seen(agent, "green", "yes")
    reply = agent.answer(scene, agent.questions.understand("is it good?"))
    assert (reply.method, reply.kind.form) == ("none", "undecided")


def test_a_second_training_forgets_the_first(tiles: Domain) -> None:
    agent = Agent(tiles).fit_induction([("green", "yes"), ("green", "no")] * 4, ["good", "bad"] * 4)
    assert agent.tree.fitted
    assert agent.answerer is not None
    agent.fit_induction([("red", "yes")], ["good"])
    assert not agent.tree.fitted
    assert agent.answerer is None


def test_one_open_scene_is_enough(tiles: Domain) -> None:
    agent = Agent(tiles).fit_induction([("green", None), ("red", "no")], ["bad", "good"])
    reply = agent.answer(seen(agent, "green", "no"), agent.questions.understand("is it bad?"))
    assert reply.text == "Yes, the tile is bad."


@pytest.mark.usefixtures("in_one_process")
def test_the_same_seed_gives_the_same_agent(tiles: Domain, dataset: Dataset, agent: Agent) -> None:
    again = Agent(tiles, seed=3).fit(dataset)
    pictures = dataset.pictures(16)
    assert again.classify_all(pictures) == agent.classify_all(pictures)
    scene = seen(agent, "green", "yes", probability=1.0)
    for question in agent.questions.one_of_each():
        assert again.answer(scene, question) == agent.answer(scene, question)


def test_what_it_was_trained_on_is_known(agent: Agent, dataset: Dataset) -> None:
    assert agent.trained_on == set(dataset.of_split("train").picture_digests())


def test_an_untrained_agent_says_so(tiles: Domain) -> None:
    agent = Agent(tiles)
    with pytest.raises(NotFittedError) as problem:
        agent.ask(draw_tile("red", "yes", 0), "is it good?")
    assert str(problem.value) == "the agent is not trained yet; call fit, or load a model"
    assert isinstance(problem.value, ValueError)


def test_an_untrained_agent_decides_what_the_knowledge_decides(tiles: Domain) -> None:
    agent = Agent(tiles)
    assert agent.decide({"colour": "red"}) == "good"
    assert agent.decide({"colour": "blue", "round": "no"}) == "bad"
    assert agent.decide({"colour": "green", "round": "no"}) is None


def test_a_feature_that_is_not_known(tiles: Domain) -> None:
    agent = Agent(tiles)
    scene = seen(agent, "red", None)
    reply = agent.answer(scene, agent.questions.understand("why is it good?"))
    assert reply.text == "The tile is red."


def test_an_explanation_refers_to_the_answer_before(agent: Agent) -> None:
    picture = draw_tile("red", "no", 5)
    before = agent.ask(picture, "what would make it bad?")
    assert before.text == "To make the tile bad, paint it blue."
    reply = agent.ask(picture, "please explain this answer", previous=before)
    assert reply.text.startswith("You asked: what would make the tile bad? I see that ")
    assert 'because "a blue tile with corners is bad".' in reply.text
    assert reply.justification == before.justification
    alone = agent.ask(picture, "please explain this answer")
    assert alone.text.startswith("I see that the tile is red (with a probability of ")
    assert alone.text.endswith('The tile is good, because "a red tile is good".')


def test_the_public_names_are_there() -> None:
    for name in set(seewhy.__all__) - {"__version__"}:
        assert getattr(seewhy, name).__name__ == name
    with pytest.raises(AttributeError, match="module 'seewhy' has no attribute 'agnet'"):
        _ = seewhy.agnet


def test_greyscale_pictures_are_answered(agent: Agent) -> None:
    """Pictures unlike those of the training get an answer, not an error."""
    reply = agent.ask(Image.new("L", (40, 20), 128), "is it round?")
    assert reply.question.asks is Asks.FEATURE_IS
